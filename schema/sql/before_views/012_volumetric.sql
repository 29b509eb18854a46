-- Tables of corrections for a plane or a volume (schema/volumetric/volumetric_table.h), and the active table. The ids
-- of these tables and of compensation_table are counted together. Columns of doubles: as in 001_runs.sql.
CREATE TABLE volumetric_table (
  id INTEGER PRIMARY KEY,
  machine TEXT NOT NULL,       -- its name
  description INTEGER NOT NULL REFERENCES document (id),  -- MACHINE.toml
  chain TEXT NOT NULL,
  chain_travel TEXT NOT NULL,
  simulated INTEGER NOT NULL CHECK (simulated IN (0, 1)),
  noise_only INTEGER NOT NULL CHECK (noise_only IN (0, 1)),
  approach TEXT NOT NULL CHECK (approach IN ('mean', 'forward', 'reverse')),
  tool_m BLOB NOT NULL,        -- 3 doubles
  rotary_rad BLOB NOT NULL,    -- 3 doubles
  X_m BLOB NOT NULL,           -- commands of the nodes
  Y_m BLOB NOT NULL,
  Z_m BLOB NOT NULL,
  correction_m BLOB NOT NULL,  -- 3 doubles a node, X fastest
  u_m BLOB NOT NULL,           -- 3 doubles a node
  interpolation_m BLOB NOT NULL,  -- 3 doubles
  place_left_m ANY,
  turn_left_rad ANY,
  not_measured TEXT NOT NULL,    -- JSON arrays of texts
  u_not_declared TEXT NOT NULL,
  beyond_tables TEXT NOT NULL,
  created_utc TEXT NOT NULL,
  sha256 TEXT NOT NULL
) STRICT;

CREATE TABLE volumetric_source (
  volumetric_table INTEGER NOT NULL REFERENCES volumetric_table (id),
  row INTEGER NOT NULL,
  run INTEGER NOT NULL REFERENCES run (id),
  PRIMARY KEY (volumetric_table, row)
) STRICT, WITHOUT ROWID;

-- The generations are counted together with those of activation and deactivation. The last row is valid. If it has no
-- table, no table is active.
CREATE TABLE volumetric_activation (
  generation INTEGER PRIMARY KEY,
  volumetric_table INTEGER REFERENCES volumetric_table (id),
  actor TEXT NOT NULL,
  activated_utc TEXT NOT NULL
) STRICT;

CREATE TRIGGER volumetric_table_no_update BEFORE UPDATE ON volumetric_table
BEGIN SELECT raise(ABORT, 'volumetric_table is append only'); END;
CREATE TRIGGER volumetric_table_no_delete BEFORE DELETE ON volumetric_table
BEGIN SELECT raise(ABORT, 'volumetric_table is append only'); END;
CREATE TRIGGER volumetric_source_no_update BEFORE UPDATE ON volumetric_source
BEGIN SELECT raise(ABORT, 'volumetric_source is append only'); END;
CREATE TRIGGER volumetric_source_no_delete BEFORE DELETE ON volumetric_source
BEGIN SELECT raise(ABORT, 'volumetric_source is append only'); END;
CREATE TRIGGER volumetric_activation_no_update BEFORE UPDATE ON volumetric_activation
BEGIN SELECT raise(ABORT, 'volumetric_activation is append only'); END;
CREATE TRIGGER volumetric_activation_no_delete BEFORE DELETE ON volumetric_activation
BEGIN SELECT raise(ABORT, 'volumetric_activation is append only'); END;

-- SQLite cannot change the CHECK of a column in another way, and no table refers to this table.
CREATE TABLE deed_new (
  id INTEGER PRIMARY KEY,
  name TEXT NOT NULL,     -- run.start, run.resume, run.stop, run.abort, run.replay, squareness.fit,
                          -- compensation.build, compensation.build_volume, compensation.activate,
                          -- compensation.deactivate, encoder.set
  subject TEXT NOT NULL CHECK (subject IN
    ('run', 'squareness', 'compensation_table', 'activation', 'deactivation', 'encoder_datum',
     'volumetric_table', 'volumetric_activation')),
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
