#!/usr/bin/python3
"""The disk is full, or another program has locked the database. mdofd starts, serves the active table, reports the
fault, and continues when it can write again. If a terminal closes, its signal ends a run normally.

usage: storage_test.py MDOFD MDOF"""
import contextlib
import json
import os
import signal
import sqlite3
import subprocess
import sys
import tempfile
import threading
import time
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from mdofd import RIG, Client, Daemon, RpcError, notice_lines, simulator, write_log  # noqa: E402

MDOFD, MDOF = sys.argv[1:3]
IO_ERROR = -32011


class Served(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.daemon = Daemon(MDOFD, os.path.join(self.folder.name, "d"), simulator("X"))
        self.addCleanup(self.end)

    def end(self):
        if self.daemon.process and self.daemon.process.poll() is None:
            self.daemon.stop()

    def wait_for_storage(self, client, state):
        end = time.monotonic() + 5
        while time.monotonic() < end:
            info = client.call("server.info")
            if info["storage"] == state:
                return info["storage_reason"]
            time.sleep(0.05)
        self.fail(f"storage is {info['storage']} ({info['storage_reason']}) and not {state}")

    def wait_for_state(self, client, run, state):
        end = time.monotonic() + 20
        while (now := next(r for r in client.call("run.list")["runs"] if r["run"] == run)["state"]) != state:
            self.assertLess(time.monotonic(), end, f"run {run} is {now}")
            time.sleep(0.05)

    def axis(self, client):
        return client.call("server.info")["axes"][0]

    def cut_off(self, client):
        """Makes an active table, and a run that a kill interrupts."""
        log = os.path.join(self.folder.name, "log.csv")
        write_log(log)
        with open(RIG["X"]) as rig:
            run = client.call("run.replay", path=log, rig=rig.read())["run"]
        table = client.call("compensation.build", runs=[run])["table"]
        client.call("compensation.activate", table=table, despite_warnings=True)
        status = client.call("compensation.status")
        run = client.call("run.start", axis="X")["run"]
        time.sleep(0.3)
        self.daemon.kill()
        return status, run


class SmallDisk(Served):
    def setUp(self):
        super().setUp()
        self.disk = os.path.join(self.folder.name, "disk")
        os.mkdir(self.disk)
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=6m", "tmpfs", self.disk], capture_output=True, text=True)
        if mounted.returncode != 0:
            self.skipTest("a small disk cannot be mounted here: " + mounted.stderr.strip())
        self.addCleanup(lambda: subprocess.run(["umount", "-l", self.disk], check=False))
        self.addCleanup(self.end)  # must run before the unmount
        with open(self.daemon.config) as f:
            config = f.read()
        self.daemon.database = os.path.join(self.disk, "mdof.db")
        with open(self.daemon.config, "w") as f:
            f.write(config.replace(os.path.join(self.daemon.folder, "mdof.db"), self.daemon.database))

    def recordings(self):
        return sorted(os.listdir(os.path.join(self.disk, "recordings")))

    def fill(self):
        with open(os.path.join(self.disk, "filler"), "wb", buffering=0) as f:
            try:
                while True:
                    f.write(b"x" * 4096)
            except OSError:
                pass

    def test_a_cut_off_run_on_a_full_disk_keeps_nobody_from_the_table(self):
        status, run = self.cut_off(self.daemon.start())
        self.fill()
        client = self.daemon.start()
        self.assertEqual(client.call("compensation.status"), status)
        reason = self.wait_for_storage(client, "full")
        self.assertIn("full", reason)
        self.assertIn("tries again", reason)
        text = subprocess.run([MDOF, "status", "--socket", self.daemon.socket], capture_output=True, text=True).stdout
        self.assertIn("storage full", text)
        header = client.call("run.list")["runs"][0]
        self.assertEqual((header["run"], header["state"]), (run, "aborted"))
        self.assertEqual((header["scans"], header["scans_lost"]), (None, None))
        self.assertIn("the end of the run was not stored: mdofd or its computer stopped during the run, or the disk was full", notice_lines(header))
        before = self.recordings()
        for method, params in (("run.start", {"axis": "X"}), ("compensation.deactivate", {"axis": "X"})):
            with self.assertRaises(RpcError) as refusal:
                client.call(method, **params)
            self.assertIn("full", str(refusal.exception))
        self.assertEqual(self.recordings(), before)
        watcher = Client(self.daemon.socket)
        watcher.call("live.subscribe", interval_ms=60_000)
        os.remove(os.path.join(self.disk, "filler"))
        self.wait_for_storage(client, "ok")
        while (event := watcher.next_note()["params"]["value"]).get("type") != "storage":
            pass
        self.assertEqual(event["state"], "ok")
        new = client.call("run.start", axis="X")["run"]
        client.call("run.stop", run=new, abort=True)
        client.call("compensation.deactivate", axis="X")

    def test_record_states_that_the_disk_is_full(self):
        client = self.daemon.start()
        record = subprocess.Popen([MDOF, "record", "--axis", "X", "--socket", self.daemon.socket], text=True,
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        next(line for line in record.stderr if "is in progress" in line)
        self.fill()
        _, err = record.communicate(timeout=60)  # the full disk ends the run
        self.assertEqual(record.returncode, 4, err)
        self.assertRegex(" ".join(err.split()), "run 1 is [a-z]+; storage: .*full")

    def remount(self, how):
        subprocess.run(["mount", "-o", f"remount,{how}", self.disk], check=True)

    def test_a_disk_that_is_read_only_at_the_start_is_written_once_it_can_be(self):
        status, run = self.cut_off(self.daemon.start())
        self.assertGreater(os.path.getsize(self.daemon.database + "-wal"), 0)
        for companion in ("kept", "gone"):
            with self.subTest(shm=companion):
                self.remount("ro")
                client = self.daemon.start()
                self.assertEqual(client.call("compensation.status"), status)
                self.wait_for_storage(client, "full")
                points = client.points(1)
                self.assertGreater(len(points), 0)
                self.remount("rw")
                self.wait_for_storage(client, "ok")
                new = client.call("run.start", axis="X")["run"]
                client.call("run.stop", run=new, abort=True)
                for _ in range(30):
                    self.assertEqual(client.points(1), points)
                    self.assertEqual(client.call("run.list")["runs"][0]["run"], new)
                self.assertEqual(client.call("run.get", run=run)["state"], "aborted")
                self.assertEqual(client.call("server.info")["storage"], "ok")
                self.daemon.kill()
                os.remove(self.daemon.database + "-shm")

    def test_damage_that_a_call_meets_is_told_as_the_state_of_storage(self):
        client = self.daemon.start()
        log = os.path.join(self.folder.name, "log.csv")
        write_log(log)
        with open(RIG["X"]) as rig:
            client.call("run.replay", path=log, rig=rig.read())
        self.daemon.stop()
        with contextlib.closing(sqlite3.connect(self.daemon.database)) as database:
            database.execute("PRAGMA wal_checkpoint(TRUNCATE)")
            root, = database.execute("SELECT rootpage FROM sqlite_schema WHERE name = 'point'").fetchone()
            page, = database.execute("PRAGMA page_size").fetchone()
        client = self.daemon.start()
        with open(self.daemon.database, "r+b") as database:
            database.seek((root - 1) * page)
            database.write(b"\xff" * page)
        with self.assertRaises(RpcError) as refusal:
            client.points(1)
        self.assertIn("SQLITE_CORRUPT", str(refusal.exception))
        self.assertIn("SQLITE_CORRUPT", self.wait_for_storage(client, "damaged"))

    def test_a_run_that_a_full_disk_ends_is_not_said_to_be_under_way(self):
        client = self.daemon.start()
        run = client.call("run.start", axis="X")["run"]
        self.fill()
        self.wait_for_state(client, run, "ended")
        self.assertIsNone(self.axis(client)["run"])
        os.remove(os.path.join(self.disk, "filler"))
        self.wait_for_state(client, run, "failed")
        notices = client.call("run.get", run=run)["notices"]
        lines = [n["text"] for n in notices]
        self.assertEqual(len(set(lines)), len(lines), lines)
        refused, = (n["text"] for n in notices if n["code"] == "end_refused")
        self.assertIn(". To measure the missing points, use: mdof record --resume", refused)
        self.assertNotIn(".;", refused)
        resumed = client.call("run.resume", run=run)["run"]
        client.call("run.stop", run=resumed, abort=True)

    def test_a_run_that_a_full_disk_refuses_leaves_no_empty_recording(self):
        client = self.daemon.start()
        client.call("run.stop", run=client.call("run.start", axis="X")["run"], abort=True)
        before = self.recordings()
        self.fill()
        with self.assertRaises(RpcError) as refusal:
            client.call("run.start", axis="X")
        self.assertIn("full", str(refusal.exception).lower())
        self.assertEqual(self.recordings(), before)
        self.wait_for_storage(client, "full")
        os.remove(os.path.join(self.disk, "filler"))
        self.wait_for_storage(client, "ok")


# Another program that locks the database until its standard input ends.
HOLDER = """
import sqlite3, sys
database = sqlite3.connect(sys.argv[1], isolation_level=None)
for statement in sys.argv[2:]:
    database.execute(statement).fetchall()
print("held", flush=True)
sys.stdin.read()
"""


class HeldDatabase(Served):
    def hold(self, *statements):
        holder = subprocess.Popen([sys.executable, "-c", HOLDER, self.daemon.database, *statements], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.addCleanup(lambda: (holder.kill(), holder.communicate()))
        self.assertEqual(holder.stdout.readline(), "held\n")
        return holder

    def release(self, holder):
        holder.communicate()
        self.assertEqual(holder.returncode, 0)

    def test_a_database_that_another_program_locks_is_served_and_written_once_it_can_be(self):
        status, run = self.cut_off(self.daemon.start())
        holder = self.hold("BEGIN EXCLUSIVE")
        client = self.daemon.start()
        self.assertEqual(client.call("compensation.status"), status)
        self.assertIn("EYX_um", client.call("compensation.at", axis="X", position_mm=1)["error"])
        reason = self.wait_for_storage(client, "held")
        self.assertIn(f"fuser {self.daemon.database}", reason)
        text = subprocess.run([MDOF, "status", "--socket", self.daemon.socket], capture_output=True, text=True).stdout
        self.assertIn("storage held", text)
        for method, params in (("run.start", {"axis": "X"}), ("compensation.deactivate", {"axis": "X"})):
            with self.assertRaisesRegex(RpcError, "another program locks") as refusal:
                client.call(method, **params)
            self.assertEqual(refusal.exception.code, IO_ERROR)
        with open(self.daemon.log.name) as log:
            self.assertIn("storage held: ", log.read())
        self.release(holder)
        self.wait_for_storage(client, "ok")
        self.assertEqual(client.call("compensation.status"), status)
        new = client.call("run.start", axis="X")["run"]
        client.call("run.stop", run=new, abort=True)
        self.assertEqual(client.call("run.get", run=run)["state"], "aborted")
        self.assertTrue(client.call("compensation.deactivate", axis="X")["changed"])

    def test_a_run_that_ended_meanwhile_is_not_said_to_be_under_way(self):
        client = self.daemon.start()
        run = client.call("run.start", axis="X")["run"]
        self.assertEqual((self.axis(client)["run"], self.axis(client)["unstored_run"]), (run, None))
        holder = self.hold("BEGIN IMMEDIATE")
        stopping = Client(self.daemon.socket)
        stopped = []
        thread = threading.Thread(target=lambda: stopped.append(stopping.call("run.stop", run=run, abort=True)))
        thread.start()
        self.addCleanup(thread.join)
        self.wait_for_state(client, run, "ended")
        self.assertIn("run_still_open", [n["code"] for n in client.call("run.get", run=run)["notices"]])
        self.assertEqual((self.axis(client)["run"], self.axis(client)["unstored_run"]), (None, run))
        text = subprocess.run([MDOF, "status", "--socket", self.daemon.socket], capture_output=True, text=True).stdout
        self.assertRegex(text, rf"(?m)^X +{run} \(ended, not stored yet\)")
        listed = ("runs", "--db", self.daemon.database, "--socket", self.daemon.socket)
        text, document = (subprocess.run([MDOF, *listed, *more], capture_output=True, text=True).stdout for more in ((), ("--json",)))
        self.assertRegex(text, rf"(?m)^ *{run} +X +ended ")
        self.assertEqual(json.loads(document), client.call("run.list"))
        for method, params in (("run.start", {"axis": "X"}), ("run.stop", {"run": run}), ("run.resume", {"run": run}), ("encoder.set", {"axis": "X", "position_mm": 1})):
            with self.subTest(method=method), self.assertRaisesRegex(RpcError, "has ended; .*not stored yet"):
                client.call(method, **params)
        self.release(holder)
        thread.join()
        self.assertEqual(stopped[0]["state"], "aborted")
        self.assertEqual(client.call("run.get", run=stopped[0]["run"])["state"], "aborted")
        self.assertEqual((self.axis(client)["run"], self.axis(client)["unstored_run"]), (None, None))

    def test_one_that_cannot_even_be_read_keeps_mdofd_from_starting_and_says_why(self):
        status, _ = self.cut_off(self.daemon.start())
        holder = self.hold("PRAGMA locking_mode = EXCLUSIVE", "BEGIN EXCLUSIVE")
        with self.assertRaisesRegex(RuntimeError, f"fuser {self.daemon.database}"):
            self.daemon.start()
        self.assertNotEqual(self.daemon.process.returncode, 0)
        self.release(holder)
        self.assertEqual(self.daemon.start().call("compensation.status"), status)


class HangUp(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.daemon = Daemon(MDOFD, os.path.join(self.folder.name, "d"), simulator("X"))

    def test_it_seals_the_run_and_ends(self):
        client = self.daemon.start()
        run = client.call("run.start", axis="X")["run"]
        time.sleep(0.2)
        self.daemon.process.send_signal(signal.SIGHUP)
        self.assertEqual(self.daemon.process.wait(20), 0)
        client = self.daemon.start()
        header = client.call("run.get", run=run)
        self.daemon.stop()
        self.assertEqual(header["state"], "aborted")
        self.assertIn("the run was aborted, because mdofd was stopped", notice_lines(header))
        with sqlite3.connect(header["recording"]["path"]) as recording:
            self.assertEqual(recording.execute("SELECT count(*) FROM seal").fetchone(), (1,))

    def test_it_is_ignored_where_nohup_says_so(self):
        self.daemon.arguments = []
        before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
        try:
            client = self.daemon.start()
        finally:
            signal.signal(signal.SIGHUP, before)
        self.daemon.process.send_signal(signal.SIGHUP)
        time.sleep(0.3)
        client.call("server.info")
        self.daemon.stop()


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
