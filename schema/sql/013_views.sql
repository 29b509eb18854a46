-- Views for people who use SQL, pandas or Grafana. schema/sql/README.md lists their columns. The names and units of
-- columns do not change; a later step may add columns.
--
-- Uncertainties of the errors of a run's points, as they were when the run was stored. They are only for the views
-- below: mdof itself always calculates them again. They are not part of the result and of its hash. Runs from before
-- this step have none.
CREATE TABLE run_uncertainty (
  run INTEGER PRIMARY KEY REFERENCES run (id),
  noise_only INTEGER NOT NULL CHECK (noise_only IN (0, 1)),
  not_declared TEXT NOT NULL  -- JSON array of texts: keys of the rig
) STRICT;

-- Errors in the order of their ISO 230-1 names: two straightness errors, then A, B, C. U = k u.
CREATE TABLE point_uncertainty (
  run INTEGER NOT NULL REFERENCES run (id),
  row INTEGER NOT NULL,
  u_0_m ANY, u_1_m ANY, u_A_rad ANY, u_B_rad ANY, u_C_rad ANY,
  k_0 ANY, k_1 ANY, k_A ANY, k_B ANY, k_C ANY,
  PRIMARY KEY (run, row)
) STRICT, WITHOUT ROWID;

CREATE TRIGGER run_uncertainty_no_update BEFORE UPDATE ON run_uncertainty
BEGIN SELECT raise(ABORT, 'run_uncertainty is append only'); END;
CREATE TRIGGER run_uncertainty_no_delete BEFORE DELETE ON run_uncertainty
BEGIN SELECT raise(ABORT, 'run_uncertainty is append only'); END;
CREATE TRIGGER point_uncertainty_no_update BEFORE UPDATE ON point_uncertainty
BEGIN SELECT raise(ABORT, 'point_uncertainty is append only'); END;
CREATE TRIGGER point_uncertainty_no_delete BEFORE DELETE ON point_uncertainty
BEGIN SELECT raise(ABORT, 'point_uncertainty is append only'); END;

-- A notice is doubtful unless its severity is "information". Older notices were texts and had no code; such a text
-- may begin with "information: ".
CREATE VIEW v_runs AS
SELECT run.id AS run, run.axis, coalesce(e.state, 'open') AS state, run.simulated,
       coalesce(e.state = 'partial' OR EXISTS (
         SELECT 1 FROM json_each(e.warnings) AS n WHERE CASE n.type
           WHEN 'object' THEN json_extract(n.value, '$.severity') <> 'information'
           ELSE n.value NOT LIKE 'information: %' END), 0) AS doubtful,
       u.noise_only, u.not_declared AS u_not_declared,
       run.started_utc, run.note, run.supersedes,
       (SELECT min(later.id) FROM run AS later WHERE later.supersedes = run.id) AS superseded_by,
       run.model, run.moves, run.travel,
       (SELECT count(*) FROM point AS p WHERE p.id BETWEEN run.id << 32 AND (run.id << 32) + 4294967295)
         AS points,
       e.scans, CASE WHEN r.kind = 'csv' AND e.scans_lost = 0 THEN NULL ELSE e.scans_lost END AS scans_lost,
       t.mean_C AS temperature_mean_C, t.min_C AS temperature_min_C, t.max_C AS temperature_max_C,
       r.kind AS recording_kind, r.path AS recording_path, r.sha256 AS recording_sha256,
       e.result_sha256, run.software_version, coalesce(e.warnings, '[]') AS notices
FROM run LEFT JOIN run_end AS e ON e.run = run.id
JOIN recording AS r ON r.id = coalesce(e.recording, run.recording)
LEFT JOIN run_temperature AS t ON t.run = run.id LEFT JOIN run_uncertainty AS u ON u.run = run.id;

