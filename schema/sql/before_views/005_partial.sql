-- The state of a run that ended before all requested targets were measured is `partial`. SQLite can change the CHECK
-- of a column only if the table is made again; no other table refers to this table.

CREATE TABLE run_end_new (
  run INTEGER PRIMARY KEY REFERENCES run (id),
  state TEXT NOT NULL CHECK (state IN ('complete', 'partial', 'aborted', 'failed')),
  scans INTEGER,
  scans_lost INTEGER,
  warnings TEXT NOT NULL,         -- JSON array of texts
  recording INTEGER REFERENCES recording (id),  -- where it was not known at the start
  result_sha256 TEXT NOT NULL     -- of points, straightness and angles
) STRICT;
INSERT INTO run_end_new (run, state, scans, scans_lost, warnings, recording, result_sha256)
SELECT run, state, scans, scans_lost, warnings, recording, result_sha256 FROM run_end;
DROP TABLE run_end;
ALTER TABLE run_end_new RENAME TO run_end;

CREATE TRIGGER run_end_no_update BEFORE UPDATE ON run_end
BEGIN SELECT raise(ABORT, 'run_end is append only'); END;
CREATE TRIGGER run_end_no_delete BEFORE DELETE ON run_end
BEGIN SELECT raise(ABORT, 'run_end is append only'); END;
