-- What a run looks like as a whole: what was visited how often, what was left out, what encoder and
-- probes did. For people; no part of the result and of its hash. One JSON object a run, as
-- schema/plausibility/plausibility_json.h writes it; runs stored before this step have none.
CREATE TABLE run_plausibility (
  run INTEGER PRIMARY KEY REFERENCES run (id),
  json TEXT NOT NULL
) STRICT;

CREATE TRIGGER run_plausibility_no_update BEFORE UPDATE ON run_plausibility
BEGIN SELECT raise(ABORT, 'run_plausibility is append only'); END;
CREATE TRIGGER run_plausibility_no_delete BEFORE DELETE ON run_plausibility
BEGIN SELECT raise(ABORT, 'run_plausibility is append only'); END;
