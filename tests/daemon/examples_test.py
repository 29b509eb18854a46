#!/usr/bin/python3
"""The pairs of rig and configuration in daemon/examples can be used without changes. mdofd accepts them. A run
with the named devices, simulated on real sockets, is complete and correct. A replay of its recording is
bit-identical.

usage: examples_test.py MDOFD MDOF MDOF_SIMULATE"""
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from device_setups import Setup, Simulators, worst_errors  # noqa: E402
from each_device_test import measured, replayed, wait_until_all_flow  # noqa: E402
from mdofd import Client, Daemon, RpcError, notice_lines  # noqa: E402

MDOFD, MDOF, SIMULATE = sys.argv[1:4]
EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "daemon" / "examples"
TARGETS = [0, 2, 4.1, 6.2]

# The odd input is connected to ground, so it is 0 V.
T7 = """
[[device]]
name = "t7"
kind = "labjack_t7"
inputs = ["A", "", "B", "", "C", "", "D", "", "E", ""]
um_per_count = 0.5
"""
CAPANCDT = """
[[device]]
name = "above"
kind = "capancdt"
inputs = ["A", "B", "C"]
clock_ppm = 60
[[device]]
name = "beside"
kind = "capancdt"
inputs = ["D", "E"]
clock_ppm = -40
seed = 2
[[device]]
name = "pokeys"
kind = "modbus"
profile = "pokeys57e"
inputs = ["encoder"]
um_per_count = 0.5
"""


# The fixture measures Y, and the encoder is the encoder of Y. The errors are the same in the frame of the axis.
T7_AT_Y = T7.replace('kind = ', 'counter = "DIO2"\nports = [{}, {}]\nkind = ')


def slope(points, wave):
    """Slope of the least-squares line through the true errors of the axis at the positions of these points, in
    µrad."""
    at = [p["position_mm"] for p in points]
    mean = sum(at) / len(at)
    return 1e3 * sum((x - mean) * wave(x) for x in at) / sum((x - mean) ** 2 for x in at)


