-- Overall figures of a run: number of visits, omitted stops, readings of encoder and probes. They are for people, and
-- are not part of the result and of its hash. There is one JSON object for each run
-- (schema/plausibility/plausibility_json.h); runs from before this step have none.
CREATE TABLE run_plausibility (
  run INTEGER PRIMARY KEY REFERENCES run (id),
  json TEXT NOT NULL
) STRICT;

CREATE TRIGGER run_plausibility_no_update BEFORE UPDATE ON run_plausibility
BEGIN SELECT raise(ABORT, 'run_plausibility is append only'); END;
CREATE TRIGGER run_plausibility_no_delete BEFORE DELETE ON run_plausibility
BEGIN SELECT raise(ABORT, 'run_plausibility is append only'); END;
