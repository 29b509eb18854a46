#!/usr/bin/python3
"""An incremental encoder starts at 0 at any position of the axis. Runs and tables state that the positions have no
datum, until a user sets the position (encoder.set, mdof encoder set) or the configuration contains the offset
(offset_mm). If the device loses power, runs and tables state again that there is no datum.

usage: encoder_datum_test.py MDOFD MDOF MDOF_SIMULATE"""
import json
import os
import re
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from device_setups import SETUPS, Simulators  # noqa: E402
from mdofd import Client, Daemon, RpcError, notice_lines, replay, simulator, write_log  # noqa: E402

MDOFD, MDOF, SIMULATE = sys.argv[1:4]
TARGETS = [0, 2, 4.1]


def datum_notices(*documents):
    return [n for document in documents for n in document["notices"] if n["code"] in ("datum_missing", "position_lost")]


class EncoderDatum(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.setup_ = SETUPS["labjack_t7"]
        self.setup_.targets, self.setup_.dwell_s = TARGETS, 0.5
        shutil.copy(self.setup_.rig, self.folder.name)
        self.simulators = Simulators(SIMULATE, self.setup_, self.folder.name)
        self.addCleanup(lambda: self.simulators.kill())  # ends the simulators that run at the end of the test

    def begin(self, change=lambda text: text):
        self.offset_mm, self.said_mm = 0, []
        self.daemon = Daemon(MDOFD, self.folder.name, change(self.setup_.config_text(self.simulators.addresses)))
        self.client = self.daemon.start()
        self.wait(lambda: self.device()["scans"] > 300)

    def tearDown(self):
        self.daemon.stop()

    def device(self):
        return self.client.call("device.list")["devices"][0]

    def wait(self, condition, timeout_s=30):
        end = time.monotonic() + timeout_s
        while not condition():
            self.assertLess(time.monotonic(), end, self.device())
            time.sleep(0.02)

    def mdof(self, *words):
        done = subprocess.run([MDOF, *map(str, words)], capture_output=True, text=True, timeout=60)
        return done.returncode, done.stdout, " ".join(done.stderr.split())

    def measured(self, shift_mm=0):
        targets = [round(t + shift_mm, 4) for t in TARGETS]
        started = self.client.call("run.start", axis="X", targets_mm=targets, repeats=1)
        self.wait(lambda: not any(axis["run"] for axis in self.client.call("server.info")["axes"]))
        run = self.client.call("run.list", count=1)["runs"][0]["run"]
        return started, self.client.call("run.get", run=run), self.client.points(run)

    def shown_still(self):
        """A new reading of the axis at rest."""
        watcher = Client(self.daemon.socket)
        watcher.call("live.subscribe", interval_ms=20, events=False)
        since = None
        while True:
            value = watcher.next_note()["params"]["value"]
            since = (since or time.monotonic()) if value["still"] else None
            if since and time.monotonic() - since > 0.25:
                watcher.socket.close()
                return value["encoder_mm"]

    def set_by_rpc(self, position_mm):
        return self.client.call("encoder.set", axis="X", position_mm=position_mm)["offset_mm"]

    def set_by_command_line(self, position_mm):
        code, out, err = self.mdof("encoder", "set", "X", position_mm, "--socket", self.daemon.socket)
        if code != 0:
            raise RpcError({"message": err, "code": code})
        self.assertRegex(out, r'axis X is now at [\d.-]+ mm; device "t7" now has the offset [\d.-]+ mm')
        return float(re.search(r"offset ([\d.-]+) mm", out).group(1))

    def set_at_rest(self, wanted_mm, set_position):
        """Sets the machine position of the axis to `wanted_mm`. The axis moves all the time, so a late request is
        rejected or sets the position at another stop. In this case the request is repeated."""
        for _ in range(100):
            position_mm = self.shown_still() + wanted_mm - self.offset_mm
            try:
                self.offset_mm = set_position(position_mm)
            except RpcError as error:
                self.assertIn("moves", str(error))
                continue
            self.said_mm = self.said_mm + [position_mm]
            if abs(self.offset_mm - wanted_mm) < 0.01:
                return
        self.fail(f"the offset is {self.offset_mm} mm and not {wanted_mm}")

    def test_a_run_without_datum_says_so_and_one_with_it_does_not(self):
        self.begin()
        started, header, _ = self.measured()
        for notices in (started["notices"], header["notices"]):
            (notice,) = [n for n in notices if "datum" in n["text"]]
            self.assertEqual((notice["code"], notice["severity"], notice["subject"]), ("datum_missing", "information", "t7"))
            self.assertIn("mdof encoder set", notice["text"])
        code, out, err = self.mdof("show", header["run"], "--db", self.daemon.database)
        self.assertEqual(code, 0, err)
        self.assertIn("has no datum", " ".join(out.split()))
        self.assertIn("mdof encoder set", " ".join(out.split()))
        # The notice is information and not a warning. The errors of the axis are correct; only the positions of a
        # table would be shifted.
        code, out, err = self.mdof("compensation", "build", header["run"], "--db", self.daemon.database,
                                   "--socket", self.daemon.socket, "--json")
        self.assertEqual(code, 0, err)
        self.assertIn("has no datum", err)
        table = json.loads(out)
        (notice,) = [n for n in table["notices"] if n["code"] == "datum_missing"]
        self.assertEqual((notice["source"], notice["severity"]), (f"run {header['run']}", "information"))
        with self.assertRaisesRegex(RpcError, "has no datum.*mdof encoder set"):
            self.client.call("compensation.activate", table=table["table"])
        self.client.call("compensation.activate", table=table["table"], despite_warnings=True)
        self.check_replay(header)

        self.set_at_rest(112.5, self.set_by_rpc)
        started, header, points = self.measured(112.5)
        self.assertEqual(datum_notices(started, header), [])
        self.assertEqual(header["state"], "complete", notice_lines(header))
        datum = header["options"]["encoder_datum"]
        self.assertEqual((datum["kind"], datum["device"]), ("set", "t7"))
        self.assertIn(f"uid {os.getuid()}", datum["by"])
        for p in points:
            nearest = min(TARGETS, key=lambda t: abs(t + 112.5 - p["position_mm"]))
            self.assertLess(abs(nearest + 112.5 - p["position_mm"]), 0.01, p)
        self.check_replay(header)
        # If a user sets the position twice, the second offset replaces the first.
        self.set_at_rest(0, self.set_by_rpc)

    def check_replay(self, header):
        code, out, err = self.mdof("replay", header["recording"]["path"], "--no-store", "--json")
        self.assertEqual(code, 0, err)
        again = json.loads(out)
        self.assertEqual(again["points"], self.client.points(header["run"]))
        for key in ("options", "straightness"):
            self.assertEqual(again[key], header[key], key)
        self.assertEqual(datum_notices(again), datum_notices(header))

    def test_not_in_a_run_nor_in_motion_nor_of_a_log(self):
        self.begin()
        run = self.client.call("run.start", axis="X")["run"]
        with self.assertRaisesRegex(RpcError, "a run of axis X is under way"):
            self.client.call("encoder.set", axis="X", position_mm=1)
        time.sleep(0.3)
        self.client.call("run.stop", run=run, abort=True)
        refused = 0  # number of refused requests during a whole pass; the axis moves only in a part of the pass
        end = time.monotonic() + 4
        while time.monotonic() < end:
            try:
                self.client.call("encoder.set", axis="X", position_mm=1)
            except RpcError as error:
                self.assertIn("stop the axis at a known position", str(error))
                refused += 1
            time.sleep(0.005)
        self.assertGreater(refused, 10)
        for position in (float("1e7"), "12"):
            with self.assertRaises(RpcError):
                self.client.call("encoder.set", axis="X", position_mm=position)
        with self.assertRaisesRegex(RpcError, "no rig is configured for axis Y"):
            self.client.call("encoder.set", axis="Y", position_mm=1)

    def test_the_datum_goes_with_the_power_and_comes_back_by_the_command_line(self):
        self.begin()
        self.set_at_rest(30, self.set_by_rpc)
        ports = [int(a.rsplit(":", 1)[1]) for a in self.simulators.addresses.values()]
        self.simulators.kill()
        self.setup_.plan = self.setup_.plan.replace('kind = "labjack_t7"', f'kind = "labjack_t7"\nports = {ports}', 1)
        self.simulators = Simulators(SIMULATE, self.setup_, self.folder.name)
        self.wait(lambda: any("datum is lost" in t for t in self.device()["trouble"]))
        started = self.client.call("run.start", axis="X")
        self.assertIn("datum is lost", " ".join(notice_lines(started)))
        (lost,) = [n for n in started["notices"] if n["code"] == "position_lost"]
        self.assertEqual((lost["without_power"], lost["configured"], lost["counted"]), (1, 0, 1))
        self.client.call("run.stop", run=started["run"], abort=True)
        self.set_at_rest(37, self.set_by_command_line)
        self.assertEqual(self.device()["trouble"], [])
        time.sleep(0.3)
        started, header, points = self.measured(37)
        self.assertEqual(header["state"], "complete", notice_lines(header))
        self.assertEqual(datum_notices(header) + started["notices"], [])
        self.assertNotIn("no valid position", " ".join(notice_lines(header)))
        self.assertEqual(len(points), 2 * len(TARGETS))

    def encoder(self):
        return self.client.call("server.info")["axes"][0]["encoder"]

    def status(self):
        code, out, err = self.mdof("status", "--socket", self.daemon.socket)
        self.assertEqual(code, 0, err)
        return " ".join(out.split())

    def test_it_is_stored_with_who_said_it_and_a_restart_tells_what_it_forgot(self):
        self.begin()
        encoder = self.encoder()
        self.assertEqual((encoder["datum"], encoder["offset_mm"]), ("none", 0))
        self.assertIn("has no datum", encoder["note"])
        self.assertIn("encoder of X: the encoder (device \"t7\") has no datum", self.status())
        self.set_at_rest(112.5, self.set_by_rpc)
        encoder = self.encoder()
        self.assertEqual((encoder["datum"], encoder["offset_mm"]), ("set", self.offset_mm))
        said = self.client.call("history.list", count=1)["history"][0]
        self.assertEqual((said["deed"], said["of"]), ("encoder.set", "encoder_datum"))
        self.assertEqual((said["uid"], said["gid"], said["pid"]), (os.getuid(), os.getgid(), os.getpid()))
        stands = re.match(r"X set to ([\d.]+) mm; the position before was ([\d.-]+) mm$", said["detail"])
        self.assertTrue(stands, said["detail"])
        position_mm, before_mm = map(float, stands.groups())
        self.assertAlmostEqual(position_mm, self.said_mm[-1], places=6)
        if len(self.said_mm) == 1:
            self.assertAlmostEqual(position_mm - before_mm, self.offset_mm, places=6)
        self.assertRegex(encoder["note"], rf"^set to {position_mm:.9g} mm on {said['utc']} by uid {os.getuid()} ")
        code, out, err = self.mdof("history", "--db", self.daemon.database)
        self.assertIn(said["detail"], " ".join(out.split()), err)
        self.assertEqual(self.client.call("history.list")["total"], len(self.said_mm))
        self.daemon.stop()
        code, out, err = self.mdof("verify", "--db", self.daemon.database)
        self.assertEqual(code, 0, out + err)

        self.client = self.daemon.start()
        self.offset_mm = 0
        encoder = self.encoder()
        self.assertEqual((encoder["datum"], encoder["offset_mm"]), ("none", 0))
        lost = f"the axis position {position_mm:.9g} mm, which was set on {said['utc']}, was lost when mdofd restarted. "
        self.assertTrue(encoder["note"].startswith(lost), encoder["note"])
        self.assertIn("encoder of X: " + lost, self.status())
        started = self.client.call("run.start", axis="X")
        self.assertIn(lost, " ".join(n["text"] for n in started["notices"]))
        self.client.call("run.stop", run=started["run"], abort=True)
        self.wait(lambda: self.device()["scans"] > 300)
        self.set_at_rest(30, self.set_by_rpc)
        self.assertTrue(self.encoder()["note"].startswith("set to "))
        self.daemon.stop()
        with sqlite3.connect(self.daemon.database) as database:
            database.execute("DROP TRIGGER encoder_datum_no_update")
            database.execute("UPDATE encoder_datum SET offset_m = 1 WHERE id = 1")
        database.close()
        code, out, err = self.mdof("verify", "--db", self.daemon.database)
        self.assertEqual(code, 1, out + err)
        self.assertIn("encoder datum 1: was changed after it was stored", " ".join((out + err).split()))
        self.client = self.daemon.start()

    def test_what_cannot_be_stored_does_not_hold(self):
        self.begin()
        other = sqlite3.connect(self.daemon.database, isolation_level=None)
        other.execute("BEGIN IMMEDIATE")
        end = time.monotonic() + 20
        told = "moves"
        while "moves" in told and time.monotonic() < end:
            self.shown_still()
            with self.assertRaises(RpcError) as refused:
                self.client.call("encoder.set", axis="X", position_mm=100)
            told = str(refused.exception)
        other.execute("ROLLBACK")
        other.close()
        self.assertIn("SQLITE_BUSY", told)
        self.assertEqual((self.encoder()["datum"], self.encoder()["offset_mm"]), ("none", 0))
        self.assertEqual(self.client.call("history.list")["total"], 0)
        self.set_at_rest(5, self.set_by_rpc)  # encoder.set is possible again

    def test_the_configuration_may_say_it(self):
        self.begin(lambda text: text.replace('input = "DIO0"', 'input = "DIO0", offset_mm = -250.25'))
        started, header, points = self.measured(-250.25)
        self.assertEqual(datum_notices(started, header), [])
        self.assertEqual(header["options"]["encoder_datum"]["kind"], "configured")
        self.assertEqual(header["options"]["encoder_datum"]["offset_mm"], -250.25)
        self.assertEqual(len(points), 2 * len(TARGETS))
        self.check_replay(header)

    def test_a_run_states_that_the_configuration_replaced_a_position_that_was_set(self):
        self.begin(lambda text: text.replace('input = "DIO0"', 'input = "DIO0", offset_mm = -250.25'))
        self.offset_mm = -250.25
        self.set_at_rest(30, self.set_by_rpc)
        self.daemon.stop()
        self.client = self.daemon.start()
        self.wait(lambda: self.device()["scans"] > 300)
        started, header, points = self.measured(-250.25)
        self.assertEqual([(n["code"], n["configured"]) for n in datum_notices(header)], [("position_lost", 1)])
        self.assertEqual(datum_notices(started), datum_notices(header))
        code, out, err = self.mdof("compensation", "build", header["run"], "--db", self.daemon.database,
                                   "--socket", self.daemon.socket, "--json")
        self.assertEqual(code, 0, err)
        with self.assertRaisesRegex(RpcError, "offset_mm of the configuration applies"):
            self.client.call("compensation.activate", table=json.loads(out)["table"])

    def test_a_probe_has_no_such_offset(self):
        self.begin()
        for channel, why in (('input = "AIN0"', "applies to the encoder only"), ('input = "DIO0"', "position of the axis")):
            config = self.setup_.config_text(self.simulators.addresses)
            value = "1e9" if channel.endswith('DIO0"') else "1"
            bad = os.path.join(self.folder.name, "bad.toml")
            with open(bad, "w") as f:
                f.write(config.replace(channel, channel + f", offset_mm = {value}"))
            done = subprocess.run([MDOFD, "--config", bad, "--check-config"], capture_output=True, text=True)
            self.assertNotEqual(done.returncode, 0)
            self.assertRegex(done.stderr, r"bad.toml:\d+: .*offset_mm")
            self.assertIn(why, done.stderr)


class Units(unittest.TestCase):
    """For every device, mdofd rejects a position in volts without a scale. The message has the line of the
    configuration and a remedy."""

    def test_an_encoder_in_volts_is_refused_before_anything_is_opened(self):
        with tempfile.TemporaryDirectory() as folder:
            shutil.copy(SETUPS["labjack_t7"].rig, folder)
            for device, why in (
                    ('driver = "modbus"\nprofile = "adam-6017"\naddress = "127.0.0.1"\n'
                     'channel = [{ id = "encoder", input = "AI0" }]', "is in V, .* use an input in um, in mm"),
                    ('driver = "pokeys57u"\nchannel = [{ id = "encoder", input = "analogue1" }]',
                     "is in V, .* use an input in um, in mm"),
                    ('driver = "modbus"\nprofile = "adam-6017"\naddress = "127.0.0.1"\n'
                     'channel = [{ id = "encoder", input = "AI0", um_per_count = 3 }]', "um_per_count applies to counts"),
                    ('driver = "labjack_t7"\naddress = "127.0.0.1"\nchannel = [{ id = "encoder", input = "AIN0" }]',
                     r"is in V, .*set um_per_V in \[encoder\] of .*rig_volts_X.toml")):
                config = os.path.join(folder, "mdofd.toml")
                with open(config, "w") as f:
                    f.write(f'[store]\ndatabase = "{folder}/mdof.db"\n[rpc]\nsocket = "{folder}/s"\n[[axis]]\n'
                            f'rig = "rig_volts_X.toml"\n[[axis.device]]\n{device}\n[[axis.device]]\n'
                            'driver = "csv_stream"\ncommand = ["true"]\n')
                done = subprocess.run([MDOFD, "--config", config, "--check-config"], capture_output=True, text=True)
                self.assertNotEqual(done.returncode, 0, device)
                self.assertRegex(done.stderr, r"mdofd.toml:\d+: axis\[1\].device\[1\].channel.*" + why)
                if "is in V" not in why:
                    continue
                with open(os.path.join(folder, "rig_volts_X.toml")) as rig, \
                        open(os.path.join(folder, "scaled.toml"), "w") as scaled:
                    scaled.write(rig.read() + "\n[encoder]\num_per_V = 500\n")
                with open(config) as f:
                    text = f.read()
                with open(config, "w") as f:
                    f.write(text.replace("rig_volts_X", "scaled"))
                done = subprocess.run([MDOFD, "--config", config, "--check-config"], capture_output=True, text=True)
                self.assertNotIn("is in V", done.stderr)


class Simulated(unittest.TestCase):
    def test_what_knows_its_positions_needs_no_datum(self):
        with tempfile.TemporaryDirectory() as folder:
            daemon = Daemon(MDOFD, folder, simulator("X"))
            client = daemon.start()
            started = client.call("run.start", axis="X")
            time.sleep(2)
            header = client.call("run.get", run=client.call("run.stop", run=started["run"])["run"])
            daemon.stop()
            self.assertEqual(datum_notices(started, header), [])
            self.assertNotIn("encoder_datum", header["options"])

    def test_what_was_set_is_told_of_a_device_and_not_of_a_log(self):
        with tempfile.TemporaryDirectory() as folder:
            def encoder(config, act=lambda client: None):
                daemon = Daemon(MDOFD, folder, config)
                client = daemon.start()
                self.addCleanup(client.socket.close)
                act(client)
                told = client.call("server.info")["axes"][0]["encoder"]
                daemon.stop()
                return told

            def set_at_rest(client):
                end = time.monotonic() + 20
                while time.monotonic() < end:
                    try:
                        return client.call("encoder.set", axis="X", position_mm=12.5)
                    except RpcError:
                        time.sleep(0.01)

            self.assertEqual(encoder(simulator("X")), {"datum": "absolute", "offset_mm": 0, "note": None})
            told = encoder(simulator("X"), set_at_rest)
            self.assertEqual(told["datum"], "set")
            self.assertRegex(told["note"], "^set to 12.5 mm on ")
            headers = []
            def measure(client):
                headers.append(client.call("run.start", axis="X"))
                time.sleep(2)
                headers.append(client.call("run.get", run=client.call("run.stop", run=headers[0]["run"])["run"]))
            told = encoder(simulator("X"), measure)
            self.assertEqual(told["datum"], "absolute")
            self.assertEqual([(n["code"], n["configured"]) for n in datum_notices(*headers)], 2 * [("position_lost", 0)])
            self.assertRegex(told["note"], "^the axis position 12.5 mm, which was set on .*, was lost when mdofd restarted.*mdofd uses the positions of the device")
            log = os.path.join(folder, "log.csv")
            write_log(log)
            self.assertIsNone(encoder(replay("X", log))["note"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[4:], verbosity=2)
