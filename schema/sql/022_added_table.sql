-- The table whose values are in this table, too, because the controller applied it during the runs; NULL: none.
ALTER TABLE compensation_table ADD COLUMN added_to INTEGER REFERENCES compensation_table (id);
