-- Part of the corrections that remains because of the approaches (schema/volumetric/volumetric_table.h, reversal_m): 3
-- doubles; NULL for an older table.
ALTER TABLE volumetric_table ADD COLUMN reversal_m BLOB;
