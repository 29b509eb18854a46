-- A chain of hashes. Each fact on which a result, a table or its activation depends has one link in the chain. The
-- link is made in the transaction that stores the fact (daemon/store/ledger.h defines the bytes). The chain detects
-- every change, removal or reordering of a fact. Facts from before this step are linked with the contents that they
-- have at this step.
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
