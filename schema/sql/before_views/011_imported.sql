-- Runs with errors that other instruments have measured, and tables of positioning errors. Programs from before this
-- step would report such tables as damaged. No existing row is changed.
--
-- An imported run: recording.kind is "imported", a space and the format of the file; run.model is the ISO 230-1 name
-- of the error; run.rig is the empty text. Its rows in point have no solved errors. Their probe_m is one double: the
-- deviation (actual - nominal, m or rad). Their probe_u_m is the declared standard uncertainty of the deviation, or
-- empty.
--
-- compensation_table.errors_m_rad may have, after the 20 (25, with declared uncertainties) series of
-- n doubles, the series of the positioning error along the axis: forward, reverse, u_forward,
-- u_reverse (and, after 25, the declared uncertainty).

-- For SQL users: the origin of imported runs.
CREATE VIEW v_imported_run AS
SELECT run.id AS run, run.axis, run.model AS error, substr(recording.kind, 10) AS format,
       recording.path AS file, recording.sha256 AS file_sha256, run.started_utc AS imported_utc,
       run.simulated, run.note
FROM run JOIN recording ON recording.id = run.recording
WHERE recording.kind LIKE 'imported %';
