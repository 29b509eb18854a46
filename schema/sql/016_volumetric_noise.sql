-- Noise of each axis of a volumetric table by its commands (schema/volumetric/volumetric_table.h, noise_numbers());
-- NULL or empty if it is unknown.
ALTER TABLE volumetric_table ADD COLUMN noise BLOB;
