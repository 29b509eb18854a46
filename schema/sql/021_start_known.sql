-- 1: started_utc is the time at which the measurement began; 0: it is the day that the rig states, or the time of the
-- evaluation or import; NULL: the run is older than this column (was_start_known() in daemon/store/read.cpp decides).
ALTER TABLE run ADD COLUMN start_known INTEGER CHECK (start_known IN (0, 1));
