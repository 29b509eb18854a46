-- Reason of an activation or a deactivation, as the user has stated it.
CREATE TABLE deed_reason (
  deed INTEGER PRIMARY KEY REFERENCES deed (id),
  text TEXT NOT NULL
) STRICT;

CREATE TRIGGER deed_reason_no_update BEFORE UPDATE ON deed_reason
BEGIN SELECT raise(ABORT, 'deed_reason is append only'); END;
CREATE TRIGGER deed_reason_no_delete BEFORE DELETE ON deed_reason
BEGIN SELECT raise(ABORT, 'deed_reason is append only'); END;
