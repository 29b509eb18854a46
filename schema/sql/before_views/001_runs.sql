-- Runs and their origin. Append only: rows are never changed or deleted; the triggers at the end ensure this. A
-- correction is a new row that supersedes an old row.
--
-- The name of a column ends in its unit. Values are SI doubles and are stored bit for bit. Their type is ANY, because
-- REAL would convert -0.0 to 0.0. An unknown value is NULL. A BLOB column of doubles contains 8-byte little-endian
-- IEEE 754 numbers, one after the other.

-- Texts that several runs use: rigs, configurations, options.
CREATE TABLE document (
  id INTEGER PRIMARY KEY,
  sha256 TEXT NOT NULL UNIQUE,
  text TEXT NOT NULL
) STRICT;

CREATE TABLE recording (
  id INTEGER PRIMARY KEY,
  sha256 TEXT NOT NULL,  -- empty while a live recording goes on
  kind TEXT NOT NULL,
  path TEXT NOT NULL,
  UNIQUE (sha256, kind, path)
) STRICT;

CREATE TABLE run (
  id INTEGER PRIMARY KEY,
  axis TEXT NOT NULL CHECK (axis IN ('X', 'Y', 'Z')),
  simulated INTEGER NOT NULL CHECK (simulated IN (0, 1)),
  started_utc TEXT NOT NULL,
  note TEXT NOT NULL,
  supersedes INTEGER REFERENCES run (id),
  recording INTEGER NOT NULL REFERENCES recording (id),
  rig INTEGER NOT NULL REFERENCES document (id),
  options INTEGER NOT NULL REFERENCES document (id),
  configuration INTEGER NOT NULL REFERENCES document (id),
  model TEXT NOT NULL,
  software_version TEXT NOT NULL
) STRICT;

-- One row for each point. dy_m ... ez_rad are the errors in the local frame of the axis. The views v_points_x, _y, _z
-- show them with their ISO 230-1 names, in µm and µrad. They are NULL, with a reason, if the errors could not be
-- solved. The key is one integer, made from run and row. Therefore new rows are appended at the end of the tree,
-- which makes storing fast, and the rows of a run are a range of keys.
CREATE TABLE point (
  id INTEGER PRIMARY KEY CHECK (id = (run << 32) + row),
  run INTEGER NOT NULL REFERENCES run (id),
  row INTEGER NOT NULL,  -- 0, 1, ... in the order measured
  target INTEGER NOT NULL,
  target_m ANY,
  repetition INTEGER NOT NULL,
  direction INTEGER NOT NULL CHECK (direction BETWEEN -1 AND 1),
  begin_ns INTEGER NOT NULL,
  end_ns INTEGER NOT NULL,
  position_m ANY,
  samples INTEGER NOT NULL,
  flags TEXT NOT NULL,       -- JSON array of texts
  probe_m BLOB NOT NULL,     -- doubles, probes in the order of the rig
  probe_u_m BLOB NOT NULL,   -- doubles
  reason TEXT,               -- why there are no errors; NULL where there are
  dy_m ANY,
  dz_m ANY,
  ex_rad ANY,
  ey_rad ANY,
  ez_rad ANY,
  residual_m ANY,
  covariance_m_rad BLOB      -- 25 doubles, row-major
) STRICT;

CREATE TABLE straightness (
  run INTEGER NOT NULL REFERENCES run (id),
  row INTEGER NOT NULL,
  error_key TEXT NOT NULL,
  approach TEXT NOT NULL,
  slope_least_squares_rad ANY,
  slope_end_point_rad ANY,
  u_slope_least_squares_rad ANY,
  straightness_least_squares_m ANY,
  straightness_end_point_m ANY,
  peak_position_m ANY,
  valley_position_m ANY,
  PRIMARY KEY (run, row)
) STRICT, WITHOUT ROWID;

CREATE TABLE angle (
  run INTEGER NOT NULL REFERENCES run (id),
  row INTEGER NOT NULL,
  error_key TEXT NOT NULL,
  approach TEXT NOT NULL,
  start_rad ANY,
  min_rad ANY,
  max_rad ANY,
  PRIMARY KEY (run, row)
) STRICT, WITHOUT ROWID;

