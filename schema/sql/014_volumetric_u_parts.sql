-- The part of u_m of a volumetric table that comes from noise: 3 doubles for each node; NULL or empty if it is
-- unknown.
ALTER TABLE volumetric_table ADD COLUMN u_independent_m BLOB;
