-- A table may be taken out of force again. Activations and deactivations share one count of
-- generations: what holds on an axis is said by the row of its highest generation in either table.
-- Append only.
CREATE TABLE deactivation (
  generation INTEGER PRIMARY KEY,
  axis TEXT NOT NULL CHECK (axis IN ('X', 'Y', 'Z')),
  actor TEXT NOT NULL,
  deactivated_utc TEXT NOT NULL
) STRICT;

CREATE INDEX deactivation_by_axis ON deactivation (axis, generation);

CREATE TRIGGER deactivation_no_update BEFORE UPDATE ON deactivation
BEGIN SELECT raise(ABORT, 'deactivation is append only'); END;
CREATE TRIGGER deactivation_no_delete BEFORE DELETE ON deactivation
BEGIN SELECT raise(ABORT, 'deactivation is append only'); END;
