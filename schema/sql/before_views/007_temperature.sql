-- For runs whose log has a column temperature_C: figures of its values between the first and the last scan.
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