CREATE VIEW v_points AS
SELECT p.run, run.axis, p.row, p.target, 1e3 * p.target_m AS target_mm, p.repetition AS pass, p.direction,
       1e3 * p.position_m AS position_mm, p.begin_ns, p.end_ns, p.samples, p.flags, p.reason
FROM run JOIN point AS p ON p.id BETWEEN run.id << 32 AND (run.id << 32) + 4294967295;

-- For each error of an axis: its column in v_point, and the sign of the error in this column (schema/axis.h).
CREATE VIEW v_error_name (axis, place, error, local, sign) AS
VALUES ('X', 0, 'EYX', 'dy', 1), ('X', 1, 'EZX', 'dz', 1), ('X', 2, 'EAX', 'ex', 1), ('X', 3, 'EBX', 'ey', 1),
       ('X', 4, 'ECX', 'ez', 1),
       ('Y', 0, 'EXY', 'dy', -1), ('Y', 1, 'EZY', 'dz', 1), ('Y', 2, 'EAY', 'ey', -1), ('Y', 3, 'EBY', 'ex', 1),
       ('Y', 4, 'ECY', 'ez', 1),
       ('Z', 0, 'EXZ', 'dy', 1), ('Z', 1, 'EYZ', 'dz', 1), ('Z', 2, 'EAZ', 'ey', 1), ('Z', 3, 'EBZ', 'ez', 1),
       ('Z', 4, 'ECZ', 'ex', 1);

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
      JOIN v_error_name AS n ON n.axis = p.axis
      LEFT JOIN point_uncertainty AS u ON u.run = p.run AND u.row = p.row);

-- One row for each table, position, approach and error. The numbers of a table are one BLOB of doubles, one series
-- after the other (001_runs.sql, 011_imported.sql). `h` is a double in hexadecimal, its lowest byte first. Its last
-- four digits contain sign and exponent; here, 0 is the only number with the exponent 0.
CREATE VIEW v_table_numbers AS
WITH RECURSIVE
counts AS (SELECT id, length(position_m) / 8 AS n, length(errors_m_rad) / length(position_m) AS series
           FROM compensation_table WHERE length(position_m) > 0),
places (i) AS (SELECT 0 UNION ALL SELECT i + 1 FROM places WHERE i + 1 < (SELECT max(n) FROM counts)),
whats (what, approach, place) AS (
  SELECT what, approach, place FROM (SELECT 'value' AS what UNION ALL SELECT 'random' UNION ALL SELECT 'declared')
  JOIN (SELECT 'forward' AS approach UNION ALL SELECT 'reverse')
  JOIN (SELECT 0 AS place UNION ALL SELECT 1 UNION ALL SELECT 2 UNION ALL SELECT 3 UNION ALL SELECT 4
        UNION ALL SELECT 5)),
wanted AS (
  SELECT c.id, p.i, c.n, w.what, w.approach, w.place,
         CASE WHEN w.place < 5 THEN CASE w.what WHEN 'value' THEN 0 WHEN 'random' THEN 10 ELSE 20 END
                + CASE WHEN w.what <> 'declared' AND w.approach = 'reverse' THEN 5 ELSE 0 END + w.place
              ELSE CASE WHEN c.series IN (25, 30) THEN 25 ELSE 20 END
                + CASE w.what WHEN 'value' THEN 0 WHEN 'random' THEN 2 ELSE 4 END
                + CASE WHEN w.what <> 'declared' AND w.approach = 'reverse' THEN 1 ELSE 0 END END AS s
  FROM counts AS c JOIN places AS p ON p.i < c.n JOIN whats AS w
  WHERE (w.place < 5 OR c.series IN (24, 30)) AND (w.what <> 'declared' OR c.series IN (25, 30))),
bytes AS (
  SELECT w.id, w.i, w.what, w.approach, w.place, hex(substr(t.errors_m_rad, 8 * (w.s * w.n + w.i) + 1, 8)) AS h
  FROM wanted AS w JOIN compensation_table AS t ON t.id = w.id
  UNION ALL
  SELECT c.id, p.i, 'position', NULL, NULL, hex(substr(t.position_m, 8 * p.i + 1, 8))
  FROM counts AS c JOIN places AS p ON p.i < c.n JOIN compensation_table AS t ON t.id = c.id),
