-- For an imported run, the moving body, its direction and the number of lost scans are unknown. Its travel is the
-- travel that was stated at the import. An imported run has no errors at the fixture, so v_errors contains no rows
-- for it.
DROP VIEW v_runs;
CREATE VIEW v_runs AS
SELECT run.id AS run, run.axis, coalesce(e.state, 'open') AS state, run.simulated,
       coalesce(e.state = 'partial' OR EXISTS (
         SELECT 1 FROM json_each(e.warnings) AS n WHERE CASE n.type
           WHEN 'object' THEN json_extract(n.value, '$.severity') <> 'information'
           ELSE n.value NOT LIKE 'information: %' END), 0) AS doubtful,
       u.noise_only, u.not_declared AS u_not_declared,
       run.started_utc, run.note, run.supersedes,
       (SELECT min(later.id) FROM run AS later WHERE later.supersedes = run.id) AS superseded_by,
       run.model, CASE WHEN r.kind LIKE 'imported %' THEN NULL ELSE run.moves END AS moves,
       CASE WHEN r.kind LIKE 'imported %' THEN json_extract(o.text, '$.imported.travel') ELSE run.travel END AS travel,
       (SELECT count(*) FROM point AS p WHERE p.id BETWEEN run.id << 32 AND (run.id << 32) + 4294967295)
         AS points,
       e.scans,
       CASE WHEN (r.kind = 'csv' OR r.kind LIKE 'imported %') AND e.scans_lost = 0 THEN NULL ELSE e.scans_lost END AS scans_lost,
       t.mean_C AS temperature_mean_C, t.min_C AS temperature_min_C, t.max_C AS temperature_max_C,
       r.kind AS recording_kind, r.path AS recording_path, r.sha256 AS recording_sha256,
       e.result_sha256, run.software_version, coalesce(e.warnings, '[]') AS notices
FROM run LEFT JOIN run_end AS e ON e.run = run.id
JOIN recording AS r ON r.id = coalesce(e.recording, run.recording)
JOIN document AS o ON o.id = run.options
LEFT JOIN run_temperature AS t ON t.run = run.id LEFT JOIN run_uncertainty AS u ON u.run = run.id;

DROP VIEW v_errors;
CREATE VIEW v_errors AS
SELECT run, axis, row, target, target_mm, pass, direction, position_mm, error,
       CASE WHEN place < 2 THEN value END AS value_um, CASE WHEN place < 2 THEN 1e6 * u END AS u_um,
       CASE WHEN place < 2 THEN 1e6 * (k * u) END AS expanded_u_um,
       CASE WHEN place >= 2 THEN value END AS value_urad, CASE WHEN place >= 2 THEN 1e6 * u END AS u_urad,
       CASE WHEN place >= 2 THEN 1e6 * (k * u) END AS expanded_u_urad, k
FROM (SELECT p.run, p.axis, p.row, p.target, 1e3 * point.target_m AS target_mm, p.repetition AS pass,
             p.direction, p.position_mm, n.error, n.place,
             n.sign * p.micro * CASE n.local WHEN 'dy' THEN p.dy_m WHEN 'dz' THEN p.dz_m
               WHEN 'ex' THEN p.ex_rad WHEN 'ey' THEN p.ey_rad ELSE p.ez_rad END AS value,
             nullif(CASE n.place WHEN 0 THEN u.u_0_m WHEN 1 THEN u.u_1_m WHEN 2 THEN u.u_A_rad
               WHEN 3 THEN u.u_B_rad ELSE u.u_C_rad END, 0) AS u,  -- of nothing at all: not known
             CASE n.place WHEN 0 THEN u.k_0 WHEN 1 THEN u.k_1 WHEN 2 THEN u.k_A WHEN 3 THEN u.k_B
               ELSE u.k_C END AS k
      FROM v_point AS p JOIN point ON point.id = (p.run << 32) + p.row
      JOIN run ON run.id = p.run JOIN recording AS r ON r.id = run.recording AND r.kind NOT LIKE 'imported %'
      JOIN v_error_name AS n ON n.axis = p.axis
      LEFT JOIN point_uncertainty AS u ON u.run = p.run AND u.row = p.row);
