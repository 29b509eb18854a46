-- The part of the corrections that remains because the errors depend on the approach (reversal_m in
-- schema/volumetric/volumetric_table.h): 3 doubles; NULL for an older table.
ALTER TABLE volumetric_table ADD COLUMN reversal_m BLOB;
