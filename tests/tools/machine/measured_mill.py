"""A simulated machine with the axes X and Y, made of matrices (machine_model.py, which uses no code of mdof). Five
probes and a laser measure it."""
import csv
import math
import pathlib
import random
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import machine_model as model
from mdof_runner import run, run_json

TARGETS = [2e-3 * i for i in range(21)]
TOOL = (.006, -.004, -.030)  # m; 30 mm below the fixture, so that angles have a lever arm
TOML = """name = "mill"
squareness = "latest"
machine = {chain = "w-X-b-Y-t"}
tool = {point_mm = [6, -4, -30]}
[[axis]]
id = "X"
holds_at_mm = [0, 0, 0]
point = "standing"
runs = "latest"
[[axis]]
id = "Y"
holds_at_mm = [0, 0, 0]
point = "moving"
runs = "latest"
"""


class Mill:
    """X moves the workpiece, Y moves the tool. The line of Y has the error EC0Y. `against`: axes whose body moves
    to - as the command increases."""

    def __init__(self, seed, against="", EC0Y=120e-6):
        source = random.Random(seed)
        self.EC0Y = EC0Y
        self.way = {axis: -1 if axis in against else 1 for axis in "XY"}
        self.waves = {axis: model.Waves(source) for axis in "XY"}
        self.along = {"X": (5e-6, .031), "Y": (-4e-6, .047)}

    def pose(self, axis, command):
        travel = self.way[axis] * command
        body = model.pose(axis, travel, self.waves[axis].at(travel))
        size, length = self.along[axis]
        own = size * math.sin(2 * math.pi * travel / length)
        shift = (own, 0, 0) if axis == "X" else (-self.EC0Y * travel, own, 0)
        return model.product(model.moved(*shift), body)

    def error(self, x, y, correction=(0, 0), tool=TOOL):
        body = model.product(model.inverse(self.pose("X", x + correction[0])), self.pose("Y", y + correction[1]))
        at = model.applied(body, tool)
        return at[0] - (tool[0] - self.way["X"] * x), at[1] - (tool[1] + self.way["Y"] * y)

    def readings(self, axis, encoder):
        # In X the target moves. In Y the fixture moves, so the target moves in the opposite direction relative to it.
        pose = self.pose(axis, encoder)
        return model.readings(axis, pose if axis == "X" else model.inverse(pose))

    def deviation(self, axis, at):
        """The reading of a laser in m, in the scale of the controller. The laser measures at the reference
        point of the errors on the moving body."""
        way = self.way[axis]
        if axis == "X":
            return way * model.error_at("X", way * at, self.pose("X", at), (0, 0, 0))[0]
        return way * (model.applied(self.pose("Y", at), (0, 0, 0))[1] - way * at)


def worst(errors):
    """Returns the largest error after the workpiece is aligned: a shift and a rotation are removed. errors: (x, y,
    error) in the workpiece."""
    n = len(errors)
    mean = [sum(v) / n for v in zip(*((x, y, *e) for x, y, e in errors))]
    centred = [(x - mean[0], y - mean[1], e[0] - mean[2], e[1] - mean[3]) for x, y, e in errors]
    turn = sum(x * ey - y * ex for x, y, ex, ey in centred) / sum(x * x + y * y for x, y, _, _ in centred)
    return max(math.hypot(ex + turn * y, ey - turn * x) for x, y, ex, ey in centred)


class Grid:
    """The table of corrections from its CSV, with bilinear interpolation."""

    def __init__(self, text):
        rows = list(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))
        self.at = {(float(r["X_mm"]), float(r["Y_mm"])): (float(r["correction_X_um"]), float(r["correction_Y_um"]))
                   for r in rows}
        self.x = sorted({x for x, _ in self.at})
        self.y = sorted({y for _, y in self.at})

    @staticmethod
    def cell(all_of_them, value):
        i = max(k for k, v in enumerate(all_of_them[:-1]) if v <= value or k == 0)
        return i, (value - all_of_them[i]) / (all_of_them[i + 1] - all_of_them[i])

    def correction(self, x, y):
        (i, p), (j, q) = self.cell(self.x, x * 1e3), self.cell(self.y, y * 1e3)
        corners = [(self.at[self.x[i + a], self.y[j + b]], (p if a else 1 - p) * (q if b else 1 - q))
                   for a in (0, 1) for b in (0, 1)]
        return [sum(w * c[k] for c, w in corners) * 1e-6 for k in (0, 1)]


class MeasuredMill(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.database = self.folder / "mdof.db"

    def measure(self, mill, seed, machine="", ways=(1, -1)):
        for axis in "XY":
            extra = (('moves = "fixture"\n' if axis == "Y" else "") + ('travel = "-"\n' if mill.way[axis] < 0 else "") + machine)
            rig = model.write_rig(self.folder / f"{axis}.toml", axis, extra)
            log = self.folder / f"{axis}.csv"
            way = [stop for stop in model.stops(TARGETS, 1)][:None if len(ways) == 2 else len(TARGETS) + 2]
            model.write_log(log, axis, way, lambda at: mill.readings(axis, at), seed=2 * seed + (axis == "Y"),
                            dwell_s=.4, speed_m_s=.05)
            run_json("replay", log, "--rig", rig, "--db", self.database)
            laser = self.folder / f"laser_{axis}.csv"
            laser.write_text("target_mm,direction,run,deviation_um\n" + "".join(
                f"{t * 1e3:g},{way},1,{mill.deviation(axis, t) * 1e6}\n" for way in ways for t in TARGETS))
            code, _, err = run("import", laser, "--axis", axis, "--db", self.database)
            self.assertEqual(code, 0, err)
        across = {"X": lambda t: model.error_at("X", mill.way["X"] * t, mill.pose("X", t), (0, 0, 0))[1],
                  "Y": lambda t: model.applied(mill.pose("Y", t), (0, 0, 0))[0]}
        slopes = [mill.way[axis] * model.slope(TARGETS, [error(t) for t in TARGETS]) for axis, error in across.items()]
        self.assertAlmostEqual(run_json("squareness", 1, 3, "--db", self.database)["EC0Y_urad"] * 1e-6, -sum(slopes), delta=1e-6)

    def describe(self, text=TOML):
        path = self.folder / "machine.toml"
        path.write_text(text)
        return path

    def build(self, *more, text=TOML):
        return run("compensation", "build", "--machine", self.describe(text), "--plane", "XY", "--step-mm", 2,
                   "--db", self.database, *more)

    def left(self, mill, grid=None, sign=1):
        source = random.Random(5)
        errors = []
        for _ in range(300):
            x, y = source.uniform(0, .04), source.uniform(0, .04)
            c = grid.correction(x, y) if grid else (0, 0)
            errors.append((-mill.way["X"] * x, mill.way["Y"] * y, mill.error(x, y, [sign * k for k in c])))
        return worst(errors)

    def table(self, number):
        code, out, err = run("compensation", "show", number, "--csv", "--db", self.database)
        self.assertEqual(code, 0, err)
        return Grid(out)
