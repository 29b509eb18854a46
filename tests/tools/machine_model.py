"""A numeric model of a machine with a five-probe fixture: bodies are 4x4 matrices, probes are lines that meet
planes.

Shares no code and no formula with mdof, because tests compare with it. Metres and radians; machine axes."""
import math
import random

# The default fixture (five-probe/rig_X.toml, rig_Y.toml). For each probe: a point of its line, its direction, the
# normal of its plane, and the offset of the plane.
PROBES = {
    "X": {"A": ((.01, 0, 0), "z"), "B": ((0, .01, 0), "z"), "C": ((0, -.01, 0), "z"),
          "D": ((0, .015, .02), "y"), "E": ((.01, .015, .02), "y")},
    "Y": {"A": ((0, .01, 0), "z"), "B": ((-.01, 0, 0), "z"), "C": ((.01, 0, 0), "z"),
          "D": ((-.015, 0, .02), "-x"), "E": ((-.015, .01, .02), "-x")},
    "Z": {"A": ((0, 0, .01), "y"), "B": ((.01, 0, 0), "y"), "C": ((-.01, 0, 0), "y"),  # as X, axes permuted cyclically
          "D": ((.015, .02, 0), "x"), "E": ((.015, .02, .01), "x")},
}
DIRECTION = {"z": (0, 0, 1), "x": (1, 0, 0), "y": (0, 1, 0), "-x": (-1, 0, 0)}


def product(a, b):
    columns = list(zip(*b))
    return [[i * p + j * q + k * r + l * s for p, q, r, s in columns] for i, j, k, l in a]


def moved(x=0.0, y=0.0, z=0.0):
    return [[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z], [0, 0, 0, 1]]


def turned(a, b, c):
    """Rotation matrix about the axes of the machine; A acts first."""
    sa, ca, sb, cb, sc, cc = (f(t) for t in (a, b, c) for f in (math.sin, math.cos))
    rx = [[1, 0, 0, 0], [0, ca, -sa, 0], [0, sa, ca, 0], [0, 0, 0, 1]]
    ry = [[cb, 0, sb, 0], [0, 1, 0, 0], [-sb, 0, cb, 0], [0, 0, 0, 1]]
    rz = [[cc, -sc, 0, 0], [sc, cc, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
    return product(rz, product(ry, rx))


def inverse(pose):
    r = [[pose[j][i] for j in range(3)] for i in range(3)]
    t = [-sum(r[i][k] * pose[k][3] for k in range(3)) for i in range(3)]
    return [r[0] + [t[0]], r[1] + [t[1]], r[2] + [t[2]], [0, 0, 0, 1]]


def applied(pose, p):
    return tuple(i * p[0] + j * p[1] + k * p[2] + shift for i, j, k, shift in pose[:3])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def reading(in_C, point, direction):
    """Distance from `point` along the probe's direction to the plane of the target. The plane is fixed in the frame
    C of the carriage and perpendicular to the probe's direction. If C = M, the plane contains `point`. in_C: pose
    that transforms from M into C."""
    offset = dot(direction, point)
    p = applied(in_C, point)
    u = [sum(in_C[i][k] * direction[k] for k in range(3)) for i in range(3)]
    return (offset - dot(direction, p)) / dot(direction, u)


def readings(axis, pose_MC):
    """Readings of all probes in the order of the columns, in m."""
    in_C = inverse(pose_MC)
    return [reading(in_C, point, DIRECTION[way]) for point, way in PROBES[axis].values()]


def pose(axis, travel, errors):
    """Pose of C in M. `errors`: two straightness errors of the origin of C, and the angles A, B, C of the target;
    m, rad."""
    first, second, a, b, c = errors
    shift = {"X": (travel, first, second), "Y": (first, travel, second), "Z": (first, second, travel)}[axis]
    return product(moved(*shift), turned(a, b, c))


def error_at(axis, travel, pose_MC, point):
    """Error of a point of the target in m. Its nominal position in M is `point`."""
    along = {"X": (1, 0, 0), "Y": (0, 1, 0), "Z": (0, 0, 1)}[axis]
    nominal = tuple(p - travel * u for p, u in zip(point, along))
    return tuple(x - p for x, p in zip(applied(pose_MC, nominal), point))


class Waves:
    """Smooth random errors over a travel: two straightness errors and three angles."""

    def __init__(self, source, straightness_m=3e-6, angle_rad=100e-6, length_m=0.06):
        self.parts = [[((straightness_m if k < 2 else angle_rad) * source.uniform(.2, 1) / (i + 1),
                        (i + .5) / length_m, source.uniform(0, 1)) for i in range(3)] for k in range(5)]

    def at(self, travel):
        return [sum(a * (math.sin(2 * math.pi * (f * travel + p)) - math.sin(2 * math.pi * p))
                    for a, f, p in part) for part in self.parts]


def stops(targets_m, repeats, overrun_m=1e-3):
    """Positions of a standard cycle, forward and back, with overruns at both ends. The axis passes the positions
    with None without a stop."""
    for _ in range(repeats):
        yield targets_m[0] - overrun_m, False
        for t in targets_m:
            yield t, True
        yield targets_m[-1] + overrun_m, False
        for t in reversed(targets_m):
            yield t, True
    yield targets_m[0] - overrun_m, False


def write_log(path, axis, way, readings_at, rate_hz=500, dwell_s=0.3, speed_m_s=0.03, noise_m=5e-9,
              encoder_noise_m=1e-8, seed=1):
    """Writes a probe log along `way`, a list of (encoder position, whether the axis stops there).
    readings_at(encoder_m) returns the readings in m."""
    source = random.Random(seed)
    gauss, lines, at, time = source.gauss, [], None, 0.0
    step = speed_m_s / rate_hz

    def row(position, values):
        nonlocal time
        lines.append(",".join([f"{time:.4f}", f"{(position + gauss(0, encoder_noise_m)) * 1e3:.6f}"] +
                              [f"{(v + gauss(0, noise_m)) * 1e6:.4f}" for v in values]))
        time += 1 / rate_hz

    for position, dwells in way:
        at = position if at is None else at
        n = int(abs(position - at) / step)
        for i in range(1, n + 1):
            here = at + (position - at) * i / (n + 1)
            row(here, readings_at(here))
        at = position
        if not dwells:
            continue
        values = readings_at(at)
        for _ in range(int(dwell_s * rate_hz)):
            row(at, values)
    with open(path, "w") as out:
        out.write(f"# axis: {axis}\ntime_s,encoder_mm," +
                  ",".join(f"{k}_um" for k in PROBES[axis]) + "\n" + "\n".join(lines) + "\n")


def write_rig(path, axis, extra="", range_um=400):
    """Writes the default fixture as a rig. `extra` is inserted before the probes."""
    named = {"z": "+Z", "y": "+Y", "x": "+X", "-x": "-X"}
    text = f'name = "model"\naxis = "{axis}"\n{extra}\n'
    for probe, (point, way) in PROBES[axis].items():
        text += (f'[[probe]]\nid = "{probe}"\nposition_mm = [{", ".join(f"{p * 1e3:g}" for p in point)}]\n'
                 f'measures = "{named[way]}"\nrange_um = {range_um}\n')
    path.write_text(text)
    return path


def slope(x, y):
    """Slope of the least-squares line through the points."""
    mean_x, mean_y = sum(x) / len(x), sum(y) / len(y)
    return (sum((a - mean_x) * (b - mean_y) for a, b in zip(x, y))
            / sum((a - mean_x) ** 2 for a in x))
