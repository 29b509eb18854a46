-- Overall figures of a run: number of visits, omitted stops, readings of encoder and probes. For
-- people; not part of the result and of its hash. One JSON object for each run, as
-- schema/plausibility/plausibility_json.h writes it; runs stored before this step have none.
CREATE TABLE run_plausibility (
  run INTEGER PRIMARY KEY REFERENCES run (id),
  json TEXT NOT NULL
) STRICT;

CREATE TRIGGER run_plausibility_no_update BEFORE UPDATE ON run_plausibility
BEGIN SELECT raise(ABORT, 'run_plausibility is append only'); END;
CREATE TRIGGER run_plausibility_no_delete BEFORE DELETE ON run_plausibility
BEGIN SELECT raise(ABORT, 'run_plausibility is append only'); END;
