-- A recording (*.mdofrec): the raw samples of one session, before any processing. Append only;
-- every chunk contains the hash of everything before it, and a seal closes the file.
-- schema/recording/recording.h defines the bytes that are hashed.

CREATE TABLE header (
  key TEXT PRIMARY KEY,
  value TEXT NOT NULL
) STRICT;

CREATE TABLE chunk (
  seq INTEGER PRIMARY KEY,  -- 1, 2, ... without gaps
  device TEXT NOT NULL,
  first_ns INTEGER NOT NULL,
  last_ns INTEGER NOT NULL,
  scans INTEGER NOT NULL,
  lost INTEGER NOT NULL,
  sha256 TEXT NOT NULL,
  payload BLOB NOT NULL     -- schema/recording/chunk.h
) STRICT;

-- One row if the recording ended normally.
CREATE TABLE seal (
  id INTEGER PRIMARY KEY CHECK (id = 1),
  chunks INTEGER NOT NULL,
  scans INTEGER NOT NULL,
  lost INTEGER NOT NULL,
  finished_utc TEXT NOT NULL,
  sha256 TEXT NOT NULL
) STRICT;

CREATE TRIGGER header_no_update BEFORE UPDATE ON header
BEGIN SELECT raise(ABORT, 'header is append only'); END;
CREATE TRIGGER header_no_delete BEFORE DELETE ON header
BEGIN SELECT raise(ABORT, 'header is append only'); END;
CREATE TRIGGER chunk_no_update BEFORE UPDATE ON chunk
BEGIN SELECT raise(ABORT, 'chunk is append only'); END;
CREATE TRIGGER chunk_no_delete BEFORE DELETE ON chunk
BEGIN SELECT raise(ABORT, 'chunk is append only'); END;
CREATE TRIGGER seal_no_update BEFORE UPDATE ON seal
BEGIN SELECT raise(ABORT, 'seal is append only'); END;
CREATE TRIGGER seal_no_delete BEFORE DELETE ON seal
BEGIN SELECT raise(ABORT, 'seal is append only'); END;