-- The end of a run. A run without this row is being measured, or was interrupted.
CREATE TABLE run_end (
  run INTEGER PRIMARY KEY REFERENCES run (id),
  state TEXT NOT NULL CHECK (state IN ('complete', 'aborted', 'failed')),
  scans INTEGER,
  scans_lost INTEGER,
  warnings TEXT NOT NULL,         -- JSON array of texts
  recording INTEGER REFERENCES recording (id),  -- where it was not known at the start
  result_sha256 TEXT NOT NULL     -- of points, straightness and angles
) STRICT;

CREATE TABLE squareness (
  id INTEGER PRIMARY KEY,
  run_x INTEGER NOT NULL REFERENCES run (id),
  run_y INTEGER NOT NULL REFERENCES run (id),
  EC0Y_rad ANY,
  u_EC0Y_rad ANY,
  slope_EYX_rad ANY,
  u_slope_EYX_rad ANY,
  slope_EXY_rad ANY,
  u_slope_EXY_rad ANY,
  artefact_angle_error_rad ANY,
  simulated INTEGER NOT NULL CHECK (simulated IN (0, 1)),
  created_utc TEXT NOT NULL
) STRICT;

CREATE TABLE compensation_table (
  id INTEGER PRIMARY KEY,
  axis TEXT NOT NULL CHECK (axis IN ('X', 'Y', 'Z')),
  simulated INTEGER NOT NULL CHECK (simulated IN (0, 1)),
  slope_removed INTEGER NOT NULL CHECK (slope_removed IN (0, 1)),
  created_utc TEXT NOT NULL,
  sha256 TEXT NOT NULL,
  position_m BLOB NOT NULL,  -- n doubles
  -- 20 series of n doubles: forward, reverse, u_forward, u_reverse, each of five errors in the order
  -- of their names (two straightness in m, then A, B, C in rad); NaN where there is no value
  errors_m_rad BLOB NOT NULL
) STRICT;

CREATE TABLE compensation_source (
  compensation_table INTEGER NOT NULL REFERENCES compensation_table (id),
  row INTEGER NOT NULL,
  run INTEGER NOT NULL REFERENCES run (id),
  PRIMARY KEY (compensation_table, row)
) STRICT, WITHOUT ROWID;

-- The active table of an axis is the table with the highest generation for this axis.
CREATE TABLE activation (
  generation INTEGER PRIMARY KEY,
  axis TEXT NOT NULL CHECK (axis IN ('X', 'Y', 'Z')),
  compensation_table INTEGER NOT NULL REFERENCES compensation_table (id),
  actor TEXT NOT NULL,
  activated_utc TEXT NOT NULL
) STRICT;

CREATE INDEX run_by_axis ON run (axis, id);
CREATE INDEX activation_by_axis ON activation (axis, generation);

