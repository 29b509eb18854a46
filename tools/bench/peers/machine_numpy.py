#!/usr/bin/python3
"""Calculates the budget of bench_machine with vectorised NumPy on one thread: 84 uniformly distributed part errors, the
complete product of 14 frames. stdin is the nominal machine from `bench_machine --frames`, so that both programs use the
same machine. There are two ways:
- the product of 4x4 matrices, as in Eq. 8 and 10 of the paper; mdof must be at least 20 times as fast as this way
- the fastest known way: plane rotations transform the tool point from frame to frame, in place in buffers that are
  created once
Prints ns per trial for the best array size, and the same figures as bench_machine, first with the matrices.
  bench_machine --frames | machine_numpy.py [TRIALS]
"""
import sys
import time

import numpy as np

SHIFT, TURN = 1e-6, 50e-6  # half widths, m and rad
FRAMES = [(row[0] == 1, row[1:10].reshape(3, 3), row[10:13], row[13:16]) for row in np.loadtxt(sys.stdin)]


class Machine:
    def __init__(self, m):
        self.rng = np.random.Generator(np.random.Philox(1))
        self.e = [np.empty(m) for _ in range(6)]
        self.p = [np.empty(m) for _ in range(3)]
        self.t = [np.empty(m) for _ in range(4)]

    def turn(self, angle, u, v, sense):
        """Rotates (u, v) by the angle, in place."""
        s, c, a, b = self.t
        np.sin(angle, out=s)
        np.cos(angle, out=c)
        np.multiply(c, u, out=a)
        np.multiply(s, v, out=b)
        if sense < 0:
            a += b
        else:
            a -= b
        u *= s
        v *= c
        if sense < 0:
            v -= u
        else:
            v += u
        u[:] = a

    def nominal(self, R, move):
        """R p + move for all points. Most frames have no rotation R."""
        if not np.array_equal(R, np.eye(3)):
            old = [x.copy() for x in self.p]
            for i in range(3):
                np.multiply(old[0], R[i, 0], out=self.p[i])
                for j in (1, 2):
                    if R[i, j]:
                        self.p[i] += R[i, j] * old[j]
        for x, by in zip(self.p, move):
            if by:
                x += by

    def run(self):
        for x in self.p:
            x.fill(0)
        for work, R, move, point in FRAMES:
            for k, x in enumerate(self.e):
                self.rng.random(out=x)
                half = SHIFT if k < 3 else TURN
                x *= 2 * half
                x -= half
            if work:
                for x, q, e in zip(self.p, point, self.e):
                    x -= e
                    x -= q
                for i in (2, 1, 0):
                    self.turn(self.e[3 + i], self.p[(i + 1) % 3], self.p[(i + 2) % 3], -1)
                for x, q in zip(self.p, point):
                    x += q
                self.nominal(R.T, -(R.T @ move))
            else:
                self.nominal(R, move)
                for x, q in zip(self.p, point):
                    x -= q
                for i in range(3):
                    self.turn(self.e[3 + i], self.p[(i + 1) % 3], self.p[(i + 2) % 3], 1)
                for x, q, e in zip(self.p, point, self.e):
                    x += q
                    x += e
        return self.p


class Matrices:
    def __init__(self, m):
        self.rng = np.random.Generator(np.random.Philox(1))
        self.m = m

    def errors(self):
        """Matrices of random errors: Rz(c) Ry(b) Rx(a) and a shift."""
        half = np.array([SHIFT] * 3 + [TURN] * 3)[:, None]
        e = (self.rng.random((6, self.m)) * 2 - 1) * half
        (sa, sb, sc), (ca, cb, cc) = np.sin(e[3:]), np.cos(e[3:])
        M = np.zeros((self.m, 4, 4))
        M[:, 0, 0], M[:, 0, 1], M[:, 0, 2] = cb * cc, cc * sa * sb - ca * sc, sa * sc + ca * cc * sb
        M[:, 1, 0], M[:, 1, 1], M[:, 1, 2] = cb * sc, ca * cc + sa * sb * sc, ca * sb * sc - cc * sa
        M[:, 2, 0], M[:, 2, 1], M[:, 2, 2] = -sb, cb * sa, ca * cb
        M[:, :3, 3] = e[:3].T
        M[:, 3, 3] = 1
        return M

    def body(self, frames):
        """The product of the frames from the bed outwards."""
        product = np.broadcast_to(np.eye(4), (self.m, 4, 4))
        for _, R, move, point in frames:
            to, back, nominal = np.eye(4), np.eye(4), np.eye(4)
            to[:3, 3], back[:3, 3] = point, -point
            nominal[:3, :3], nominal[:3, 3] = R, move
            product = product @ (to @ self.errors() @ (back @ nominal))
        return product

    def run(self):
        tool = self.body([f for f in reversed(FRAMES) if not f[0]])
        work = self.body([f for f in FRAMES if f[0]])
        return np.einsum("nji,nj->in", work[:, :3, :3], tool[:, :3, 3] - work[:, :3, 3])


def nominal_end():
    p = np.zeros(3)
    for work, R, move, _ in FRAMES:
        p = R.T @ (p - move) if work else R @ p + move
    return p


def budget(way, trials, m, end):
    machine = way(m)
    out = np.empty((4, trials // m * m))
    for i in range(trials // m):
        part = out[:, i * m:(i + 1) * m]
        for k, x in enumerate(machine.run()):
            np.subtract(x, end[k], out=part[k])
        part[:3] *= 1e6
        np.sqrt(np.einsum("ij,ij->j", part[:3], part[:3]), out=part[3])
    figures = out.mean(axis=1), out.std(axis=1), out.min(axis=1), out.max(axis=1)
    q = [0.025, 0.5, 0.95, 0.975]
    return figures, np.quantile(out, q, axis=1), out.shape[1]


def main():
    trials = int(float(sys.argv[1])) if len(sys.argv) > 1 else 1_000_000
    end = nominal_end()
    for name, way in (("matrices", Matrices), ("plane rotations of the point", Machine)):
        best = None
        for m in (1000, 4000, 10_000, 50_000):
            if m > trials:
                continue
            begin = time.process_time()
            figures, quantiles, n = budget(way, trials, m, end)
            took = (time.process_time() - begin) / n * 1e9
            if best is None or took < best[0]:
                best = took, m, figures[1], quantiles[2][3]
        ns, m, sd, p95 = best
        print(f"numpy {np.__version__}, {name}: {ns:.1f} ns a trial, {m} trials at once; "
              f"sd {sd[0]:.4f} {sd[1]:.4f} {sd[2]:.4f} µm, 95 % of the volume {p95:.4f} µm")


if __name__ == "__main__":
    main()
