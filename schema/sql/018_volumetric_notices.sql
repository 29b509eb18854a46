-- Doubtful notices of the errors from which a volumetric table was built (schema/notice/notice_json.h); NULL for an
-- older table, or if there are none.
ALTER TABLE volumetric_table ADD COLUMN doubtful TEXT;
