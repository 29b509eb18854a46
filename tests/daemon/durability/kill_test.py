#!/usr/bin/python3
"""SIGKILL at random moments of a simulated run at 4 kHz: no acknowledged data are lost.

usage: kill_test.py MDOFD MDOF [--kills N] [--durability full|normal] [--seed S] [--naive]

A client notes what the daemon acknowledges: points (run.event "points") and chunks of the recording (run.event
"recorded"). After each kill: the database passes its integrity check, every acknowledged point is present bit for bit,
the recording is readable at least up to the last acknowledged chunk, and the daemon serves again within 2 s. At the
same time other programs write and read (storekeeper/others.py): their acknowledged tables and replays are present as
well.

With --durability normal the test must still pass: SIGKILL ends a process but not the kernel, and written data
survive in the page cache. Only a power cut shows the difference. --break-it deletes a row without the daemon's
knowledge, to show that a loss is detected. With --naive a foreign file is opened for writing at the same time, and
the command exits with 1 unless acknowledged rows are lost by that."""
import argparse
import atexit
import json
import os
import random
import re
import sqlite3
import subprocess
import sys
import tempfile
import threading
import time

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from mdofd import Daemon, simulator  # noqa: E402
from storekeeper.others import Others  # noqa: E402


class Acknowledged:
    """The data that mdofd has acknowledged between a start and the next kill."""

    def __init__(self):
        self.points, self.chunk, self.ended = [], 0, False

    def listen(self, client):
        try:
            while True:
                value = client.next_note()["params"]["value"]
                if value.get("type") == "points":
                    self.points[value["offset"]:] = value["points"]
                elif value.get("type") == "recorded":
                    self.chunk = max(self.chunk, value["chunk"])
                elif value.get("type") == "ended":
                    self.ended = True
        except (OSError, ValueError):
            pass  # the daemon was killed


def count(database, sql):
    connection = sqlite3.connect(f"file:{database}?mode=ro", uri=True)
    answer = connection.execute(sql).fetchone()[0]
    connection.close()
    return answer


def measured(point):
    """The point without its uncertainties. If a target is measured again, u of its first point changes, because it
    then includes the scatter of the visits."""
    return {key: value for key, value in point.items() if key not in ("u", "u_random", "U", "k", "nu_eff")}


def check(database, run, acknowledged, client, mdof, states=("aborted",)):
    answer = count(database, "PRAGMA integrity_check")
    assert answer == "ok", f"integrity_check: {answer}"
    stored = client.points(run)
    lost = len(acknowledged.points) - len(stored)
    assert lost <= 0, f"{lost} of {len(acknowledged.points)} acknowledged points of run {run} are lost"
    changed = [(p, stored[i]) for i, p in enumerate(acknowledged.points) if measured(stored[i]) != measured(p)]
    assert not changed, f"{len(changed)} acknowledged points of run {run} are changed: " \
                        f"{changed[0][0]} was told, {changed[0][1]} is stored"
    header = client.call("run.get", run=run)
    assert header["state"] in states, header["state"]
    recording = header["recording"]["path"]
    assert os.path.exists(recording), f"{acknowledged.chunk} acknowledged chunks are lost: {recording} is gone"
    seen = subprocess.run([mdof, "verify", "--recording", recording, "--json"],
                          capture_output=True, text=True)
    assert seen.returncode == 0 and json.loads(seen.stdout)["sound"], seen.stderr
    chunks = count(recording, "SELECT coalesce(max(seq), 0) FROM chunk")
    assert chunks >= acknowledged.chunk, f"{acknowledged.chunk - chunks} acknowledged chunks are lost"
    return len(stored), chunks, header["state"]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("mdofd")
    parser.add_argument("mdof")
    parser.add_argument("--kills", type=int, default=200)
    parser.add_argument("--durability", default="full")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--break-it", action="store_true")
    parser.add_argument("--naive", action="store_true")
    options = parser.parse_args()
    chance = random.Random(options.seed)
    totals = {"points": 0, "chunks": 0}
    slowest_s, losses = 0.0, []
    with tempfile.TemporaryDirectory() as folder:
        config = simulator("X", rate_hz=4000, dwell_s=0.3, targets_mm=(0, 0.5, 1.1, 1.6))
        daemon = Daemon(options.mdofd, folder, config, options.durability)
        atexit.register(lambda: daemon.process and daemon.process.kill())
        client = daemon.start()
        others = Others(daemon, options.mdof, options.naive)
        others.prepare()
        for kill in range(options.kills):
            client.call("live.subscribe", interval_ms=1000)
            run = client.call("run.start", axis="X")["run"]
            acknowledged = Acknowledged()
            listener = threading.Thread(target=acknowledged.listen, args=(client,))
            listener.start()
            while kill == 0 and not acknowledged.chunk:  # so that there is something to lose, on a slow computer as well
                time.sleep(0.01)
            others.start()
            time.sleep(chance.uniform(0.05, 2.5))
            while options.break_it and not acknowledged.points:
                time.sleep(0.1)
            daemon.kill()
            listener.join()
            others.stop()
            if options.break_it and acknowledged.points:
                broken = sqlite3.connect(daemon.database)
                for (name,) in broken.execute(
                        "SELECT name FROM sqlite_master WHERE type='trigger'").fetchall():
                    broken.execute(f'DROP TRIGGER "{name}"')
                broken.execute("DELETE FROM point")
                broken.commit()
                broken.close()
            begin = time.monotonic()
            client = daemon.start()
            client.call("server.info")
            took_s = time.monotonic() - begin
            slowest_s = max(slowest_s, took_s)
            assert took_s < 2, f"kill {kill}: serving again only after {took_s:.2f} s"
            totals["points"] += len(acknowledged.points)
            totals["chunks"] += acknowledged.chunk
            try:
                assert not (gone := others.lost(daemon.database)), gone
                check(daemon.database, run, acknowledged, client, options.mdof,
                      ("aborted", "failed") if options.naive else ("aborted",))
            except (AssertionError, sqlite3.DatabaseError) as loss:
                if not options.naive or not re.search("acknowledged|malformed", str(loss)):
                    raise
                losses.append(f"kill {kill}: {loss}")
                break  # the database may be damaged after this
        daemon.kill() if losses else daemon.stop()
    assert totals["chunks"] > 0
    print(f"{kill + 1} kills, durability {options.durability}: {totals['points']} points, {totals['chunks']} chunks and "
          f"{others} acknowledged, lost in {len(losses)} kills, serving again within {slowest_s:.2f} s")
    print("\n".join(losses[:5]))
    sys.exit(bool(losses) != options.naive)


if __name__ == "__main__":
    main()
