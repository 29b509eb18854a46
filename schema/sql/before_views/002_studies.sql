-- Sensitivity studies: their requests, their results, and the state of unfinished studies. Requests and results are
-- append only; a later row supersedes an interrupted result.

CREATE TABLE study (
  id INTEGER PRIMARY KEY,
  name TEXT NOT NULL,
  plan INTEGER NOT NULL REFERENCES document (id),      -- TOML: a user's plan, or a preset's options
  source TEXT NOT NULL,                                -- file of the plan; empty for a preset
  settings INTEGER NOT NULL REFERENCES document (id),  -- TOML: trials, coverage, adaptive rule
  seed INTEGER NOT NULL,
  trials_wanted INTEGER,      -- NULL: as many as the adaptive rule takes
  fingerprint TEXT NOT NULL,  -- SHA-256 of its files and of the first trials, a line each
  started_utc TEXT NOT NULL,
  software_version TEXT NOT NULL
) STRICT;

-- Results. One row is added each time the study ends; the row with the highest id is valid.
CREATE TABLE study_result (
  id INTEGER PRIMARY KEY,
  study INTEGER NOT NULL REFERENCES study (id),
  state TEXT NOT NULL CHECK (state IN ('complete', 'interrupted')),
  trials INTEGER NOT NULL,
  elapsed_s ANY NOT NULL,
  ended_utc TEXT NOT NULL,
  software_version TEXT NOT NULL,
  figures TEXT NOT NULL,        -- JSON, the same bytes however the work was divided
  figures_sha256 TEXT NOT NULL
) STRICT;
CREATE INDEX study_result_by_study ON study_result (study, id);

-- State of an unfinished study, from which the study can be continued. It is not a result: it is replaced while the
-- study runs, and deleted when the study is complete.
CREATE TABLE study_checkpoint (
  study INTEGER PRIMARY KEY REFERENCES study (id),
  trials INTEGER NOT NULL,
  sha256 TEXT NOT NULL,
  bytes BLOB NOT NULL
) STRICT;

CREATE TRIGGER study_no_update BEFORE UPDATE ON study
BEGIN SELECT raise(ABORT, 'study is append only'); END;
CREATE TRIGGER study_no_delete BEFORE DELETE ON study
BEGIN SELECT raise(ABORT, 'study is append only'); END;
CREATE TRIGGER study_result_no_update BEFORE UPDATE ON study_result
BEGIN SELECT raise(ABORT, 'study_result is append only'); END;
CREATE TRIGGER study_result_no_delete BEFORE DELETE ON study_result
BEGIN SELECT raise(ABORT, 'study_result is append only'); END;
