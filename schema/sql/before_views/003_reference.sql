-- Reference point of the results, moving body and its direction (schema/rig/reference.h, sides.h, chain.h). Results
-- from before this step are stated at the carriage; their target moves in the + direction.

ALTER TABLE run ADD COLUMN moves TEXT NOT NULL DEFAULT 'target' CHECK (moves IN ('target', 'fixture'));
ALTER TABLE run ADD COLUMN travel TEXT NOT NULL DEFAULT '+' CHECK (travel IN ('+', '-'));
-- Reference point of the rows in point, straightness and angle.
ALTER TABLE run ADD COLUMN reference TEXT NOT NULL DEFAULT 'carriage'
  CHECK (reference IN ('fixture', 'carriage'));

-- Before this step, u_EC0Y_rad contained the value that is now in form_rad: it states how well a line describes the
-- axes.
ALTER TABLE squareness ADD COLUMN form_rad ANY;
ALTER TABLE squareness ADD COLUMN u_artefact_rad ANY;
ALTER TABLE squareness ADD COLUMN artefact_corner INTEGER NOT NULL DEFAULT 0;
ALTER TABLE squareness ADD COLUMN reference TEXT NOT NULL DEFAULT 'carriage';

ALTER TABLE compensation_table ADD COLUMN moves TEXT NOT NULL DEFAULT 'target';
ALTER TABLE compensation_table ADD COLUMN travel TEXT NOT NULL DEFAULT '+';
ALTER TABLE compensation_table ADD COLUMN reference TEXT NOT NULL DEFAULT 'carriage'
  CHECK (reference IN ('fixture', 'carriage', 'tool'));
ALTER TABLE compensation_table ADD COLUMN point_m BLOB;  -- 3 doubles; NULL in a table from before
ALTER TABLE compensation_table ADD COLUMN chain TEXT NOT NULL DEFAULT '';         -- not known
ALTER TABLE compensation_table ADD COLUMN chain_travel TEXT NOT NULL DEFAULT '';  -- "X+ Y- Z+"

-- For SQL users and notebooks: one row for each point, at the fixture, with ISO 230-1 names of the moving body, in µm
-- and µrad. For a run that is stated at the carriage, the values are a first-order approximation: the error is 0.1 nm
-- at 1 mrad and 100 mm.
DROP VIEW v_points_x;
DROP VIEW v_points_y;
DROP VIEW v_points_z;
CREATE VIEW v_point AS
SELECT run.id AS run, run.axis, p.row, p.target, p.repetition, p.direction,
       1e3 * p.position_m AS position_mm,
       CASE run.moves WHEN 'fixture' THEN -1e6 ELSE 1e6 END AS micro,
       dy_m - CASE run.reference WHEN 'carriage' THEN position_m * ez_rad ELSE 0 END AS dy_m,
       dz_m + CASE run.reference WHEN 'carriage' THEN position_m * ey_rad ELSE 0 END AS dz_m,
       ex_rad, ey_rad, ez_rad, p.samples, p.flags, p.reason
FROM run JOIN point AS p ON p.id BETWEEN run.id << 32 AND (run.id << 32) + 4294967295;
CREATE VIEW v_points_x AS
SELECT run, row, target, repetition, direction, position_mm,
       micro * dy_m AS EYX_um, micro * dz_m AS EZX_um,
       micro * ex_rad AS EAX_urad, micro * ey_rad AS EBX_urad, micro * ez_rad AS ECX_urad,
       samples, flags, reason
FROM v_point WHERE axis = 'X';
CREATE VIEW v_points_y AS
SELECT run, row, target, repetition, direction, position_mm,
       -micro * dy_m AS EXY_um, micro * dz_m AS EZY_um,
       -micro * ey_rad AS EAY_urad, micro * ex_rad AS EBY_urad, micro * ez_rad AS ECY_urad,
       samples, flags, reason
FROM v_point WHERE axis = 'Y';
CREATE VIEW v_points_z AS
SELECT run, row, target, repetition, direction, position_mm,
       micro * dy_m AS EXZ_um, micro * dz_m AS EYZ_um,
       micro * ey_rad AS EAZ_urad, micro * ez_rad AS EBZ_urad, micro * ex_rad AS ECZ_urad,
       samples, flags, reason
FROM v_point WHERE axis = 'Z';
