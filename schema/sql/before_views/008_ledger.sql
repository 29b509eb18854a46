-- Every fact that a result, a table or its activation depends on has a link in one chain of hashes,
-- made in the transaction that stored the fact (daemon/store/ledger.h defines the bytes). Every
-- change, removal or reordering of a fact is detected. Facts from before this step are linked in their
-- state at this step.
CREATE TABLE ledger (
  id INTEGER PRIMARY KEY,   -- 1, 2, ... without a gap
  fact TEXT NOT NULL,       -- run, run_end, squareness, compensation_table, activation, deactivation
  row INTEGER NOT NULL,     -- its key
  sha256 TEXT NOT NULL,     -- of the link before and of the fact
  UNIQUE (fact, row)
) STRICT;

CREATE TRIGGER ledger_no_update BEFORE UPDATE ON ledger
BEGIN SELECT raise(ABORT, 'ledger is append only'); END;
CREATE TRIGGER ledger_no_delete BEFORE DELETE ON ledger
BEGIN SELECT raise(ABORT, 'ledger is append only'); END;
