-- Settings of encoder.set: the position of the axis, and the offset that is added to its encoder from then on. A
-- setting is valid while the daemon runs and the encoder's device has power. After a restart, the last row of an axis
-- shows the lost setting. Each setting is linked in the ledger and has its own recorded action. Therefore the table
-- of actions is made again with a new CHECK: SQLite cannot change the CHECK of a column in another way, and no table
-- refers to this table.
CREATE TABLE encoder_datum (
  id INTEGER PRIMARY KEY,
  axis TEXT NOT NULL CHECK (axis IN ('X', 'Y', 'Z')),
  device TEXT NOT NULL,       -- whose encoder it is
  before_m REAL NOT NULL,     -- where the axis stood by what held until then
  position_m REAL NOT NULL,   -- where it stands
  offset_m REAL NOT NULL,     -- added to what the device shows from then on
  utc TEXT NOT NULL
) STRICT;

CREATE INDEX encoder_datum_by_axis ON encoder_datum (axis, id);

CREATE TRIGGER encoder_datum_no_update BEFORE UPDATE ON encoder_datum
BEGIN SELECT raise(ABORT, 'encoder_datum is append only'); END;
CREATE TRIGGER encoder_datum_no_delete BEFORE DELETE ON encoder_datum
BEGIN SELECT raise(ABORT, 'encoder_datum is append only'); END;

CREATE TABLE deed_new (
  id INTEGER PRIMARY KEY,
  name TEXT NOT NULL,     -- run.start, run.resume, run.stop, run.abort, run.replay, squareness.fit,
                          -- compensation.build, compensation.activate, compensation.deactivate, encoder.set
  subject TEXT NOT NULL CHECK (subject IN
    ('run', 'squareness', 'compensation_table', 'activation', 'deactivation', 'encoder_datum')),
  row INTEGER NOT NULL,   -- its key
  uid INTEGER NOT NULL,
  gid INTEGER NOT NULL,
  pid INTEGER NOT NULL,
  user TEXT NOT NULL,
  utc TEXT NOT NULL
) STRICT;
INSERT INTO deed_new (id, name, subject, row, uid, gid, pid, user, utc)
SELECT id, name, subject, row, uid, gid, pid, user, utc FROM deed;
DROP TABLE deed;
ALTER TABLE deed_new RENAME TO deed;

CREATE INDEX deed_by_subject ON deed (subject, row);

CREATE TRIGGER deed_no_update BEFORE UPDATE ON deed
BEGIN SELECT raise(ABORT, 'deed is append only'); END;
CREATE TRIGGER deed_no_delete BEFORE DELETE ON deed
BEGIN SELECT raise(ABORT, 'deed is append only'); END;
