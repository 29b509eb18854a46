#!/usr/bin/python3
"""The n-th call that writes or flushes a file fails while mdofd measures: no acknowledged data are lost.

usage: failing_call_test.py MDOFD MDOF FAILING_CALLS.so [--lives N] [--seed S]

The test starts the daemon many times ("lives"). In each life another call fails (failing_calls.cpp), once or
permanently, with ENOSPC or EIO. The daemon may refuse to start, or may end its run as failed, but must not crash. Then
the daemon is killed and started without a fault: each acknowledged point and chunk is present, database and recording
are sound, and the daemon measures again."""
import argparse
import atexit
import errno
import os
import random
import sys
import tempfile
import threading
import time

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from kill_test import Acknowledged, check  # noqa: E402
from mdofd import Daemon, RpcError, simulator  # noqa: E402

LAST_CALL = 400  # number of calls that a run makes in one or two seconds
MOST_S = 60
ANSWER_S = 5  # if a disk rejects all writes, the end of the run may never arrive


def wait_for_fault(daemon, told, acknowledged, run):
    """Waits until the call has failed. If there is a run, waits also until it has ended because of the fault, or
    has continued."""
    end = time.monotonic() + MOST_S
    while not os.path.exists(told):
        assert time.monotonic() < end, "the call that is to fail does not come"
        assert daemon.process.poll() is None, f"mdofd ended with {daemon.process.returncode}"
        time.sleep(0.01)
    before, end = (len(acknowledged.points), acknowledged.chunk + 1), time.monotonic() + ANSWER_S
    while run and not acknowledged.ended and time.monotonic() < end and daemon.process.poll() is None:
        if len(acknowledged.points) > before[0] and acknowledged.chunk > before[1]:
            break  # one chunk may not have arrived
        time.sleep(0.01)


def faulty_life(daemon, fault):
    """Runs mdofd with one failing call. Returns the number of the run (None if no run began) and the acknowledged
    data."""
    daemon.environment = fault
    acknowledged = Acknowledged()
    try:
        client = daemon.start()
    except RuntimeError:
        return None, acknowledged  # mdofd reported the fault and ended
    run = None
    try:
        client.call("live.subscribe", interval_ms=1000)
        run = client.call("run.start", axis="X")["run"]
    except RpcError:
        pass
    listener = threading.Thread(target=acknowledged.listen, args=(client,))
    listener.start()
    wait_for_fault(daemon, fault["MDOF_FAIL_TOLD"], acknowledged, run)
    assert daemon.process.poll() is None, f"mdofd ended with {daemon.process.returncode}"
    daemon.kill()
    listener.join()
    return run, acknowledged


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("mdofd")
    parser.add_argument("mdof")
    parser.add_argument("library")
    parser.add_argument("--lives", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    chance = random.Random(options.seed)
    points = chunks = refused = failed = life = 0
    with tempfile.TemporaryDirectory() as folder:
        config = simulator("X", rate_hz=4000, dwell_s=0.3, targets_mm=(0, 0.5, 1.1, 1.6))
        daemon = Daemon(options.mdofd, folder, config)
        atexit.register(lambda: daemon.process and daemon.process.kill())
        # Continues until a fault has occurred in a run that already had points.
        while life < options.lives or not (points and failed or life >= 10 * options.lives):
            life += 1
            fault = {"LD_PRELOAD": os.path.abspath(options.library),
                     "MDOF_FAIL_CALL": str(1 + int(LAST_CALL * chance.random() ** 2)),
                     "MDOF_FAIL_ERRNO": str(chance.choice((errno.ENOSPC, errno.EIO))),
                     "MDOF_FAIL_STICKY": str(chance.randrange(2)),
                     "MDOF_FAIL_TOLD": os.path.join(folder, f"told-{life}")}
            try:
                run, acknowledged = faulty_life(daemon, fault)
                daemon.environment = {}
                client = daemon.start()
                if run is None:
                    refused += 1
                    assert not acknowledged.points and not acknowledged.chunk
                    continue
                points, chunks = points + len(acknowledged.points), chunks + acknowledged.chunk
                failed += check(daemon.database, run, acknowledged, client, options.mdof,
                                ("aborted", "failed"))[2] == "failed"
            except Exception:
                print(f"life {life}: {fault}", file=sys.stderr)
                raise
            finally:
                daemon.kill()
    assert points > 0 and failed > 0, "no fault hit a run, so nothing was shown"
    print(f"{life} lives with a call that fails: {refused} refused to start or to begin a run, "
          f"{failed} runs failed and said so; {points} points and {chunks} chunks acknowledged, 0 lost")


if __name__ == "__main__":
    main()
