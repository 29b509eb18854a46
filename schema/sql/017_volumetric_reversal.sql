-- What the approaches leave of the corrections (schema/volumetric/volumetric_table.h, reversal_m): 3 doubles; NULL of an
-- older table.
ALTER TABLE volumetric_table ADD COLUMN reversal_m BLOB;
