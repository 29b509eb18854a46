"""An independent simulation of the machine of Hwang, Song and Park: 400 x 400 mm, X moves the tool, Y moves the
workpiece. It uses no code of mdof. Bodies are 4x4 matrices (lists), and the instruments read what a laser
interferometer would read."""
import math

WIDTH = 400.0      # mm
CENTRE = 200.0


def product(*matrices):
    result = matrices[0]
    for m in matrices[1:]:
        result = [[sum(a * b for a, b in zip(row, column)) for column in zip(*m)] for row in result]
    return result


def shift(x, y, z):
    return [[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z], [0, 0, 0, 1]]


def turn(a, b, c):
    ca, sa, cb, sb, cc, sc = math.cos(a), math.sin(a), math.cos(b), math.sin(b), math.cos(c), math.sin(c)
    x = [[1, 0, 0, 0], [0, ca, -sa, 0], [0, sa, ca, 0], [0, 0, 0, 1]]
    y = [[cb, 0, sb, 0], [0, 1, 0, 0], [-sb, 0, cb, 0], [0, 0, 0, 1]]
    z = [[cc, -sc, 0, 0], [sc, cc, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
    return product(z, y, x)


def rigid_inverse(m):
    rotation = [[m[j][i] for j in range(3)] for i in range(3)]
    back = [-sum(rotation[i][j] * m[j][3] for j in range(3)) for i in range(3)]
    return [[*rotation[i], back[i]] for i in range(3)] + [[0, 0, 0, 1]]


class Machine:
    """The errors in mm and rad for commands in mm. The errors are about as large as in the paper before compensation.
    `angles`: factor of the angular errors."""

    def __init__(self, angles=1.0, square=25e-6):
        self.angles, self.square = angles, square

    def of_axis(self, p, phase, along, across):
        wave = lambda period, at: math.sin(2 * math.pi * (p / period + at + phase))
        run = (p - CENTRE) / CENTRE
        return {"along": 1e-3 * (along * run + 0.5 * wave(190, 0.2)), "across": 1e-3 * (across * wave(410, 0.1) + 0.15 * wave(130, 0.4)),
                "up": 1e-3 * 0.3 * wave(300, 0.3), "turns": [self.angles * 1e-6 * s * wave(350, q) for s, q in ((1.5, 0), (2, .3), (2, .6))]}

    def tool_in_work(self, x, y):
        """X moves the tool. Y moves the workpiece; its table moves to - as the command increases."""
        ex, ey = self.of_axis(x, 0.0, 4.5, 0.8), self.of_axis(y, 0.37, -3.5, 0.7)
        c = (CENTRE, CENTRE, 0.0)  # reference point of the errors: the middle of the table
        carriage = product(shift(c[0] + x + ex["along"], c[1] + ex["across"], ex["up"]), turn(*ex["turns"]),
                           shift(-c[0] , -c[1], 0))
        went = -y
        table = product(shift(c[0] + ey["across"], c[1] + ey["along"], ey["up"]), turn(*ey["turns"]),
                        shift(-c[0], -c[1], 0), shift(-math.sin(self.square) * went, math.cos(self.square) * went, 0))
        tool = product(carriage, shift(0, 0, 0))
        there = product(rigid_inverse(table), tool)
        return [there[i][3] for i in range(3)]

    def error(self, x, y):
        """Error of the tool at (x, y) in the workpiece, in µm."""
        at = self.tool_in_work(x, y)
        return [(at[0] - x) * 1e3, (at[1] - y) * 1e3]
