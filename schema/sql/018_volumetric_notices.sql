-- Doubtful notices of the errors that a volumetric table was built from (schema/notice/notice_json.h); NULL for an
-- older table and if there are none.
ALTER TABLE volumetric_table ADD COLUMN doubtful TEXT;
