#!/usr/bin/python3
"""The pairs of rig and configuration in daemon/examples work as they are: mdofd takes them, and with the devices that they
name (simulated, on real sockets) a run is complete and right, and its recording gives the same bits.

usage: examples_test.py MDOFD MDOF MDOF_SIMULATE"""
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from device_setups import Setup, Simulators, worst_errors  # noqa: E402
from each_device_test import measured, replayed, wait_until_all_flow  # noqa: E402
from mdofd import Daemon  # noqa: E402

MDOFD, MDOF, SIMULATE = sys.argv[1:4]
EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "daemon" / "examples"
TARGETS = [0, 2, 4.1, 6.2]

# A ground that is wired to the odd input is 0 V there.
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


class Examples(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def taken(self, name):
        """mdofd takes the pair as it is; its text."""
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
            self.assertLess(error, straightness_um if key.endswith("_um") else angle_urad, (key, header["warnings"]))
        self.assertIn("has no datum", " ".join(header["notes"]))

    def test_five_lion_precision_and_an_encoder_on_a_t7(self):
        self.right("lion-precision-t7", T7,
                   [("192.168.1.207", "t7 command",
                     lambda of: "\nstream_port = " + of["t7 stream"].rsplit(":", 1)[1])], 0.03, 2)

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
        self.assertEqual(header["notes"], [])  # a script says positions, not counts


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[4:], verbosity=2)
