#!/usr/bin/python3
"""Live devices on real sockets measure one simulated machine: two capaNCDT controllers and a T7, each with its own
clock. mdofd measures, records, and reacts to the faults of the devices.

usage: devices_test.py MDOFD MDOF MDOF_SIMULATE"""
import json
import math
import os
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from device_setups import worst_errors  # noqa: E402
from mdofd import DATA, Client, Daemon, RpcError, notice_lines  # noqa: E402

MDOFD, MDOF, SIMULATE = sys.argv[1:4]
RIG = os.path.join(DATA, "devices", "rig_X.toml")
TARGETS = [0, 2, 4.1, 6.2]
# Limits from the errors of the devices: 24 bits of 2000 µm, 16 bits of 20 V times 10 µm/V, and noise.
STRAIGHTNESS_UM, ANGLE_URAD = 0.08, 6

PLAN = """
rig = "{rig}"
[machine]
targets_mm = {targets}
speed_mm_s = 100
acceleration_mm_s2 = 4000
dwell_s = 0.4
noise_um = 0.002
[[machine.error]]
name = "EYX"
amplitude_um = 2
period_mm = 10
[[machine.error]]
name = "EBX"
amplitude_urad = 30
period_mm = 8

[[device]]
name = "capa-1"
kind = "capancdt"
ports = [{ports[0]}, {ports[1]}]
inputs = ["A", "B"]
clock_ppm = 60
jitter_ms = 3
[[device]]
name = "capa-2"
kind = "capancdt"
ports = [{ports[2]}, {ports[3]}]
inputs = ["", "C"]
clock_ppm = -40
jitter_ms = 3
seed = 2
[[device]]
name = "t7"
kind = "labjack_t7"
ports = [{ports[4]}, {ports[5]}]
inputs = ["D", "E"]
um_per_count = 0.01
jitter_ms = 1
seed = 3
"""

CONFIG = """
[[axis]]
rig = "{rig}"
[[axis.device]]
driver = "capancdt"
name = "capa-1"
address = "127.0.0.1:{ports[0]}"
data_port = {ports[1]}
sample_time_us = 256
channel = [{{ id = "A", input = "1" }}, {{ id = "B", input = "2" }}]
[[axis.device]]
driver = "capancdt"
name = "capa-2"
address = "127.0.0.1:{ports[2]}"
data_port = {ports[3]}
sample_time_us = 256
channel = [{{ id = "C", input = "2" }}]
[[axis.device]]
driver = "labjack_t7"
name = "t7"
address = "127.0.0.1:{ports[4]}"
stream_port = {ports[5]}
rate_hz = 4000
[[axis.device.channel]]
id = "encoder"
input = "DIO0"
um_per_count = 0.01
most_counts_per_s = 1e9
[[axis.device.channel]]
id = "D"
input = "AIN0"
[[axis.device.channel]]
id = "E"
input = "AIN1"
"""


if os.environ.get("MDOF_SANITIZED"):  # with sanitizers, the simulator needs more than one core at 4 kHz
    CONFIG = CONFIG.replace("sample_time_us = 256", "sample_time_us = 960").replace("rate_hz = 4000", "rate_hz = 1000")


class Simulators:
    """mdof-simulate with a plan. At the first start it uses free ports; after a restart it uses the same ports."""

    def __init__(self, folder):
        self.plan = os.path.join(folder, "devices.toml")
        self.ports = [0] * 6
        self.start()

    def start(self):
        with open(self.plan, "w") as f:
            f.write(PLAN.format(rig=RIG, targets=TARGETS, ports=self.ports))
        self.process = subprocess.Popen([SIMULATE, self.plan], stdout=subprocess.PIPE, text=True)
        lines = []
        while not lines or lines[-1] != "ready":
            line = self.process.stdout.readline()
            assert line, "mdof-simulate ended"
            lines.append(line.strip())
        self.ports = [int(line.rsplit(":", 1)[1]) for line in lines[:-1]]

    def kill(self):
        self.process.kill()
        self.process.wait()
        self.process.stdout.close()


