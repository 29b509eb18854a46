-- Runs of errors that were measured elsewhere, and tables of positioning. Programs from before this step
-- would take such tables for damaged. No row changes.
--
-- An imported run: recording.kind is "imported", a space and the format of its file; run.model the error's
-- ISO 230-1 name; run.rig the empty text. A row in point has no solved errors; probe_m is one double,
-- the deviation (actual - nominal, m or rad), probe_u_m its declared standard uncertainty or nothing.
--
-- compensation_table.errors_m_rad may have behind the 20 (25, with what is declared) series of n
-- doubles those of the positioning error along the axis: forward, reverse, u_forward, u_reverse (and,
-- after 25, what is declared).

-- For SQL users: where imported runs came from.
CREATE VIEW v_imported_run AS
SELECT run.id AS run, run.axis, run.model AS error, substr(recording.kind, 10) AS format,
       recording.path AS file, recording.sha256 AS file_sha256, run.started_utc AS imported_utc,
       run.simulated, run.note
FROM run JOIN recording ON recording.id = run.recording
WHERE recording.kind LIKE 'imported %';
