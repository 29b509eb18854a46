#!/usr/bin/python3
"""A live run is complete only if it has all targets of all repeats. A run that ended early is partial. It names
the missing targets, is used for tables only on request, and can be continued.

usage: run_state_test.py MDOFD MDOF"""
import json
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from mdofd import Client, Daemon, RpcError, notice_lines, simulator  # noqa: E402

MDOFD, MDOF = sys.argv[1:3]
TARGETS = [0, 2, 4.1, 6.2]


def mdof(*words):
    done = subprocess.run([MDOF, *map(str, words)], capture_output=True, text=True)
    return done.returncode, done.stdout, done.stderr


class RunState(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.daemon = Daemon(MDOFD, cls.folder.name, simulator("X", targets_mm=TARGETS))
        cls.client = cls.daemon.start()
        cls.partial = cls.stopped_early()

    @classmethod
    def tearDownClass(cls):
        cls.daemon.stop()
        cls.folder.cleanup()

    @classmethod
    def watcher(cls):
        watcher = Client(cls.daemon.socket, timeout_s=60)
        watcher.call("live.subscribe", interval_ms=1000)
        return watcher

    @classmethod
    def stopped_early(cls):
        """Stops a run with two repeats after six of sixteen points. Returns its header."""
        return cls.stopped_early_by(cls.client, cls.watcher())

    @staticmethod
    def stopped_early_by(client, watcher):
        run = client.call("run.start", axis="X", targets_mm=TARGETS, repeats=2, note="half", scale_period_um=100)["run"]
        points = 0
        while points < 6:
            value = watcher.next_note()["params"]["value"]
            points = value["points"] if value.get("type") == "progress" else points
        stopped = client.call("run.stop", run=run)["run"]
        while (value := watcher.next_note()["params"]["value"]).get("type") != "ended":
            pass
        assert (value["run"], value["state"]) == (stopped, "partial"), value
        return client.call("run.get", run=stopped)

    def ended(self, watcher):
        while True:
            value = watcher.next_note()["params"]["value"]
            if value.get("type") == "ended":
                return self.client.call("run.get", run=value["run"])

    def missing_of(self, header):
        """The number of missing points for each (target, direction), calculated here from the points."""
        missing = {(t + 1, d): 2 for t in range(len(TARGETS)) for d in (1, -1)}
        for p in self.client.points(header["run"]):
            if p["EYX_um"] is not None and missing[p["target"], p["direction"]] > 0:
                missing[p["target"], p["direction"]] -= 1
        return missing

    def test_a_run_ended_early_is_partial_and_says_what_is_missing(self):
        self.assertEqual(self.partial["state"], "partial")
        missing = self.missing_of(self.partial)
        said = [w for w in notice_lines(self.partial) if "requested points are missing" in w]
        self.assertEqual(len(said), 1, notice_lines(self.partial))
        self.assertIn(f"{sum(missing.values())} of 16 requested points", said[0])
        for (target, direction), n in missing.items():
            if n > 0:
                of_target = said[0].split(f"target {target} at")[1].split(";")[0]
                self.assertIn(f"{n} {'forward' if direction > 0 else 'reverse'}", of_target)
        self.assertIn("mdof record --resume", str(notice_lines(self.partial)))

    def test_what_lists_runs_says_partial(self):
        code, out, err = mdof("runs", "--db", self.daemon.database, "--json")
        self.assertEqual(code, 0, err)
        states = {r["run"]: r["state"] for r in json.loads(out)["runs"]}
        self.assertEqual(states[self.partial["run"]], "partial")

    def test_its_recording_replays_to_the_same_partial_run(self):
        code, out, err = mdof("replay", self.partial["recording"]["path"], "--no-store", "--json")
        self.assertEqual(code, 0, err)
        again = json.loads(out)
        self.assertEqual(again["points"], self.client.points(self.partial["run"]))
        self.assertEqual((again["state"], again["note"]), ("partial", "half"))
        self.assertEqual(again["options"], self.partial["options"])

    def test_a_table_from_it_is_asked_for(self):
        run = self.partial["run"]
        with self.assertRaisesRegex(RpcError, f"run {run} is partial.*--partial"):
            self.client.call("compensation.build", runs=[run])
        built = self.client.call("compensation.build", runs=[run], partial=True)
        self.assertIn(f"run {run}, which is partial", notice_lines(built)[0])
        code, _, err = mdof("compensation", "build", run, "--db", self.daemon.database, "--socket", self.daemon.socket)
        self.assertEqual(code, 3)
        self.assertIn("--partial", err)
        code, out, err = mdof("compensation", "build", run, "--partial", "--json", "--db", self.daemon.database,
                              "--socket", self.daemon.socket)
        self.assertEqual(code, 0, err)
        self.assertEqual(notice_lines(json.loads(out)), notice_lines(built))

    def test_it_can_be_gone_on_with(self):
        """The recording of the continued run contains the request too."""
        partial = self.stopped_early()
        watcher = self.watcher()
        resumed = self.client.call("run.resume", run=partial["run"])["run"]
        header = self.ended(watcher)
        self.assertEqual(header["state"], "complete", notice_lines(header))
        self.assertIn(header["supersedes"], (partial["run"], resumed))
        self.assertTrue(all(n == 0 for n in self.missing_of(header).values()))
        for run in (partial, header):  # both runs must have the same targets
            self.assertEqual([n["code"] for n in run["notices"]].count("scale_period_hidden"), 1, notice_lines(run))
        code, out, err = mdof("replay", header["recording"]["path"], "--no-store", "--json")
        self.assertEqual(code, 0, err)
        again = json.loads(out)
        self.assertEqual(again["points"], self.client.points(header["run"]))
        for key in ("state", "note", "options", "notices"):
            self.assertEqual(again[key], header[key])
        with self.assertRaisesRegex(RpcError, "is complete"):
            self.client.call("run.resume", run=header["run"])

    def test_the_continuation_of_a_killed_run_has_the_notices_of_its_request(self):
        with tempfile.TemporaryDirectory() as folder:
            daemon = Daemon(MDOFD, folder, simulator("X", targets_mm=TARGETS))
            client = daemon.start()
            watcher = Client(daemon.socket, timeout_s=60)
            watcher.call("live.subscribe", interval_ms=1000)
            run = client.call("run.start", axis="X", targets_mm=TARGETS, repeats=2, scale_period_um=100)["run"]
            while watcher.next_note()["params"]["value"].get("type") != "points":
                pass
            daemon.kill()
            client = daemon.start()
            resumed = client.call("run.resume", run=run)
            self.assertIn("scale_period_hidden", [n["code"] for n in resumed["notices"]])
            end = client.call("run.stop", run=resumed["run"])["run"]
            codes = [n["code"] for n in client.call("run.get", run=end)["notices"]]
            self.assertEqual(codes.count("scale_period_hidden"), 1, codes)
            daemon.stop()

    def test_with_other_settings_or_devices_it_is_another_run(self):
        with tempfile.TemporaryDirectory() as folder:
            daemon = Daemon(MDOFD, folder, simulator("X", targets_mm=TARGETS))
            client = daemon.start()
            watcher = Client(daemon.socket, timeout_s=60)
            watcher.call("live.subscribe", interval_ms=1000)
            run = self.stopped_early_by(client, watcher)["run"]
            daemon.stop()
            with open(daemon.config) as f:
                config = f.read()
            before, device = config.split("[axis.device]")
            others = {"other settings of the measurement": "[measure]\nmodel = \"simplified\"\n" + config,
                      "was simulated": before + '[axis.device]\ndriver = "csv_stream"\nsource = "tcp://127.0.0.1:1"\n'}
            for why, other in others.items():
                with open(daemon.config, "w") as f:
                    f.write(other)
                client = daemon.start()
                with self.assertRaisesRegex(RpcError, f"run {run} cannot be continued: .*{why}"):
                    client.call("run.resume", run=run)
                daemon.stop()
            with open(daemon.config, "w") as f:
                f.write(config)
            self.assertGreater(daemon.start().call("run.resume", run=run)["run"], run)
            daemon.stop()

    def test_a_channel_of_two_scripts_starts_no_run(self):
        """The columns of a script are known only when it runs. Readings of two sources must not be mixed."""
        rig = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../data/devices/rig_X.toml")
        config = f'[[axis]]\nrig = "{rig}"\n'
        with tempfile.TemporaryDirectory() as folder:
            for name, columns in (("one", "encoder_mm,A_um,B_um,C_um"), ("two", "A_um,D_um,E_um")):
                with open(f"{folder}/{name}.py", "w") as script:
                    script.write(f'import time\nprint("{columns}", flush=True)\n'
                                 f'while True:\n    print("{",".join("0" * len(columns.split(",")))}", flush=True)\n    time.sleep(0.05)\n')
                config += f'[[axis.device]]\ndriver = "csv_stream"\nname = "{name}"\ncommand = ["python3", "{folder}/{name}.py"]\n'
            daemon = Daemon(MDOFD, folder, config)
            self.addCleanup(daemon.stop)
            client = daemon.start()
            while not all(device["scans"] for device in client.call("device.list")["devices"]):
                time.sleep(0.02)
            with self.assertRaisesRegex(RpcError, 'channel "A" comes from two devices, "one" and "two"; remove the channel'):
                client.call("run.start", axis="X")

    def test_a_missing_column_of_a_script_is_a_trouble(self):
        """Before, only mdof doctor reported it, and only if mdofd did not run."""
        rig = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../data/devices/rig_X.toml")
        with tempfile.TemporaryDirectory() as folder:
            with open(f"{folder}/one.py", "w") as script:
                script.write('import time\nprint("encoder_mm,A_um,B_um,C_um,D_um", flush=True)\n'
                             'while True:\n    print("0,0,0,0,0", flush=True)\n    time.sleep(0.05)\n')
            daemon = Daemon(MDOFD, folder, f'[[axis]]\nrig = "{rig}"\n[[axis.device]]\ndriver = "csv_stream"\nname = "one"\n'
                                           f'command = ["python3", "{folder}/one.py"]\n')
            self.addCleanup(daemon.stop)
            client = daemon.start()
            while not (device := client.call("device.list")["devices"][0])["scans"]:
                time.sleep(0.02)
            lines = [line for line in device["trouble"] if ": missing: " in line]
            self.assertEqual(len(lines), 1, device)
            self.assertRegex(lines[0], r'device "one": missing: no device provides channel "E" of .*rig_X.toml.* \(channels of this device: encoder, A, B, C, D\)')
            started = client.call("run.start", axis="X")
            self.assertIn(("trouble_at_start", "missing"), [(n["code"], n.get("kind")) for n in started["notices"]])
            client.call("run.stop", run=started["run"], abort=True)

    def test_a_free_run_stopped_is_what_was_asked_for(self):
        watcher = self.watcher()
        run = self.client.call("run.start", axis="X")["run"]
        points = 0
        while points < 2:  # a run with only one position would be doubtful
            points += watcher.next_note()["params"]["value"].get("type") == "points"
        self.client.call("run.stop", run=run)
        header = self.ended(watcher)
        self.assertEqual(header["state"], "complete", notice_lines(header))

    def test_record_ended_by_the_user_fails_and_says_how_to_go_on(self):
        record = subprocess.Popen([MDOF, "record", "--socket", self.daemon.socket, "--axis", "X", "--targets-mm",
                                   ",".join(map(str, TARGETS)), "--repeats", "9", "--json"],
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        said = ""
        while "point 2 of 72" not in said:
            said = record.stderr.readline()
            self.assertTrue(said, "mdof record ended")
        record.send_signal(signal.SIGINT)
        out, err = record.communicate(timeout=60)
        self.assertEqual(record.returncode, 1, err)
        header = json.loads(out)
        self.assertEqual(header["state"], "partial")
        self.assertIn(f"run {header['run']} is partial", err)
        self.assertIn(f"mdof record --resume {header['run']}", err)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2, warnings="ignore")
