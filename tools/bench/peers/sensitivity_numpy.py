#!/usr/bin/python3
"""Simulation I in vectorised NumPy on one thread, as fast as possible with NumPy: the peer of mdof.

Prints ns per trial for the best array size, first with histograms (like mdof: equal bins, np.bincount, constant
memory), then with all trials kept and partitioned (exact quantiles, no constant memory). All work is in place in
buffers that are created once; random numbers come from NumPy's Philox.
Statistics over all trials and in each of 20 bins of travel: mean, sd, min, max, quantiles, symmetric and shortest
95 % interval.
  sensitivity_numpy.py [TRIALS]
"""
import sys
import time

import numpy as np

A, B, TRAVEL = 1e-3, 50e-6, 60e-3  # rad, m, m
L, UP = 10e-3, 20e-3
BINS, CORE = 20, 8192
QUANTILES = (0.025, 0.25, 0.5, 0.75, 0.975)


class Simulation:
    """Simulates m trials in each bin of travel. The arrays have one row for each bin."""

    def __init__(self, m, seed=1):
        self.rng = np.random.Generator(np.random.Philox(seed))
        self.shape = (BINS, m)
        self.start = (np.arange(BINS) * (TRAVEL / BINS))[:, None]
        self.drawn = [np.empty(self.shape) for _ in range(6)]
        self.out = [np.empty(self.shape) for _ in range(5)]
        self.t = [np.empty(self.shape) for _ in range(8)]

    def run(self):
        """Errors of EYX, EZX in µm and EAX, EBX, ECX in µrad."""
        d, dy, dz, ex, ey, ez = self.drawn
        for x in self.drawn:
            self.rng.random(out=x)
        d *= TRAVEL / BINS
        d += self.start
        for x, half in ((dy, B), (dz, B), (ex, A), (ey, A), (ez, A)):
            x *= 2 * half
            x -= half
        w, p, q, a, b, c, e, f = self.t
        multiply, add, subtract = np.multiply, np.add, np.subtract
        # p = (ey + ex ez) / (1 + ez²), q = (ex - ey ez) / (1 + ez²)
        multiply(ez, ez, out=w)
        w += 1
        multiply(ex, ez, out=p)
        p += ey
        p /= w
        multiply(ey, ez, out=q)
        subtract(ex, q, out=q)
        q /= w
        # Readings of the top probes: (y - dy) q + (d - x) p + dz
        multiply(dy, q, out=c)
        subtract(dz, c, out=c)
        multiply(d, p, out=w)
        c += w
        q *= L
        add(c, q, out=b)
        subtract(c, q, out=f)  # B and C; c becomes A
        p *= L
        c -= p
        # Readings of the side probes
        multiply(ey, ey, out=w)
        w += 1
        multiply(ey, ez, out=a)
        a += ex
        a /= w
        subtract(UP, dz, out=p)
        a *= p
        multiply(ex, ey, out=e)
        e -= ez
        e /= w
        multiply(d, e, out=p)
        p -= a
        p += dy  # D
        e *= L
        subtract(p, e, out=q)  # E
        # Eq. 8-12 and the errors
        eyx, ezx, eax, ebx, ecx = self.out
        subtract(b, f, out=eax)
        eax *= 1 / (2 * L)
        b += f
        b *= 0.5
        subtract(b, c, out=ebx)
        ebx *= 1 / L
        multiply(d, ebx, out=w)
        subtract(b, w, out=ezx)
        ezx -= dz
        subtract(q, p, out=ecx)
        ecx *= 1 / L
        multiply(d, ecx, out=w)
        add(p, w, out=eyx)
        multiply(eax, UP, out=w)
        eyx += w
        eyx -= dy
        eax -= ex
        ebx -= ey
        ecx -= ez
        for x in self.out:
            x *= 1e6
        return self.out


class Sums:
    """Sum, sum of squares, min and max of each output and bin."""

    def __init__(self):
        self.n = 0
        self.sum = np.zeros((5, BINS))
        self.square = np.zeros((5, BINS))
        self.min = np.full((5, BINS), np.inf)
        self.max = np.full((5, BINS), -np.inf)

    def add(self, out):
        self.n += out[0].shape[1]
        for k, x in enumerate(out):
            self.sum[k] += x.sum(axis=1)
            self.square[k] += np.einsum("ij,ij->i", x, x)
            np.minimum(self.min[k], x.min(axis=1), out=self.min[k])
            np.maximum(self.max[k], x.max(axis=1), out=self.max[k])

    def figures(self):
        mean = self.sum / self.n
        return mean, np.sqrt(self.square / self.n - mean * mean), self.min, self.max


