#!/usr/bin/python3
"""A long run at 1 kHz. The processor time for a point must not increase, and no scan may be lost.

usage: long_run.py MDOFD [--points N]

Prints the daemon's processor time per point over the first and the last tenth of the run (without the first hundred
points), its share of a core, its memory, and the lost scans. Other load on the computer changes the time of a point
by more than the limit. Therefore a second daemon begins the same run when the last tenth begins, and the cost at the
end is compared with the cost of this young run on the same computer. Exits with 1 if a point of the old run costs
over 10 % more than a point of the young run, a scan was lost, or a point is not stored. A point takes about 110 ms:
20,000 points take 39 minutes; with a few hundred points the shares are too uncertain for the limit."""
import argparse
import atexit
import os
import sys
import tempfile
import threading
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from mdofd import Daemon, simulator  # noqa: E402

WARM_UP = 100
LAST_TENTH = 3  # index in the list of marks
MEASURE = "\n[measure]\nsettle_s = 0.01\nmin_length_s = 0.02\n"


def cpu_s(pid):
    fields = open(f"/proc/{pid}/stat").read().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def memory_MiB(pid):
    line = next(x for x in open(f"/proc/{pid}/status") if x.startswith("VmRSS"))
    return int(line.split()[1]) / 1024


class Marks:
    """Records time, processor time and memory when the run has reached each number of points. `at_mark` is called
    with the number of marks reached."""

    def __init__(self, pid, at, at_mark):
        self.pid, self.at, self.at_mark, self.seen = pid, list(at), at_mark, []

    def note(self, points):
        while self.at and points >= self.at[0]:
            self.at.pop(0)
            self.seen.append((points, time.monotonic(), cpu_s(self.pid), memory_MiB(self.pid)))
            self.at_mark(len(self.seen))


def stretch(begin, end):
    points = end[0] - begin[0]
    cpu = end[2] - begin[2]
    return 1e3 * cpu / points, 100 * cpu / (end[1] - begin[1])


def measure(daemon, at, at_mark=lambda passed: None):
    """Measures one run until it has `at[-1]` points. Returns the records at the marks, the header of the run, and
    the stored points."""
    client = daemon.start()
    client.call("live.subscribe", interval_ms=1000)
    run = client.call("run.start", axis="X")["run"]
    marks = Marks(daemon.process.pid, at, at_mark)
    while marks.at:
        value = client.next_note()["params"]["value"]
        if value.get("type") == "points":
            marks.note(value["offset"] + len(value["points"]))
        assert value.get("type") != "ended", f"the run ended by itself: {value}"
    client.call("run.stop", run=run)
    header = client.call("run.get", run=run)
    stored = client.call("run.points", run=run, count=1)["total"]
    return marks.seen, header, stored


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("mdofd")
    parser.add_argument("--points", type=int, default=20_000)
    options = parser.parse_args()
    config = simulator("X", rate_hz=1000, dwell_s=0.08, targets_mm=(0, 0.3, 0.7, 1.1, 1.4, 1.8),
                       repeats=1_000_000) + MEASURE
    tenth = options.points // 10
    young = []

    def begin_young_run(passed):
        if passed == LAST_TENTH:
            thread = threading.Thread(target=lambda: young.append(
                measure(daemons[1], (WARM_UP, WARM_UP + tenth))[0]))
            thread.start()
            threads.append(thread)

    threads = []
    with tempfile.TemporaryDirectory() as old_home, tempfile.TemporaryDirectory() as young_home:
        daemons = [Daemon(options.mdofd, home, config) for home in (old_home, young_home)]
        atexit.register(lambda: [d.process.kill() for d in daemons if d.process])
        seen, header, stored = measure(
            daemons[0], (WARM_UP, WARM_UP + tenth, options.points - tenth, options.points),
            begin_young_run)
        threads[0].join()
        for daemon in daemons:
            daemon.stop()
    print_shares(stored, seen, young[0], header)
    assert stored >= options.points and header["state"] == "complete", "points are missing"
    assert header["scans_lost"] == 0, "scans were lost"
    assert stretch(*seen[2:])[0] < 1.1 * stretch(*young[0])[0], "a point has become dearer"


def print_shares(stored, seen, young, header):
    shares = [f"{ms:.3f} ms ({share:.2f} % of a core) in {of}" for (ms, share), of in (
        (stretch(*seen[:2]), "the first tenth"), (stretch(*seen[2:]), "the last"),
        (stretch(*young), "a young run beside the last"))]
    print(f"{stored} points in {seen[3][1] - seen[0][1]:.0f} s: of a processor a point "
          f"{', '.join(shares)}; {seen[0][3]:.0f} and {seen[3][3]:.0f} MiB, "
          f"{header['scans_lost']} of {header['scans']} scans lost, state {header['state']}")


if __name__ == "__main__":
    main()
