-- Why somebody did it, in his own words: of an activation, or of the end of one.
CREATE TABLE deed_reason (
  deed INTEGER PRIMARY KEY REFERENCES deed (id),
  text TEXT NOT NULL
) STRICT;

CREATE TRIGGER deed_reason_no_update BEFORE UPDATE ON deed_reason
BEGIN SELECT raise(ABORT, 'deed_reason is append only'); END;
CREATE TRIGGER deed_reason_no_delete BEFORE DELETE ON deed_reason
BEGIN SELECT raise(ABORT, 'deed_reason is append only'); END;