class Examples(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def taken(self, name):
        """Checks that mdofd accepts the pair without changes. Returns the text of the pair."""
        at = shutil.copytree(EXAMPLES / name, os.path.join(self.folder.name, name))
        done = subprocess.run([MDOFD, "--config", os.path.join(at, "mdofd.toml"), "--check-config"],
                              capture_output=True, text=True,
                              env={**os.environ, "STATE_DIRECTORY": at, "RUNTIME_DIRECTORY": at})
        self.assertEqual(done.returncode, 0, done.stderr)
        text = open(os.path.join(at, "mdofd.toml")).read()
        return at, text

    def run_of(self, at, text):
        daemon = Daemon(os.path.abspath(MDOFD), at, text, relative=True)
        client = daemon.start(timeout_s=60)
        try:
            wait_until_all_flow(client)
            header = measured(daemon, client, TARGETS)
            points = client.points(header["run"])
            daemon.stop()
        finally:
            daemon.process.kill()
            daemon.process.wait()
        self.assertEqual(len(points), 2 * len(TARGETS))
        self.assertEqual(replayed(MDOF, os.path.join(at, header["recording"]["path"]))["points"], points)
        return header, points

    def right(self, name, plan, replace, straightness_um, angle_urad):
        at, text = self.taken(name)
        setup = Setup(os.path.join(at, "rig_X.toml"), plan, "", 0, 0, targets=TARGETS, dwell_s=0.5, speed_mm_s=25)
        simulators = Simulators(SIMULATE, setup, at)
        try:
            for address, port, new in replace:
                self.assertEqual(text.count(f'"{address}"'), 1)
                text = text.replace(f'"{address}"', '"%s"' % simulators.addresses[port] + new(simulators.addresses))
            header, points = self.run_of(at, text)
        finally:
            simulators.kill()
        for key, error in worst_errors(points).items():
            self.assertLess(error, straightness_um if key.endswith("_um") else angle_urad, (key, notice_lines(header)))
        self.assertIn("datum_missing", [n["code"] for n in header["notices"]])

    def test_five_lion_precision_and_an_encoder_on_a_t7(self):
        self.right("lion-precision-t7", T7,
                   [("192.168.1.207", "t7 command",
                     lambda of: "\nstream_port = " + of["t7 stream"].rsplit(":", 1)[1])], 0.03, 2)

    def test_five_lion_precision_and_the_encoders_of_two_axes_on_a_t7(self):
        at, text = self.taken("lion-precision-t7-xy")

        def plan(axis, t7):
            setup = Setup(os.path.join(at, f"rig_{axis}.toml"), t7, "", 0, 0, targets=TARGETS, dwell_s=0.5, speed_mm_s=25)
            if axis == "Y":  # in the frame of axis Y, EXY is -δy and EAY is -εy
                setup.plan_text = lambda of=setup.plan_text(): of.replace('"EYX"', '"EXY"').replace('"EBX"', '"EAY"')
            return Simulators(SIMULATE, setup, at)

        t7 = plan("X", T7)
        self.addCleanup(lambda: t7.kill())
        command, stream = (t7.addresses[f"t7 {port}"] for port in ("command", "stream"))
        port = stream.rsplit(":", 1)[1]
        self.assertEqual(text.count('"192.168.1.207"'), 1)
        daemon = Daemon(os.path.abspath(MDOFD), at, text.replace('"192.168.1.207"', f'"{command}"\nstream_port = {port}'),
                        relative=True)
        client = daemon.start(timeout_s=60)
        self.addCleanup(daemon.process.kill)

        def trouble():
            return {d["axis"]: " ".join(d["trouble"]) for d in client.call("device.list")["devices"]}

        def wait(condition):
            end = time.monotonic() + 60
            while not condition():
                self.assertLess(time.monotonic(), end, client.call("device.list"))
                time.sleep(0.02)

        def live(axis):
            watcher = Client(daemon.socket)
            watcher.call("live.subscribe", interval_ms=100, events=False)
            while (value := watcher.next_note()["params"]["value"])["axis"] != axis:
                pass
            watcher.socket.close()
            return value

        def refused(run):
            with self.assertRaisesRegex(RpcError, f'device "t7" are in use for axis X: run {run} is under way') as no:
                client.call("run.start", axis="Y")
            self.assertEqual(no.exception.code, -32002)

        wait_until_all_flow(client)
        x = measured(daemon, client, TARGETS, "X", refused)
        self.assertEqual((live("Y")["encoder_mm"], live("Y")["still"]), (0, True))  # X and Y have separate counts
        points = {"X": client.points(x["run"])}
        for key, error in worst_errors(points["X"]).items():
            self.assertLess(error, 0.03 if key.endswith("_um") else 2, (key, notice_lines(x)))

        t7.kill()  # the T7 is off while a user moves the fixture to the other axis
        wait(lambda: all("lost" in text for text in trouble().values()))
        t7 = plan("Y", T7_AT_Y.format(command.rsplit(":", 1)[1], port))
        wait(lambda: all("datum is lost" in text and "lost:" not in text for text in trouble().values()))

        def set_at_rest():
            shown = live("Y")
            if not shown["still"]:
                return False
            try:
                client.call("encoder.set", axis="Y", position_mm=shown["encoder_mm"])
            except RpcError as error:
                self.assertIn("moves", str(error))
                return False
            return True

        wait(set_at_rest)
        wait(lambda: trouble()["Y"] == "")
        self.assertIn("datum is lost", trouble()["X"])  # no user has set its position yet
        y = measured(daemon, client, TARGETS, "Y")
        points["Y"] = client.points(y["run"])
        as_x = [{"position_mm": p["position_mm"], "EYX_um": p["EXY_um"], "EZX_um": -p["EZY_um"], "EAX_urad": p["EBY_urad"],
                 "EBX_urad": p["EAY_urad"], "ECX_urad": p["ECY_urad"]} for p in points["Y"]]
        for key, error in worst_errors(as_x).items():
            self.assertLess(error, 0.03 if key.endswith("_um") else 2, (key, notice_lines(y)))

        fit = client.call("squareness.fit", run_x=x["run"], run_y=y["run"])
        wave = lambda d: 2 * math.sin(2 * math.pi * d / 10)  # noqa: E731
        expected = -slope(points["X"], wave) - slope(points["Y"], wave)
        self.assertAlmostEqual(fit["EC0Y_urad"], expected, delta=5)  # tolerance: 0.03 µm over 6 mm
        daemon.stop()
        for header, axis in ((x, "X"), (y, "Y")):
            self.assertEqual(len(points[axis]), 2 * len(TARGETS))
            again = replayed(MDOF, os.path.join(at, header["recording"]["path"]))
            self.assertEqual(again["points"], points[axis])

    def test_two_capancdt_and_an_encoder_on_a_pokeys(self):
        data = lambda name: lambda of: f"\ndata_port = " + of[f"{name} data"].rsplit(":", 1)[1]  # noqa: E731
        self.right("capancdt-pokeys", CAPANCDT,
                   [("192.168.0.7", "above command", data("above")), ("192.168.0.8", "beside command", data("beside")),
                    ("192.168.0.9", "pokeys modbus", lambda of: "")], 0.03, 2)

    def test_a_script(self):
        at, text = self.taken("script")
        header, points = self.run_of(at, text)
        worst = [p["EYX_um"] - 2 * math.sin(2 * math.pi * p["position_mm"] / 10) for p in points]
        self.assertLess(max(worst) - min(worst), 0.02)
        # The script sends positions and not counts.
        self.assertNotIn("datum_missing", [n["code"] for n in header["notices"]])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[4:], verbosity=2)
