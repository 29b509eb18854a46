#!/usr/bin/python3
"""The n-th call that writes or flushes a file fails while mdofd measures: nothing acknowledged is lost.

usage: failing_call_test.py MDOFD MDOF FAILING_CALLS.so [--lives N] [--seed S]

Each life of the daemon has another call that fails (failing_calls.cpp), once or from then on, with
ENOSPC or EIO. It may refuse to start, or end its run as failed; it may not crash. Then it is killed and
started whole: each point and chunk that it had acknowledged is there, database and recording are sound,
and it measures again."""
import argparse
import atexit
import errno
import os
import random
import sys
import tempfile
import threading
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from kill_test import Acknowledged, check  # noqa: E402
from mdofd import Daemon, RpcError, simulator  # noqa: E402

LAST_CALL = 400  # a life makes about so many


def faulty_life(daemon, fault):
    """The run that it began, if it could, and what was promised."""
    daemon.environment = fault
    acknowledged = Acknowledged()
    try:
        client = daemon.start()
    except RuntimeError:
        return None, acknowledged  # it said why, and ended
    run = None
    try:
        client.call("live.subscribe", interval_ms=1000)
        run = client.call("run.start", axis="X")["run"]
    except RpcError:
        pass
    listener = threading.Thread(target=acknowledged.listen, args=(client,))
    listener.start()
    time.sleep(1.5)
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
    points = chunks = refused = failed = 0
    with tempfile.TemporaryDirectory() as folder:
        config = simulator("X", rate_hz=4000, dwell_s=0.3, targets_mm=(0, 0.5, 1.1, 1.6))
        daemon = Daemon(options.mdofd, folder, config)
        atexit.register(lambda: daemon.process and daemon.process.kill())
        for life in range(options.lives):
            fault = {"LD_PRELOAD": os.path.abspath(options.library),
                     "MDOF_FAIL_CALL": str(1 + int(LAST_CALL * chance.random() ** 2)),
                     "MDOF_FAIL_ERRNO": str(chance.choice((errno.ENOSPC, errno.EIO))),
                     "MDOF_FAIL_STICKY": str(chance.randrange(2))}
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
    print(f"{options.lives} lives with a call that fails: {refused} refused to start or to begin a run, "
          f"{failed} runs failed and said so; {points} points and {chunks} chunks acknowledged, 0 lost")


if __name__ == "__main__":
    main()
