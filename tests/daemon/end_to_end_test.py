#!/usr/bin/python3
"""mdofd from a client's view: runs, live view, squareness, compensation, and a replay with bit-identical results.

usage: end_to_end_test.py MDOFD MDOF"""
import fcntl
import json
import math
import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest


sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from mdofd import DATA, Client, Daemon, RpcError, notice_lines, replay, simulator  # noqa: E402
from result_schemas import methods  # noqa: E402

MDOFD, MDOF = sys.argv[1:3]
TARGETS = [0, 2, 4.1, 6.2]
# X and Y move the workpiece, Z moves the tool. Therefore the corrections of EYX and EZX have opposite signs.
MACHINE = '[machine]\nchain = "w-Y-X-b-Z-t"\n'
# If a run begins during a stop, it warns that this stop is too short.
MAYBE_BEGUN_IN_A_STOP = {"despite_warnings": True}
SIMULATED = {"simulated": True, **MAYBE_BEGUN_IN_A_STOP}
FACTOR = {"EYX_um": -1, "EZX_um": 1}


def mdof(*words):
    done = subprocess.run([MDOF, *map(str, words)], capture_output=True, text=True)
    return done.returncode, done.stdout, done.stderr


def catches(process_id, signal_number):
    with open(f"/proc/{process_id}/status") as status:
        caught = next(line for line in status if line.startswith("SigCgt:"))
    return int(caught.split()[1], 16) >> (signal_number - 1) & 1


