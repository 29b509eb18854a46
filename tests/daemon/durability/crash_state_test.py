#!/usr/bin/python3
"""Disk states after a power cut, rebuilt from the writes of a live run: no acknowledged data are lost.

usage: crash_state_test.py MDOFD MDOF RECORDED_CALLS.so [--states N] [--seed S] [--without-flush]

mdofd measures, and a preloaded library (recorded_calls.cpp) records each write and flush. Then N states of the disk
are made: the power fails after some call; everything flushed before is present, and each write that was not flushed
is by chance complete, half complete or missing. In each state the database passes its integrity check, every point
and chunk that a client had received by then is present, and the recording is readable. During the run other programs
write and read (storekeeper/others.py); their acknowledged tables and replays are present as well.

With --without-flush the flushes are ignored, as if the disk had not performed them: data must then be lost. The
command exits with 1 if nothing is lost."""
import argparse
import atexit
import collections
import os
import random
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import threading
import time

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from mdofd import Daemon, simulator  # noqa: E402
from storekeeper.others import Others  # noqa: E402

Call = collections.namedtuple("Call", "time_ns op offset length path bytes")
RUN_S = 4


class Told:
    """Messages of mdofd with the times of their arrival: (time_ns, number of points) and (time_ns, number of
    chunks)."""

    def __init__(self):
        self.points, self.chunks = [], []

    def listen(self, client):
        try:
            while True:
                value = client.next_note()["params"]["value"]
                if value.get("type") == "points":
                    self.points.append((time.monotonic_ns(), value["offset"] + len(value["points"])))
                elif value.get("type") == "recorded":
                    self.chunks.append((time.monotonic_ns(), value["chunk"]))
        except (OSError, ValueError):
            pass  # the connection has ended

    @staticmethod
    def until(told, time_ns):
        return max([n for at, n in told if at <= time_ns], default=0)


def recorded_run(options, folder):
    """A run that is killed after some time. Returns its messages, the recorded calls and the number of the run."""
    config = simulator("X", rate_hz=4000, dwell_s=0.3, targets_mm=(0, 0.5, 1.1, 1.6))
    data, record = os.path.join(folder, "data"), os.path.join(folder, "calls")
    open(record, "wb").close()
    daemon = Daemon(options.mdofd, data, config)
    atexit.register(lambda: daemon.process and daemon.process.kill())
    daemon.environment = {"LD_PRELOAD": os.path.abspath(options.library), "MDOF_RECORD_TO": record,
                          "MDOF_RECORD_BELOW": data}
    client = daemon.start()
    others = Others(daemon, options.mdof)
    others.prepare()
    client.call("live.subscribe", interval_ms=1000)
    run = client.call("run.start", axis="X")["run"]
    told = Told()
    listener = threading.Thread(target=told.listen, args=(client,))
    listener.start()
    others.start()
    time.sleep(RUN_S)
    daemon.kill()
    listener.join()
    others.stop()
    return told, others, read_calls(record, data), run


def read_calls(record, data):
    calls = []
    with open(record, "rb") as f:
        while line := f.readline():
            time_ns, op, offset, length, path = line.decode().rstrip("\n").split(" ", 4)
            content = f.read(int(length)) if op == "W" else b""
            if not path.endswith("-shm"):  # every opening of a database makes a new -shm
                calls.append(Call(int(time_ns), op, int(offset), int(length),
                                  os.path.relpath(path, data), content))
    return calls


def apply(files, call, length=None):
    if call.op == "U":
        files.pop(call.path, None)
        return
    content = files.setdefault(call.path, bytearray())
    if call.op == "T":
        del content[call.length:]
        content.extend(bytes(call.length - len(content)))
        return
    new = call.bytes if length is None else call.bytes[:length]
    content.extend(bytes(max(0, call.offset + len(new) - len(content))))
    content[call.offset:call.offset + len(new)] = new


def state_after(calls, flushes, chance):
    """One possible state of the files if the power fails after `calls`."""
    flushed_until = {}
    for i, call in enumerate(calls):
        if call.op == "S" and flushes:
            flushed_until[call.path] = i
    files = {}
    for i, call in enumerate(calls):
        if call.op == "S":
            continue
        if i < flushed_until.get(call.path, -1) or call.op == "U":
            apply(files, call)
        elif (fate := chance.random()) < 0.4:
            apply(files, call)
        elif fate < 0.6 and call.op == "W":
            apply(files, call, call.length // 2)
    return files


def write_out(files, folder):
    shutil.rmtree(folder, ignore_errors=True)
    for path, content in files.items():
        file = os.path.join(folder, path)
        os.makedirs(os.path.dirname(file), exist_ok=True)
        with open(file, "wb") as f:
            f.write(content)


def ask(database, sql):
    # Opened for writing, because SQLite must roll back an incomplete transaction.
    connection = sqlite3.connect(database)
    try:
        return connection.execute(sql).fetchone()[0]
    finally:
        connection.close()


def check(folder, run, points, chunks, others, now, mdof):
    database = os.path.join(folder, "mdof.db")
    if points == chunks == 0:
        return
    answer = ask(database, "PRAGMA integrity_check")
    assert answer == "ok", f"integrity_check: {answer}"
    stored = ask(database, f"SELECT count(*) FROM point WHERE run = {run}")
    assert stored >= points, f"{points - stored} of {points} points are lost"
    assert not (gone := others.lost(database, now)), gone
    recordings = os.path.join(folder, "recordings")
    recording = os.path.join(recordings, next(n for n in sorted(os.listdir(recordings))
                                              if n.endswith(".mdofrec")))
    kept = ask(recording, "SELECT coalesce(max(seq), 0) FROM chunk")
    assert kept >= chunks, f"{chunks - kept} of {chunks} chunks are lost"
    seen = subprocess.run([mdof, "verify", "--recording", recording], capture_output=True, text=True)
    assert seen.returncode == 0, seen.stderr


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("mdofd")
    parser.add_argument("mdof")
    parser.add_argument("library")
    parser.add_argument("--states", type=int, default=400)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--without-flush", action="store_true")
    options = parser.parse_args()
    chance = random.Random(options.seed)
    most = [0, 0]
    losses = []
    with tempfile.TemporaryDirectory() as folder:
        told, others, calls, run = recorded_run(options, folder)
        for state in range(options.states):
            cut = chance.randrange(1, len(calls) + 1)
            now = calls[cut - 1].time_ns
            points, chunks = Told.until(told.points, now), Told.until(told.chunks, now)
            most = [max(most[0], points), max(most[1], chunks)]
            rebuilt = os.path.join(folder, "state")
            write_out(state_after(calls[:cut], not options.without_flush, chance), rebuilt)
            try:
                check(rebuilt, run, points, chunks, others, now, options.mdof)
            except Exception as loss:
                losses.append(f"state {state}, after call {cut}: {type(loss).__name__}: {loss}")
    assert most[0] > 0 and most[1] > 0, "nothing had been told, so nothing was shown"
    print(f"{options.states} states of {len(calls)} calls, up to {most[0]} points, {most[1]} chunks and {others} "
          f"acknowledged: lost in {len(losses)}")
    print("\n".join(losses[:10]))
    sys.exit(bool(losses) != options.without_flush)


if __name__ == "__main__":
    main()