class Devices(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.simulators = Simulators(cls.folder.name)
        cls.daemon = Daemon(MDOFD, cls.folder.name, CONFIG.format(rig=RIG, ports=cls.simulators.ports))
        cls.client = cls.daemon.start()

    @classmethod
    def tearDownClass(cls):
        cls.daemon.stop()
        cls.simulators.kill()
        cls.folder.cleanup()

    def devices(self):
        return {d["device"]: d for d in self.client.call("device.list")["devices"]}

    def wait_until(self, condition, what, timeout_s=60):
        end = time.monotonic() + timeout_s
        while not condition():
            self.assertLess(time.monotonic(), end, f"{what}: {self.devices()}")
            time.sleep(0.02)

    def wait_until_all_flow(self):
        before = {name: d["scans"] for name, d in self.devices().items()}
        self.wait_until(lambda: all(d["state"] == "open" and d["scans"] > before[n] + 1000
                                    for n, d in self.devices().items()), "not all devices give samples")

    def measured(self, **params):
        watcher = Client(self.daemon.socket, timeout_s=120)
        watcher.call("live.subscribe", interval_ms=1000)
        run = self.client.call("run.start", axis="X", **params)["run"]
        progress = []
        while True:
            value = watcher.next_note()["params"]["value"]
            if value.get("type") == "progress" and value["run"] == run:
                progress.append(value)
            if value.get("type") == "ended":
                return value["run"], progress

    def test_1_a_live_run_is_right_and_replays_to_the_same_bits(self):
        self.wait_until_all_flow()
        run, progress = self.measured(targets_mm=TARGETS, repeats=2)
        header = self.client.call("run.get", run=run)
        self.assertEqual(header["state"], "complete", header)
        points = self.client.points(run)
        self.assertGreaterEqual(len(points), 16)
        self.assertEqual(progress[-1]["points"], len(points))
        self.assertEqual(progress[0]["of"], 16)
        code, out, err = self.replayed(header)
        self.assertEqual(code, 0, err)
        self.assertEqual(json.loads(out)["points"], points)
        self.check_against_truth(points)

    def replayed(self, header, *options):
        done = subprocess.run([MDOF, "replay", header["recording"]["path"], "--no-store", "--json", *options],
                              capture_output=True, text=True)
        return done.returncode, done.stdout, done.stderr

    def check_against_truth(self, points):
        for key, worst in worst_errors(points).items():
            self.assertLess(worst, STRAIGHTNESS_UM if key.endswith("_um") else ANGLE_URAD, key)

    def test_2_the_clocks_of_the_devices_are_reported(self):
        # The jitter is 3 ms. After half a minute the drift is known to some ppm.
        def drift_ppm(name):
            clock = self.devices()[name]["clock"]
            return clock["drift_ppm"] if clock and clock["settled"] else math.inf

        self.wait_until(lambda: abs(drift_ppm("capa-1") - 60) < 30 and abs(drift_ppm("capa-2") + 40) < 30,
                        "the drifts are not found")

    def test_3_devices_that_go_and_come_back_are_reopened(self):
        self.wait_until_all_flow()
        self.simulators.kill()
        self.wait_until(lambda: all(d["state"] != "open" for d in self.devices().values()),
                        "a device without a peer is still open")
        for device in self.devices().values():
            self.assertTrue(device["error"])
        self.simulators.start()
        self.wait_until_all_flow()
        self.assertTrue(all(d["reopened"] > 0 for d in self.devices().values()))
        # After the power failure, the count of the T7 begins at 0 again. Its position is unknown, but the
        # probes are good ...
        self.wait_until(lambda: self.live()["encoder_quality"] == "suspect", "the position is not suspect")
        self.assertEqual(self.qualities(), {"good"})
        self.assertIsNone(self.live()["errors"])
        # ... until a user has restored the zero and restarts mdofd.
        self.daemon.stop()
        type(self).client = self.daemon.start()
        self.wait_until_all_flow()
        self.assertEqual(self.qualities(), {"good"})
        self.assertEqual(self.live()["encoder_quality"], "good")
        run, _ = self.measured(targets_mm=TARGETS, repeats=1)
        self.assertEqual(self.client.call("run.get", run=run)["state"], "complete")

    def live(self):
        watcher = Client(self.daemon.socket)
        watcher.call("live.subscribe", interval_ms=20, events=False)
        value = watcher.next_note()["params"]["value"]
        watcher.socket.close()
        return value

    def qualities(self):
        return {p["quality"] for p in self.live()["probes"]}

    def test_4_silence_is_shown_as_stale(self):
        self.wait_until_all_flow()
        watcher = Client(self.daemon.socket)
        watcher.call("live.subscribe", interval_ms=20, events=False)
        self.assertFalse(watcher.next_note()["params"]["value"]["stale"])
        self.simulators.kill()
        try:
            while not (value := watcher.next_note()["params"]["value"])["stale"]:
                pass
            self.assertTrue(all(p["quality"] in ("stale", "missing") for p in value["probes"]))
            self.assertIsNone(value["errors"])
        finally:
            self.simulators.start()
            self.daemon.stop()  # after the restart, the count of the T7 is not valid
            type(self).client = self.daemon.start()

    def say_where_it_stands(self):
        """Sets the position that mdofd already shows. The axis moves all the time, so a late request is rejected,
        or sets the position at another stop."""
        end = time.monotonic() + 120
        while time.monotonic() < end:
            watcher = Client(self.daemon.socket)
            watcher.call("live.subscribe", interval_ms=20, events=False)
            since = None
            while since is None or time.monotonic() - since < 0.25:
                value = watcher.next_note()["params"]["value"]
                since = (since or time.monotonic()) if value["still"] else None
            watcher.socket.close()
            before_mm = self.client.call("server.info")["axes"][0]["encoder"]["offset_mm"]
            try:
                now_mm = self.client.call("encoder.set", axis="X", position_mm=value["encoder_mm"] - before_mm)["offset_mm"]
            except RpcError as error:
                self.assertIn("moves", str(error))
                continue
            if abs(now_mm) < 0.001:
                return
        self.fail("it never stood still")

    def test_6_a_run_that_was_cut_off_goes_on(self):
        self.wait_until_all_flow()
        self.say_where_it_stands()
        watcher = Client(self.daemon.socket, timeout_s=120)
        watcher.call("live.subscribe", interval_ms=1000)
        cut = self.client.call("run.start", axis="X", targets_mm=TARGETS, repeats=2)["run"]
        points = 0
        while points < 5:
            value = watcher.next_note()["params"]["value"]
            points = value["points"] if value.get("type") == "progress" else points
        with self.assertRaisesRegex(RpcError, "under way"):
            self.client.call("run.resume", run=cut)
        self.daemon.kill()
        type(self).client = self.daemon.start()
        self.assertEqual(self.client.call("run.get", run=cut)["state"], "aborted")
        before = self.client.points(cut)
        self.wait_until_all_flow()
        # It is unknown whether the device has kept its count. If the count was lost, two positions would have the same
        # target number.
        with self.assertRaisesRegex(RpcError, "has lost its datum since the run.*mdof encoder set"):
            self.client.call("run.resume", run=cut)
        self.say_where_it_stands()
        done = subprocess.run([MDOF, "record", "--socket", self.daemon.socket, "--resume", str(cut),
                               "--json"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        header = json.loads(done.stdout)
        self.assertEqual(header["state"], "complete")
        self.assertTrue(any(f"continues run {cut}" in w and "set on" in w for w in notice_lines(header)), header)
        self.assertEqual(header["options"]["encoder_datum"]["kind"], "set")
        self.check_both_parts(header, cut, before)
        for run, why in ((header["run"], "is complete"), (cut, "supersedes this run"), (4711, "4711")):
            with self.assertRaisesRegex(RpcError, why):
                self.client.call("run.resume", run=run)

    def check_both_parts(self, header, cut, before):
        points = self.client.points(header["run"])
        # The stored points must not change in any bit. Only the last stop may change, because it may have continued
        # during the fault. u of the points changes, because it includes the repeatability of the run, which now has
        # more repeats.
        def stored(some):
            return [{k: v for k, v in p.items() if k not in ("u", "u_random", "U", "k", "nu_eff")} for p in some]

        self.assertEqual(stored(points[:len(before) - 1]), stored(before[:-1]))
        again, last = stored([points[len(before) - 1], before[-1]])
        self.assertTrue(again == last or "interrupted" in again["flags"], (again, last))
        # An interrupted stop may have no reading of a probe. Then the point has no errors and has a reason.
        solved = [p for p in points if p["EYX_um"] is not None]
        self.assertTrue(all(p["flags"] for p in points if p not in solved), points)
        self.assertGreaterEqual(len(solved), 16)
        self.check_against_truth(solved)
        code, out, err = self.replayed(header)
        self.assertEqual(code, 0, err)
        self.assertEqual(json.loads(out)["points"], points)
        ways = {(round(p["position_mm"], 1), p["direction"]) for p in points}
        self.assertEqual(len(ways), 8, ways)

    def test_5_record_measures_and_says_so(self):
        self.wait_until_all_flow()
        done = subprocess.run([MDOF, "record", "--socket", self.daemon.socket, "--axis", "X",
                               "--targets-mm", ",".join(map(str, TARGETS)), "--repeats", "1",
                               "--scale-period-um", "100", "--json"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(json.loads(done.stdout)["state"], "complete")
        self.assertIn("of 8", done.stderr)
        self.assertIn("periodic error", done.stderr)

    def test_7_a_run_begun_before_the_clocks_are_known_says_so(self):
        def warnings():
            started = self.client.call("run.start", axis="X", targets_mm=TARGETS)
            self.client.call("run.stop", run=started["run"], abort=True)
            return [n["text"] for n in started["notices"] if n["severity"] == "doubtful"]

        self.daemon.stop()
        type(self).client = self.daemon.start()
        self.wait_until(lambda: all(d["state"] == "open" for d in self.devices().values()), "not all are open")
        self.assertTrue(any('clock of device "capa-1" had not settled' in w for w in warnings()))
        self.wait_until(lambda: all(d["clock"]["settled"] for d in self.devices().values()), "clocks do not settle")
        self.assertEqual(warnings(), [])

    def test_8_channels_with_delays_replay_to_the_same_bits(self):
        self.daemon.stop()
        delayed = CONFIG.replace('input = "1"', 'input = "1", delay_us = 3840').replace(
            'input = "AIN1"', 'input = "AIN1"\ndelay_us = 6500')
        type(self).daemon = Daemon(MDOFD, self.folder.name,
                                   delayed.format(rig=RIG, ports=self.simulators.ports))
        type(self).client = self.daemon.start()
        self.wait_until_all_flow()
        run, _ = self.measured(targets_mm=TARGETS, repeats=1)
        header, points = self.client.call("run.get", run=run), self.client.points(run)
        self.assertEqual(header["state"], "complete", header)
        self.check_against_truth(points)
        code, out, err = self.replayed(header)
        self.assertEqual(code, 0, err)
        self.assertEqual(json.loads(out)["points"], points)
        code, _, err = self.replayed(header, "--settle-s", "0.005")
        self.assertEqual(code, 2, err)
        self.assertIn("set settle_s in [measure] to 0.0065 or more", err)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
