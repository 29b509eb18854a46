#!/usr/bin/python3
"""Power cuts at random moments of a simulated run at 4 kHz: no acknowledged data are lost.

usage: power_cut_test.py MDOFD MDOF [--cuts N] [--durability full|normal] [--seed S]

The database and the recordings are on a separate ext4 file system, in a file on a loop device (root only). The
kernel makes the cut: it shuts down the file system without writing its journal (EXT4_IOC_SHUTDOWN,
EXT4_GOING_FLAGS_NOLOGFLUSH; linux/fs/ext4/ioctl.c), so that data not flushed to the device are lost. Then the daemon
is killed, the file system is mounted again, and the checks of kill_test follow: each acknowledged point and chunk is
present, database and recording are sound, the daemon serves again. At the same time other programs write and read
(storekeeper/others.py); their acknowledged data are present as well. Only data received before the cut began count:
a flush during the ioctl can return success for lost bytes; in a real power cut no program is left to receive this.

With --durability normal acknowledged rows must be lost; otherwise these cuts would prove nothing. The command then
exits with 1 if nothing was lost."""
import argparse
import atexit
import fcntl
import os
import random
import shutil
import struct
import subprocess
import sys
import tempfile
import threading
import time

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from kill_test import Acknowledged, check  # noqa: E402
from mdofd import Daemon, simulator  # noqa: E402
from storekeeper.others import Others  # noqa: E402

EXT4_IOC_SHUTDOWN = 0x8004587D  # _IOR('X', 125, __u32)
NO_LOG_FLUSH = struct.pack("=I", 2)
SKIPPED = 77


class Disk:
    """An ext4 file system in a file. The test can cut its power."""

    def __init__(self, folder):
        self.image, self.path = os.path.join(folder, "disk.img"), os.path.join(folder, "disk")
        os.mkdir(self.path)
        with open(self.image, "wb") as f:
            f.truncate(512 << 20)
        subprocess.run(["mkfs.ext4", "-q", self.image], check=True)

    def mount(self):
        return subprocess.run(["mount", "-o", "loop", self.image, self.path],
                              capture_output=True, text=True)

    def cut(self):
        root = os.open(self.path, os.O_RDONLY)
        fcntl.ioctl(root, EXT4_IOC_SHUTDOWN, NO_LOG_FLUSH)
        os.close(root)

    def unmount(self):
        for _ in range(100):
            if subprocess.run(["umount", self.path], capture_output=True).returncode == 0:
                return
            time.sleep(0.05)
        raise RuntimeError(f"{self.path} cannot be unmounted")


def one_life(client, daemon, disk, others, chance):
    """Measures until the power fails. Returns the run, and the data that mdofd had acknowledged before."""
    client.call("live.subscribe", interval_ms=1000)
    run = client.call("run.start", axis="X")["run"]
    acknowledged = Acknowledged()
    listener = threading.Thread(target=acknowledged.listen, args=(client,))
    listener.start()
    others.start()
    time.sleep(chance.uniform(0.05, 2.5))
    points, chunk, cut_ns = len(acknowledged.points), acknowledged.chunk, time.monotonic_ns()
    disk.cut()
    daemon.kill()
    listener.join()
    others.stop()
    del acknowledged.points[points:]
    acknowledged.chunk, acknowledged.until_ns = chunk, cut_ns
    daemon.log.close()  # the log file is on the disk that is unmounted next
    disk.unmount()
    mounted = disk.mount()
    assert mounted.returncode == 0, mounted.stderr
    return run, acknowledged


def campaign(options, disk):
    chance = random.Random(options.seed)
    config = simulator("X", rate_hz=4000, dwell_s=0.3, targets_mm=(0, 0.5, 1.1, 1.6))
    daemon = Daemon(options.mdofd, disk.path, config, options.durability)
    atexit.register(lambda: daemon.process and daemon.process.kill())
    points = chunks = 0
    losses = []
    client = daemon.start()
    others = Others(daemon, options.mdof)
    others.prepare()
    os.sync()  # the configuration and the foreign files must still exist after the first cut
    for cut in range(options.cuts):
        run, acknowledged = one_life(client, daemon, disk, others, chance)
        points, chunks = points + len(acknowledged.points), chunks + acknowledged.chunk
        client = daemon.start()
        try:
            assert not (gone := others.lost(daemon.database, acknowledged.until_ns)), gone
            check(daemon.database, run, acknowledged, client, options.mdof)
        except Exception as loss:  # every result except a correct one is a loss
            losses.append(f"cut {cut}: {type(loss).__name__}: {loss}")
        others.forget()  # the number of a lost table is used again
    daemon.stop()
    daemon.log.close()
    return points, chunks, others, losses


def skip(reason):
    print(f"skipped: no file system can be mounted here: {reason}")
    sys.exit(SKIPPED)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("mdofd")
    parser.add_argument("mdof")
    parser.add_argument("--cuts", type=int, default=200)
    parser.add_argument("--durability", default="full")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    if not shutil.which("mkfs.ext4"):
        skip("there is no mkfs.ext4 (package e2fsprogs)")
    with tempfile.TemporaryDirectory() as folder:
        disk = Disk(folder)
        mounted = disk.mount()
        if mounted.returncode != 0:
            skip(mounted.stderr.strip())
        try:
            points, chunks, others, losses = campaign(options, disk)
        finally:
            disk.unmount()
    assert chunks > 0, "nothing was acknowledged, so nothing was shown"
    print(f"{options.cuts} power cuts, durability {options.durability}: {points} points, {chunks} chunks "
          f"and {others} acknowledged, lost in {len(losses)} cuts")
    print("\n".join(losses[:10]))
    sys.exit(bool(losses) != (options.durability == "normal"))


if __name__ == "__main__":
    main()
