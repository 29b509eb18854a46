"""A machine, a target and one indicator, for the tests of mdof separate. The readings come from bodies that are rotated and
shifted by 4x4 matrices. This file uses no code of mdof."""
import fractions
import math
import pathlib
import random
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from mdof_runner import run


CHECK_FAILED, USAGE, BAD_INPUT = 1, 2, 3
LETTERS = "XYZ"
SIDE = ("--surface", "side", "--moves", "target")  # options for readings in files
BAR_UM = 0.020


def profile(c):
    """The shape of the target in m, as a function of the position in m. Its range is 1 µm; it contains a parabola."""
    return 1e-6 * (.32 * math.sin(2 * math.pi * (c / .043 + .2)) + .12 * math.sin(2 * math.pi * (c / .0171 + .65))
                   - 320 * (c + .02) ** 2)


def machine(p):
    return 1e-6 * (1.3 * math.sin(2 * math.pi * (p / .051 + .1)) + .3 * math.sin(2 * math.pi * (p / .019)) + 500 * p * p)


def half_turn(about):
    """The diagonal of a rotation matrix of 180 degrees about an axis: 1 for this axis, -1 for the others."""
    return [1 if letter == about else -1 for letter in LETTERS]


class Bench:
    """An axis with a target and one indicator. The surface of the target is a curve along the motion, on the side of `normal`. The
    target is rotated by 180 degrees about an axis through the place `at` on the motion, and then shifted along the motion."""

    def __init__(self, axis, normal, moves="target", travel="+", indicator_at=0.0):
        self.motion, self.normal = LETTERS.index(axis), LETTERS.index(normal)
        self.fixture, self.back, self.indicator_at = moves == "fixture", travel == "-", indicator_at

    def reading(self, position, about=None, at=0.0, shift=0.0):
        """The error of the moving body as the indicator shows it, in m."""
        went = -position if self.back else position  # position of the moving body, along + of the axis
        target_went = -went if self.fixture else went
        in_carriage = self.indicator_at - target_went - shift
        signs = half_turn(about) if about else [1, 1, 1]
        in_target = at + signs[self.motion] * (in_carriage - at)  # a rotation by 180 degrees is its own inverse
        bump = signs[self.normal] * profile(in_target)  # along + of the normal
        body = machine(position)
        seen = (-body if self.fixture else body) + bump  # position of the surface, along + of the normal
        return -seen if self.fixture else seen

    def true_place(self, position):
        went = -position if self.back else position
        return self.indicator_at - (-went if self.fixture else went)


def less(values, shapes):
    """Removes the shapes from the values by least squares."""
    square = []
    for v in [*shapes, values]:
        for s in square * 2:
            f = sum(a * b for a, b in zip(v, s))
            v = [a - f * b for a, b in zip(v, s)]
        norm = math.sqrt(sum(a * a for a in v))
        square.append([a / norm for a in v])
    return v


def line(x):
    return [[1.0] * len(x), list(x)]


def worst(a, b):
    assert len(a) == len(b)
    return max(abs(p - q) for p, q in zip(a, b))


def exact_rank(rows):
    """The rank, by elimination with whole numbers."""
    rows = [[fractions.Fraction(v) for v in row] for row in rows]
    rank = 0
    for column in range(len(rows[0])):
        pivot = next((r for r in range(rank, len(rows)) if rows[r][column]), None)
        if pivot is None:
            continue
        rows[rank], rows[pivot] = rows[pivot], rows[rank]
        for r in range(rank + 1, len(rows)):
            f = rows[r][column] / rows[rank][column]
            if f:
                rows[r] = [a - f * b for a, b in zip(rows[r], rows[rank])]
        rank += 1
    return rank


class SetUps(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def file(self, name, positions, readings, u_um=None, noise_um=0.0, line_um=(0.0, 0.0)):
        source = random.Random(name)
        path = self.folder / name
        text = "position_mm,deviation_um" + (",u_um\n" if u_um else "\n")
        for p, e in zip(positions, readings):
            e = e * 1e6 + line_um[0] + line_um[1] * p + source.gauss(0, noise_um)
            text += f"{p * 1e3:.9f},{e:.12f}" + (f",{u_um}\n" if u_um else "\n")
        path.write_text(text)
        return path

    def files(self, bench, positions, set_ups, **keys):
        return [self.file(f"{k}.csv", positions, [bench.reading(p, **s) for p in positions],
                          line_um=(3.0 * k, 20.0 * k), **keys) for k, s in enumerate(set_ups)]

    def refused(self, code, says, *arguments):
        got, out, err = run("separate", *arguments)
        self.assertEqual((got, out), (code, ""), err)
        self.assertIn(says, err)

    def seen(self, series, key):
        return [row[key] * 1e-3 for row in series["places"]], [row["seen_um"] for row in series["places"]]
