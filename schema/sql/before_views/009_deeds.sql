-- Recorded actions: one row for each requested change of state. The row is stored in the transaction of the change
-- and linked in the ledger. uid, gid and pid are those of the requesting process, as the kernel reports them; user is
-- the name of the uid at that time. Changes from before this step have no row.
CREATE TABLE deed (
  id INTEGER PRIMARY KEY,
  name TEXT NOT NULL,     -- run.start, run.resume, run.stop, run.abort, run.replay, squareness.fit,
                          -- compensation.build, compensation.activate, compensation.deactivate
  subject TEXT NOT NULL CHECK (subject IN
    ('run', 'squareness', 'compensation_table', 'activation', 'deactivation')),
  row INTEGER NOT NULL,   -- its key
  uid INTEGER NOT NULL,
  gid INTEGER NOT NULL,
  pid INTEGER NOT NULL,
  user TEXT NOT NULL,
  utc TEXT NOT NULL
) STRICT;

CREATE INDEX deed_by_subject ON deed (subject, row);

CREATE TRIGGER deed_no_update BEFORE UPDATE ON deed
BEGIN SELECT raise(ABORT, 'deed is append only'); END;
CREATE TRIGGER deed_no_delete BEFORE DELETE ON deed
BEGIN SELECT raise(ABORT, 'deed is append only'); END;
