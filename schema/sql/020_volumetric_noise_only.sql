-- 1: u of all errors that the volumetric table corrects contains only noise and repeatability; 0: the column
-- noise_only states this for some errors; NULL: unknown, because the table is older than this column.
ALTER TABLE volumetric_table ADD COLUMN noise_only_all INTEGER CHECK (noise_only_all IN (0, 1));