def from_counts(counts, low, width):
    """Quantiles and intervals of one histogram."""
    total = np.concatenate(([0], np.cumsum(counts)))
    edges = low + width * np.arange(counts.size + 1)
    ranks = np.array(QUANTILES) * total[-1]
    shortest_from = np.arange(0.0, 0.05, 1 / 8192) * total[-1]
    lows = np.interp(shortest_from, total, edges)
    highs = np.interp(shortest_from + 0.95 * total[-1], total, edges)
    best = np.argmin(highs - lows)
    return np.interp(ranks, total, edges), lows[best], highs[best]


def by_histogram(trials, m):
    simulation, sums = Simulation(m), Sums()
    counts = np.zeros((5, BINS * CORE), dtype=np.int64)
    t, index = np.empty((BINS, m)), np.empty((BINS, m), dtype=np.intp)
    offset = (np.arange(BINS) * CORE).astype(float)[:, None]
    # The histogram covers the core of the values, estimated from the first trials, as in mdof.
    low, per_width = [], []
    for x in simulation.run():
        q = np.quantile(x[:, :500], (0.01, 0.99))
        low.append(q.mean() - (q[1] - q[0]))
        per_width.append(CORE / (2 * (q[1] - q[0])))
    for _ in range(trials // (BINS * m)):
        out = simulation.run()
        sums.add(out)
        for k, x in enumerate(out):
            np.subtract(x, low[k], out=t)
            np.multiply(t, per_width[k], out=t)
            np.clip(t, 0, CORE - 1, out=t)
            np.add(t, offset, out=t)
            np.copyto(index, t, casting="unsafe")
            counts[k] += np.bincount(index.ravel(), minlength=BINS * CORE)
    sums.figures()
    for k in range(5):
        of_output = counts[k].reshape(BINS, CORE)
        from_counts(of_output.sum(axis=0), low[k], 1 / per_width[k])
        for row in of_output:
            from_counts(row, low[k], 1 / per_width[k])
    return sums


def shortest(x):
    q = int(0.95 * x.size)
    best = np.argmin(x[q:] - x[:-q])
    return x[best], x[best + q]


def by_sorting(trials, m):
    simulation, sums = Simulation(m), Sums()
    rounds = trials // (BINS * m)
    kept = np.empty((5, BINS, rounds * m))
    for i in range(rounds):
        out = simulation.run()
        sums.add(out)
        for k, x in enumerate(out):
            kept[k, :, i * m:(i + 1) * m] = x
    sums.figures()
    for k in range(5):
        for row in kept[k]:
            row.sort()
            row[(np.array(QUANTILES) * row.size).astype(int)]
            shortest(row)
        of_all = np.sort(kept[k], axis=None, kind="stable")  # merges the sorted rows
        of_all[(np.array(QUANTILES) * of_all.size).astype(int)]
        shortest(of_all)
    return sums


def best_ns(work, trials, sizes, rounds=2):
    """Best over the sizes and rounds: (ns per trial, trials at once)."""
    found = []
    for m in (m for m in sizes if BINS * m <= trials):
        for _ in range(rounds):
            begin = time.process_time()
            sums = work(trials, m)
            took = time.process_time() - begin
            found.append((took / (sums.n * BINS) * 1e9, BINS * m))
    return min(found), sums


def main():
    trials = int(float(sys.argv[1])) if len(sys.argv) > 1 else 10_000_000
    (ns, at_once), sums = best_ns(by_histogram, trials, (100, 200, 400, 800, 2000, 10_000, 50_000))
    sd = np.sqrt((sums.square.sum(axis=1) / (sums.n * BINS)))
    print(f"numpy {np.__version__}, histograms: {ns:.1f} ns a trial, {at_once} trials at once; "
          f"sd {sd[0] * 1e3:.3f} nm {sd[1] * 1e3:.3f} nm {sd[2]:.4f} {sd[3]:.4f} {sd[4]:.4f} µrad")
    fewer = min(trials, 10_000_000)  # 400 MB of kept trials
    (exact_ns, at_once), _ = best_ns(by_sorting, fewer, (400, 2000, 10_000), rounds=1)
    print(f"numpy {np.__version__}, sorting: {exact_ns:.1f} ns a trial, {at_once} trials at once")


if __name__ == "__main__":
    main()