CREATE TRIGGER document_no_update BEFORE UPDATE ON document
BEGIN SELECT raise(ABORT, 'document is append only'); END;
CREATE TRIGGER document_no_delete BEFORE DELETE ON document
BEGIN SELECT raise(ABORT, 'document is append only'); END;
CREATE TRIGGER recording_no_update BEFORE UPDATE ON recording
BEGIN SELECT raise(ABORT, 'recording is append only'); END;
CREATE TRIGGER recording_no_delete BEFORE DELETE ON recording
BEGIN SELECT raise(ABORT, 'recording is append only'); END;
CREATE TRIGGER run_no_update BEFORE UPDATE ON run
BEGIN SELECT raise(ABORT, 'run is append only'); END;
CREATE TRIGGER run_no_delete BEFORE DELETE ON run
BEGIN SELECT raise(ABORT, 'run is append only'); END;
CREATE TRIGGER point_no_update BEFORE UPDATE ON point
BEGIN SELECT raise(ABORT, 'point is append only'); END;
CREATE TRIGGER point_no_delete BEFORE DELETE ON point
BEGIN SELECT raise(ABORT, 'point is append only'); END;
CREATE TRIGGER straightness_no_update BEFORE UPDATE ON straightness
BEGIN SELECT raise(ABORT, 'straightness is append only'); END;
CREATE TRIGGER straightness_no_delete BEFORE DELETE ON straightness
BEGIN SELECT raise(ABORT, 'straightness is append only'); END;
CREATE TRIGGER angle_no_update BEFORE UPDATE ON angle
BEGIN SELECT raise(ABORT, 'angle is append only'); END;
CREATE TRIGGER angle_no_delete BEFORE DELETE ON angle
BEGIN SELECT raise(ABORT, 'angle is append only'); END;
CREATE TRIGGER run_end_no_update BEFORE UPDATE ON run_end
BEGIN SELECT raise(ABORT, 'run_end is append only'); END;
CREATE TRIGGER run_end_no_delete BEFORE DELETE ON run_end
BEGIN SELECT raise(ABORT, 'run_end is append only'); END;
CREATE TRIGGER squareness_no_update BEFORE UPDATE ON squareness
BEGIN SELECT raise(ABORT, 'squareness is append only'); END;
CREATE TRIGGER squareness_no_delete BEFORE DELETE ON squareness
BEGIN SELECT raise(ABORT, 'squareness is append only'); END;
CREATE TRIGGER compensation_table_no_update BEFORE UPDATE ON compensation_table
BEGIN SELECT raise(ABORT, 'compensation_table is append only'); END;
CREATE TRIGGER compensation_table_no_delete BEFORE DELETE ON compensation_table
BEGIN SELECT raise(ABORT, 'compensation_table is append only'); END;
CREATE TRIGGER compensation_source_no_update BEFORE UPDATE ON compensation_source
BEGIN SELECT raise(ABORT, 'compensation_source is append only'); END;
CREATE TRIGGER compensation_source_no_delete BEFORE DELETE ON compensation_source
BEGIN SELECT raise(ABORT, 'compensation_source is append only'); END;
CREATE TRIGGER activation_no_update BEFORE UPDATE ON activation
BEGIN SELECT raise(ABORT, 'activation is append only'); END;
CREATE TRIGGER activation_no_delete BEFORE DELETE ON activation
BEGIN SELECT raise(ABORT, 'activation is append only'); END;

-- For SQL users and notebooks: one row for each point, with ISO 230-1 names, in µm and µrad.
CREATE VIEW v_points_x AS
SELECT run.id AS run, p.row, p.target, p.repetition, p.direction, 1e3 * p.position_m AS position_mm,
       1e6 * dy_m AS EYX_um,
       1e6 * dz_m AS EZX_um,
       1e6 * ex_rad AS EAX_urad,
       1e6 * ey_rad AS EBX_urad,
       1e6 * ez_rad AS ECX_urad,
       p.samples, p.flags, p.reason
FROM run JOIN point AS p ON p.id BETWEEN run.id << 32 AND (run.id << 32) + 4294967295
WHERE run.axis = 'X';
CREATE VIEW v_points_y AS
SELECT run.id AS run, p.row, p.target, p.repetition, p.direction, 1e3 * p.position_m AS position_mm,
       -1e6 * dy_m AS EXY_um,
       1e6 * dz_m AS EZY_um,
       -1e6 * ey_rad AS EAY_urad,
       1e6 * ex_rad AS EBY_urad,
       1e6 * ez_rad AS ECY_urad,
       p.samples, p.flags, p.reason
FROM run JOIN point AS p ON p.id BETWEEN run.id << 32 AND (run.id << 32) + 4294967295
WHERE run.axis = 'Y';
CREATE VIEW v_points_z AS
SELECT run.id AS run, p.row, p.target, p.repetition, p.direction, 1e3 * p.position_m AS position_mm,
       1e6 * dy_m AS EXZ_um,
       1e6 * dz_m AS EYZ_um,
       1e6 * ey_rad AS EAZ_urad,
       1e6 * ez_rad AS EBZ_urad,
       1e6 * ex_rad AS ECZ_urad,
       p.samples, p.flags, p.reason
FROM run JOIN point AS p ON p.id BETWEEN run.id << 32 AND (run.id << 32) + 4294967295
WHERE run.axis = 'Z';
