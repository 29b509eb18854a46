-- 1: u of all errors that a volumetric table corrects contains only noise and repeatability; 0: noise_only states it
-- for some errors; NULL for an older table, for which it is unknown.
ALTER TABLE volumetric_table ADD COLUMN noise_only_all INTEGER CHECK (noise_only_all IN (0, 1));
