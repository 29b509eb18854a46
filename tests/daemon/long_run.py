#!/usr/bin/python3
"""A long run at 1 kHz: what a point costs the daemon does not grow, and no scan is lost.

usage: long_run.py MDOFD [--points N]

Prints the daemon's processor time a point over the first and the last tenth of the run (without the
very first hundred points), its share of a core, its memory, and the scans lost. Exits with 1 where the
share of a core has grown by more than 10 %, a scan was lost, or a point is not stored. It lasts some
110 ms a point: 20,000 points are 37 minutes; of a few hundred
the shares are too rough for the bound."""
import argparse
import atexit
import os
import sys
import tempfile
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from mdofd import Daemon, simulator  # noqa: E402

WARM_UP = 100
MEASURE = "\n[measure]\nsettle_s = 0.01\nmin_length_s = 0.02\n"


def cpu_s(pid):
    fields = open(f"/proc/{pid}/stat").read().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def memory_MiB(pid):
    line = next(x for x in open(f"/proc/{pid}/status") if x.startswith("VmRSS"))
    return int(line.split()[1]) / 1024


class Marks:
    """When, at what processor time and memory, the run had so many points."""

    def __init__(self, pid, at):
        self.pid, self.at, self.seen = pid, list(at), []

    def note(self, points):
        while self.at and points >= self.at[0]:
            self.at.pop(0)
            self.seen.append((points, time.monotonic(), cpu_s(self.pid), memory_MiB(self.pid)))


def stretch(begin, end):
    points = end[0] - begin[0]
    cpu = end[2] - begin[2]
    return 1e3 * cpu / points, 100 * cpu / (end[1] - begin[1])


def measure(daemon, wanted):
    client = daemon.start()
    client.call("live.subscribe", interval_ms=1000)
    run = client.call("run.start", axis="X")["run"]
    marks = Marks(daemon.process.pid,
                  (WARM_UP, WARM_UP + wanted // 10, wanted - wanted // 10, wanted))
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
    with tempfile.TemporaryDirectory() as folder:
        daemon = Daemon(options.mdofd, folder, config)
        atexit.register(lambda: daemon.process and daemon.process.kill())
        seen, header, stored = measure(daemon, options.points)
        daemon.stop()
    (first_ms, first_share), (last_ms, last_share) = stretch(*seen[:2]), stretch(*seen[2:])
    print(f"{stored} points in {seen[3][1] - seen[0][1]:.0f} s: {first_ms:.3f} ms of a processor a "
          f"point in the first tenth, {last_ms:.3f} in the last ({first_share:.2f} and "
          f"{last_share:.2f} % of a core), {seen[0][3]:.0f} and {seen[3][3]:.0f} MiB, "
          f"{header['scans_lost']} of {header['scans']} scans lost, state {header['state']}")
    assert stored >= options.points and header["state"] == "complete", "points are missing"
    assert header["scans_lost"] == 0, "scans were lost"
    assert last_share < 1.1 * first_share, "a point has become dearer"


if __name__ == "__main__":
    main()