parts AS (
  SELECT id, i, what, approach, place, instr('123456789ABCDEF', substr(h, 15, 1)) AS top,
         (instr('123456789ABCDEF', substr(h, 15, 1)) & 7) * 256 + instr('123456789ABCDEF', substr(h, 16, 1)) * 16
           + instr('123456789ABCDEF', substr(h, 13, 1)) AS e,
         (instr('123456789ABCDEF', substr(h, 14, 1)) << 48)
           + (instr('123456789ABCDEF', substr(h, 11, 1)) << 44) + (instr('123456789ABCDEF', substr(h, 12, 1)) << 40)
           + (instr('123456789ABCDEF', substr(h, 9, 1)) << 36) + (instr('123456789ABCDEF', substr(h, 10, 1)) << 32)
           + (instr('123456789ABCDEF', substr(h, 7, 1)) << 28) + (instr('123456789ABCDEF', substr(h, 8, 1)) << 24)
           + (instr('123456789ABCDEF', substr(h, 5, 1)) << 20) + (instr('123456789ABCDEF', substr(h, 6, 1)) << 16)
           + (instr('123456789ABCDEF', substr(h, 3, 1)) << 12) + (instr('123456789ABCDEF', substr(h, 4, 1)) << 8)
           + (instr('123456789ABCDEF', substr(h, 1, 1)) << 4) + instr('123456789ABCDEF', substr(h, 2, 1)) AS m
  FROM bytes)
SELECT id AS compensation_table, i AS row, what, approach, place,
       CASE e WHEN 0 THEN 0.0 WHEN 2047 THEN NULL
         ELSE CASE WHEN top >= 8 THEN -1.0 ELSE 1.0 END * (4503599627370496 + m) * pow(2.0, e - 1075) END AS x
FROM parts;

CREATE VIEW v_tables AS
WITH n AS (
  SELECT compensation_table, row, approach, place, max(CASE what WHEN 'value' THEN x END) AS value,
         max(CASE what WHEN 'random' THEN x END) AS random, max(CASE what WHEN 'declared' THEN x END) AS declared
  FROM v_table_numbers WHERE what <> 'position' GROUP BY compensation_table, row, approach, place),
all_u AS (SELECT n.*, CASE WHEN declared IS NULL THEN random ELSE sqrt(random * random + declared * declared) END
                 AS u FROM n),
changes AS (SELECT axis, compensation_table, generation FROM activation
            UNION ALL SELECT axis, NULL, generation FROM deactivation)
SELECT t.id AS table_number, t.axis, t.simulated, t.slope_removed, t.created_utc, t.sha256,
       t.id IS (SELECT c.compensation_table FROM changes AS c WHERE c.axis = t.axis
                ORDER BY c.generation DESC LIMIT 1) AS active,
       a.row, 1e3 * p.x AS position_mm, a.approach, coalesce(e.error, 'E' || t.axis || t.axis) AS error,
       CASE WHEN a.place IN (0, 1, 5) THEN 1e6 * a.value END AS value_um,
       CASE WHEN a.place IN (0, 1, 5) THEN 1e6 * a.u END AS u_um,
       CASE WHEN a.place IN (2, 3, 4) THEN 1e6 * a.value END AS value_urad,
       CASE WHEN a.place IN (2, 3, 4) THEN 1e6 * a.u END AS u_urad
FROM compensation_table AS t JOIN all_u AS a ON a.compensation_table = t.id
JOIN v_table_numbers AS p ON p.compensation_table = t.id AND p.row = a.row AND p.what = 'position'
LEFT JOIN v_error_name AS e ON e.axis = t.axis AND e.place = a.place;