class EndToEnd(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        config = MACHINE + simulator("X", targets_mm=TARGETS) + replay(
            "Y", os.path.join(DATA, "five-probe", "log_Y.csv.gz"))
        cls.daemon = Daemon(MDOFD, cls.folder.name, config)
        cls.client = cls.daemon.start()

    @classmethod
    def tearDownClass(cls):
        cls.daemon.stop()
        cls.folder.cleanup()

    def measured(self, **params):
        """Starts a run, waits for its end and returns its id."""
        watcher = Client(self.daemon.socket)
        watcher.call("live.subscribe", interval_ms=1000)
        run = self.client.call("run.start", **params)["run"]
        while True:
            value = watcher.next_note()["params"]["value"]
            if value.get("type") == "ended" and value["axis"] == params["axis"]:
                return value["run"]

    def test_a_live_run_is_replayed_to_the_same_bits(self):
        run = self.measured(axis="X", targets_mm=TARGETS, repeats=2, note="after scraping", scale_period_um=1)
        header = self.client.call("run.get", run=run)
        self.assertEqual(header["state"], "complete")
        self.assertTrue(header["simulated"])
        points = self.client.points(run)
        self.assertGreaterEqual(len(points), 16)
        self.assertTrue(all(p["flags"] == [] or p["flags"] == ["approach_assumed"] for p in points))
        code, out, err = mdof("replay", header["recording"]["path"], "--no-store", "--json")
        self.assertEqual(code, 0, err)
        again = json.loads(out)
        self.assertEqual(again["points"], points)
        self.assertIn("periodic error", str(notice_lines(header)))
        table = self.client.call("compensation.build", runs=[run])["table"]
        with self.assertRaisesRegex(RpcError, "not activated: .*despite_warnings"):
            self.client.call("compensation.activate", table=table, simulated=True)
        with self.assertRaisesRegex(RpcError, "is simulated.*--simulated, or \"simulated\": true") as no:
            self.client.call("compensation.activate", table=table, despite_warnings=True)
        self.assertEqual(no.exception.data, {"remedy": "allow_simulated"})
        for key in ("straightness", "angles", "state", "note", "options", "notices"):
            self.assertEqual(again[key], header[key])
        self.assertEqual(again["recording"]["sha256"], header["recording"]["sha256"])
        code, out, err = mdof("replay", header["recording"]["path"], "--no-store", "--json", "--note", "other",
                              "--targets-mm", *TARGETS[1:])
        self.assertEqual(code, 0, err)  # options on the command line replace the options of the configuration
        self.assertEqual(json.loads(out)["options"]["targets_mm"], TARGETS[1:])
        self.assertEqual(json.loads(out)["note"], "other")

    def test_a_replayed_log_gives_what_the_command_line_gives(self):
        run = self.measured(axis="Y")
        code, out, err = mdof("replay", os.path.join(DATA, "five-probe", "log_Y.csv.gz"), "--rig",
                              os.path.join(DATA, "five-probe", "rig_Y.toml"), "--no-store", "--json")
        self.assertEqual(code, 0, err)
        self.assertEqual(json.loads(out)["points"], self.client.points(run))
        self.assertFalse(self.client.call("run.get", run=run)["simulated"])

    def test_a_run_stopped_in_a_dwell_keeps_its_id_and_that_point(self):
        # On a busy computer, the axis may have started to move before the request arrives. Then the test tries again.
        for _ in range(5):
            run, stopped, still_mm = self.stopped_in_a_dwell()
            points = self.client.points(stopped)
            if abs(points[-1]["position_mm"] - still_mm) < 0.01:
                break
        self.assertEqual(stopped, run)
        # The run is complete only if it has all targets. Otherwise it names the missing targets.
        seen = {p["target"] for p in points}
        header = self.client.call("run.get", run=run)
        self.assertEqual(header["state"], "complete" if len(seen) == len(TARGETS) else "partial")
        for target in range(1, len(TARGETS) + 1):
            self.assertEqual(f"target {target} at" in str(notice_lines(header)), target not in seen, header)
        self.assertIsNone(self.client.call("run.list", count=1)["runs"][0]["supersedes"])

    def stopped_in_a_dwell(self):
        watcher = Client(self.daemon.socket)
        watcher.call("live.subscribe", interval_ms=20, events=True)
        # The targets are given here. Without them, a run that begins in reverse numbers its targets again at each new
        # target.
        run = self.client.call("run.start", axis="X", targets_mm=TARGETS)["run"]
        points = 0
        while points < 3:
            value = watcher.next_note()["params"]["value"]
            points += len(value["points"]) if value.get("type") == "points" else 0
        while not (value.get("still") and value.get("run") == run):
            value = watcher.next_note()["params"]["value"]
        return run, self.client.call("run.stop", run=run)["run"], value["encoder_mm"]

    def test_compensation_is_built_activated_and_served(self):
        run = self.measured(axis="X", targets_mm=TARGETS, repeats=1)
        built = self.client.call("compensation.build", runs=[run])
        self.assertTrue(built["simulated"])
        before = self.client.call("server.info")["generation"]
        active = self.client.call("compensation.activate", table=built["table"], **SIMULATED)
        self.assertTrue(active["simulated"])
        self.assertGreater(active["generation"], before)
        grid = self.client.call("compensation.grid", axis="X")
        self.assertEqual([round(p["position_mm"], 3) for p in grid["points"]], TARGETS)
        for side, direction in (("forward", 1), ("reverse", -1)):
            for point in grid["points"]:
                at = self.client.call("compensation.at", axis="X", direction=direction,
                                      position_mm=point["position_mm"])
                self.assertTrue(at["simulated"])
                self.assertEqual(at["reference"], "fixture")
                for key, correction in at["correction"].items():
                    self.assertAlmostEqual(at["error"][key], point[side][key], 9)
                    if key in FACTOR:
                        self.assertAlmostEqual(correction, FACTOR[key] * point[side][key], 9)
                    else:  # the chain has no rotary axis
                        self.assertIsNone(correction)
                self.assertIn("no axis A", at["correction_reason"])
        inside, beyond = (self.client.call("compensation.at", axis="X", position_mm=x, direction=1)
                          for x in (grid["points"][-1]["position_mm"], 1000))
        self.assertTrue(inside["inside"])
        self.assertFalse(beyond["inside"])
        self.assertEqual(inside["correction"], beyond["correction"])
        self.assertNotIn(None, inside["u"].values())
        self.assertEqual({*beyond["u"].values(), *beyond["u_interpolation"].values()}, {None})
        self.assertIn("this approach was not measured at this position, so u is unknown", beyond["u_covers"])
        with self.assertRaises(RpcError) as changed:
            self.client.call("compensation.grid", axis="X", generation=active["generation"] - 1)
        self.assertEqual(changed.exception.code, -32001)

    def test_without_a_chain_the_correction_is_null(self):
        run = self.measured(axis="Y")
        table = self.client.call("compensation.build", runs=[run], reference="carriage")
        self.assertEqual((table["reference"], table["reference_mm"]), ("carriage", None))
        self.assertEqual(table["chain"], "w-Y-X-b-Z-t")
        folder = os.path.join(self.folder.name, "no_chain")
        other = Daemon(MDOFD, folder, replay("Y", os.path.join(DATA, "five-probe", "log_Y.csv.gz")))
        client = other.start()
        try:
            watcher = Client(other.socket)
            watcher.call("live.subscribe", interval_ms=1000)
            run = client.call("run.start", axis="Y")["run"]
            while watcher.next_note()["params"]["value"].get("type") != "ended":
                pass
            client.call("compensation.activate", **MAYBE_BEGUN_IN_A_STOP,
                        table=client.call("compensation.build", runs=[run])["table"])
            at = client.call("compensation.at", axis="Y", position_mm=10, direction=1)
            self.assertIsNone(at["correction"])
            self.assertIn("chain of the machine is unknown", at["correction_reason"])
            self.assertNotEqual(at["error"]["EXY_um"], None)
        finally:
            other.stop()

    def test_a_table_survives_a_restart(self):
        run = self.measured(axis="X", targets_mm=TARGETS, repeats=1)
        table = self.client.call("compensation.build", runs=[run])["table"]
        self.client.call("compensation.activate", table=table, **SIMULATED)
        before = self.client.call("compensation.at", axis="X", position_mm=3)
        self.daemon.stop()
        type(self).client = self.daemon.start()
        self.assertEqual(self.client.call("compensation.at", axis="X", position_mm=3), before)

    def test_squareness_has_its_uncertainty(self):
        simulated = self.measured(axis="X", targets_mm=TARGETS, repeats=1)
        y = self.measured(axis="Y")
        with self.assertRaisesRegex(RpcError, f"run {simulated} is simulated and run {y} is measured"):
            self.client.call("squareness.fit", run_x=simulated, run_y=y)
        five_probe = os.path.join(DATA, "five-probe")
        with open(os.path.join(five_probe, "rig_X.toml")) as rig:
            x = self.client.call("run.replay", path=os.path.join(five_probe, "log_X.csv.gz"), rig=rig.read())["run"]
        s = self.client.call("squareness.fit", run_x=x, run_y=y)
        self.assertAlmostEqual(s["EC0Y_urad"], -s["slope_EYX_urad"] - s["slope_EXY_urad"] + s["square_tilt_urad"], 9)
        self.assertAlmostEqual(s["u_EC0Y_urad"], math.hypot(s["u_slope_EYX_urad"], s["u_slope_EXY_urad"]), 5)
        self.assertEqual(s["u_EC0Y_urad"], s["u_random_EC0Y_urad"])
        self.assertAlmostEqual(s["U_EC0Y_urad"], s["k"] * s["u_EC0Y_urad"], 9)
        self.assertIn("no uncertainties are declared", s["u_covers"])
        self.assertFalse(s["simulated"])
        with self.assertRaises(RpcError):
            self.client.call("squareness.fit", run_x=y, run_y=x)

    def test_one_run_an_axis_at_a_time(self):
        run = self.client.call("run.start", axis="X")["run"]
        with self.assertRaises(RpcError) as refused:
            self.client.call("run.start", axis="X")
        self.assertEqual(refused.exception.code, -32002)
        self.client.call("run.stop", run=run, abort=True)
        self.assertEqual(self.client.call("run.get", run=run)["state"], "aborted")
        with self.assertRaisesRegex(RpcError, "is aborted"):
            self.client.call("compensation.build", runs=[run])
        with self.assertRaises(RpcError):
            self.client.call("run.stop", run=run)

    def test_the_live_view_shows_probes_errors_and_that_all_is_simulated(self):
        watcher = Client(self.daemon.socket)
        watcher.call("live.subscribe", interval_ms=20, events=False)
        value = watcher.next_note()["params"]["value"]
        self.assertEqual([p["id"] for p in value["probes"]], list("ABCDE"))
        self.assertTrue(value["simulated"])
        self.assertEqual(value["probes"][0]["quality"], "simulated")
        self.assertEqual(value["probes"][0]["range_um"], 200)
        self.assertEqual(sorted(value["errors"]), ["EAX_urad", "EBX_urad", "ECX_urad", "EYX_um", "EZX_um"])

    def test_bad_calls_say_what_is_wrong(self):
        for method, params, words in (
                ("run.start", {"axis": "Z"}, "no rig is configured"),
                ("run.start", {"axis": "Q"}, "must be X, Y or Z"),
                ("run.start", {"axis": "X", "targets_mm": [2, 1]}, "ascend"),
                ("run.start", {"axis": "X", "tagets_mm": [1]}, "targets_mm"),
                ("run.get", {"run": 4711}, "4711"),
                ("compensation.build", {"runs": []}, "at least one run"),
                ("compensation.activate", {"table": 4711}, "4711"),
                ("compensation.at", {"axis": "Y", "position_mm": 0}, "no compensation table"),
                ("compensation.at", {"axis": "X"}, "position_mm"),
                ("run.points", {"run": 1, "count": 100000}, "count")):
            with self.subTest(method=method, params=params), self.assertRaisesRegex(RpcError, words):
                self.client.call(method, **params)

    def test_discovery_lists_every_method_with_a_working_example(self):
        names = [m["name"] for m in methods(self.client)]
        for name in ("server.info device.list live.subscribe run.start run.stop run.list run.get "
                     "run.points squareness.fit compensation.build compensation.activate "
                     "compensation.status compensation.grid compensation.at rpc.discover").split():
            self.assertIn(name, names)

    def test_systemd_is_told_when_it_serves_and_that_it_works(self):
        with tempfile.TemporaryDirectory() as folder:
            told = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
            told.bind(os.path.join(folder, "notify"))
            told.settimeout(5)
            other = Daemon(MDOFD, os.path.join(folder, "d"), simulator("X"))
            other.environment = {"NOTIFY_SOCKET": os.path.join(folder, "notify"),
                                 "WATCHDOG_USEC": "400000"}
            other.start()
            messages = [told.recv(4096).decode() for _ in range(4)]
            other.stop()
            self.assertIn("READY=1", messages[0])
            self.assertTrue(all("WATCHDOG=1" in m for m in messages[1:]), messages)

    @unittest.skipUnless(shutil.which("systemd-socket-activate"), "no systemd-socket-activate")
    def test_systemd_hands_the_socket_over(self):
        with tempfile.TemporaryDirectory() as folder:
            other = Daemon("/usr/bin/systemd-socket-activate", os.path.join(folder, "d"), simulator("X"))
            other.arguments = ["-l", other.socket, MDOFD]
            client = other.start()  # this connection starts mdofd (socket activation)
            self.assertEqual(client.call("server.info")["server"], "mdofd")
            other.stop()

    def test_a_stop_that_comes_while_it_starts_is_heeded(self):
        with tempfile.TemporaryDirectory() as folder:
            other = Daemon(MDOFD, folder, simulator("X"))
            with open(other.database, "w") as database:
                fcntl.lockf(database, fcntl.LOCK_EX, 1, 1 << 62)  # another writer; mdofd waits until it ends
                process = subprocess.Popen([MDOFD, "--config", other.config], stderr=subprocess.PIPE, text=True)
                end = time.monotonic() + 4
                while not catches(process.pid, signal.SIGTERM) and time.monotonic() < end:
                    time.sleep(0.01)
                process.terminate()
            process.communicate(timeout=20)
            self.assertEqual(process.returncode, 0)

    def test_a_second_daemon_on_the_database_is_refused(self):
        other = Daemon(MDOFD, os.path.join(self.folder.name, "other"), "")
        text = open(other.config).read().replace(other.database, self.daemon.database)
        open(other.config, "w").write(text)
        with self.assertRaisesRegex(RuntimeError, "(?i)writ|lock"):
            other.start()


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2, warnings="ignore")
