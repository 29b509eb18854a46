-- For runs whose log had a column temperature_C: its values from the first scan to the last.
CREATE TABLE run_temperature (
  run INTEGER PRIMARY KEY REFERENCES run (id),
  mean_C ANY NOT NULL,
  min_C ANY NOT NULL,
  max_C ANY NOT NULL
) STRICT;

CREATE TRIGGER run_temperature_no_update BEFORE UPDATE ON run_temperature
BEGIN SELECT raise(ABORT, 'run_temperature is append only'); END;
CREATE TRIGGER run_temperature_no_delete BEFORE DELETE ON run_temperature
BEGIN SELECT raise(ABORT, 'run_temperature is append only'); END;
