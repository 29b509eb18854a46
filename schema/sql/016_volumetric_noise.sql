-- Noise of each axis of a volumetric table, for each command of the axis (noise_numbers() in
-- schema/volumetric/volumetric_table.h); NULL or empty if it is unknown.
ALTER TABLE volumetric_table ADD COLUMN noise BLOB;
