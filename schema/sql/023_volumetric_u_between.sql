-- The additional u of the corrections between two nodes (u_between_m in schema/volumetric/volumetric_table.h): the
-- numbers of u_between_numbers(), as doubles; NULL for an older table.
ALTER TABLE volumetric_table ADD COLUMN u_between_m BLOB;
