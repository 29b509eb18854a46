-- The part of u_m of a volumetric table by noise: 3 doubles a node; NULL or empty where it is not known apart.
ALTER TABLE volumetric_table ADD COLUMN u_independent_m BLOB;
