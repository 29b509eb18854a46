-- 1: u of all errors that a volumetric table corrects contains noise and repeatability alone; 0: noise_only says it of some;
-- NULL of an older table, which does not know.
ALTER TABLE volumetric_table ADD COLUMN noise_only_all INTEGER CHECK (noise_only_all IN (0, 1));
