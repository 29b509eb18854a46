-- A table can be deactivated. Activations and deactivations of an axis are numbered together (generation). The row
-- with the highest generation of the axis, in either table, is valid. Append only.
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
