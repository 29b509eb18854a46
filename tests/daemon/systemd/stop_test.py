#!/usr/bin/python3
"""mdofd ends on request with exit code 0, also while it reads its configuration or replays a file that cannot be
read on.

usage: stop_test.py MDOFD"""
import ctypes
import os
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from mdofd import RIG, Client, Daemon, RpcError, simulator, write_log  # noqa: E402

FAN_CLASS_CONTENT, FAN_MARK_ADD, FAN_OPEN_PERM, AT_FDCWD = 0x4, 0x1, 0x10000, -100
SOON_S = 20  # TimeoutStopSec of mdofd.service; systemd kills mdofd after this time


def held_file(path):
    """Makes every open() of the file wait until the returned descriptor is closed. Returns None if this is not
    possible."""
    libc = ctypes.CDLL(None, use_errno=True)
    group = libc.fanotify_init(FAN_CLASS_CONTENT, os.O_RDONLY)
    mask = ctypes.c_uint64(FAN_OPEN_PERM)
    if group < 0 or libc.fanotify_mark(group, FAN_MARK_ADD, mask, AT_FDCWD, path.encode()) != 0:
        return None
    return group


def bytes_read(pid):
    with open(f"/proc/{pid}/io") as counts:
        return int(counts.readline().split()[1])


def blocked_signals(pid):
    """The mask of blocked signals of each thread."""
    masks = {}
    for thread in os.listdir(f"/proc/{pid}/task"):
        with open(f"/proc/{pid}/task/{thread}/status") as status:
            masks[int(thread)] = int(re.search(r"SigBlk:\s*(\w+)", status.read()).group(1), 16)
    return masks


class Stop(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.daemon = Daemon(MDOFD, self.folder.name, simulator(rate_hz=500))

    def assert_ends(self, process):
        process.terminate()
        try:
            code = process.wait(SOON_S)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
            self.fail(f"mdofd did not end within {SOON_S} s of SIGTERM")
        self.assertEqual(code, 0)

    def test_a_signal_while_the_configuration_is_read_is_a_success(self):
        """The configuration is so long that the signal arrives before mdofd has parsed it."""
        with open(self.daemon.config, "a") as config:
            config.write("# a comment that means nothing but time\n" * 90_000)
        size = os.path.getsize(self.daemon.config)
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            process = subprocess.Popen([MDOFD, "--config", self.daemon.config], stderr=subprocess.DEVNULL)
            while process.poll() is None and bytes_read(process.pid) < size:
                pass
            process.send_signal(number)
            self.assertEqual(process.wait(), 0, f"ended by signal {number}")
            self.assertFalse(os.path.exists(self.daemon.database), "it was later than this test means")

    def test_the_signals_go_to_the_main_thread(self):
        """If a thread of a device received a signal, the signal would interrupt the driver."""
        self.daemon.start()
        pid, end = self.daemon.process.pid, time.monotonic() + SOON_S
        ending = sum(1 << number - 1 for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP))
        while True:
            blocked = blocked_signals(pid)
            self.assertEqual(blocked.pop(pid) & ending, 0)
            # Threads: store, query, acq, measure.
            if len(blocked) >= 4 and all(mask & ending == ending for mask in blocked.values()):
                break
            self.assertLess(time.monotonic(), end, blocked)
        self.assert_ends(self.daemon.process)

    def test_a_check_that_is_cut_off_is_none(self):
        with open(self.daemon.config, "a") as config:
            config.write("# a comment that means nothing but time\n" * 90_000)
        process = subprocess.Popen([MDOFD, "--check-config", "--config", self.daemon.config], stdout=subprocess.DEVNULL)
        while process.poll() is None and bytes_read(process.pid) < os.path.getsize(self.daemon.config):
            pass
        process.terminate()
        self.assertNotEqual(process.wait(), 0)

    def test_a_pipe_is_no_log_and_holds_nothing_up(self):
        pipe = os.path.join(self.folder.name, "log.csv")
        os.mkfifo(pipe)
        client = self.daemon.start()
        with self.assertRaisesRegex(RpcError, "is not a regular file"):
            client.call("run.replay", path=pipe)
        log = os.path.join(self.folder.name, "good.csv")
        write_log(log)
        with open(RIG["X"]) as rig:
            self.assertEqual(client.call("run.replay", path=log, rig=rig.read())["run"], 1)
        self.assert_ends(self.daemon.process)

    def test_the_end_waits_for_no_file(self):
        log = os.path.join(self.folder.name, "log.csv")
        write_log(log)
        held = held_file(log)
        if held is None:
            self.skipTest("only root can hold a file (fanotify)")
        self.addCleanup(os.close, held)
        client = self.daemon.start()
        asked = threading.Thread(target=self.ask_in_vain, args=(Client(self.daemon.socket), log))
        asked.start()
        while os.read(held, 4096) == b"":  # mdofd has now called open() for the file
            time.sleep(0.01)
        with self.assertRaisesRegex(RpcError, "is replaying or importing another file"):
            client.call("run.replay", path=log)
        run = client.call("run.start", axis="X")["run"]
        self.assertEqual(client.call("server.info")["axes"][0]["run"], run)
        self.assert_ends(self.daemon.process)
        asked.join()

    def ask_in_vain(self, client, log):
        with open(RIG["X"]) as rig, self.assertRaises((ConnectionError, RpcError)):
            client.call("run.replay", path=log, rig=rig.read())


if __name__ == "__main__":
    MDOFD = os.path.abspath(sys.argv.pop(1))
    unittest.main()
