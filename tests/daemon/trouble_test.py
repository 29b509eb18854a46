#!/usr/bin/python3
"""Faults of a T7 on real sockets. While mdofd uses the T7, no other program can open it. If the T7 is silent, mdofd
marks the data as stale in its reply to the first client that asks. If the T7 restarts, mdofd reports the restart at
once with the cause.

usage: trouble_test.py MDOFD MDOF MDOF_SIMULATE"""
import fcntl
import json
import os
import pty
import re
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import termios
import time
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from mdofd import DATA, Client, Daemon, notice_lines  # noqa: E402

MDOFD, MDOF, SIMULATE = sys.argv[1:4]
TARGETS = [0, 2, 4.1, 6.2]

PLAN = """
rig = "{rig}"
[machine]
targets_mm = {targets}
speed_mm_s = 100
acceleration_mm_s2 = 4000
dwell_s = 0.35
noise_um = 0.002
[[device]]
name = "t7"
kind = "labjack_t7"
ports = [{ports[0]}, {ports[1]}]
inputs = ["A", "B", "C", "D", "E"]
um_per_count = 0.01
"""

CONFIG = """
tcp_port = {tcp_port}
[[axis]]
rig = "rig_volts_X.toml"
[[axis.device]]
driver = "labjack_t7"
name = "t7"
address = "127.0.0.1:{ports[0]}"
stream_port = {ports[1]}
rate_hz = 1000
channel = [{{ id = "encoder", input = "DIO0", um_per_count = 0.01, most_counts_per_s = 1e9 }}, {{ id = "A", input = "AIN0" }},
  {{ id = "B", input = "AIN1" }}, {{ id = "C", input = "AIN2" }}, {{ id = "D", input = "AIN3" }},
  {{ id = "E", input = "AIN4" }}]
"""


def free_port():
    with socket.socket() as s:
        s.bind(("127.0.0.1", 0))
        return s.getsockname()[1]


class Simulator:
    def __init__(self, folder):
        self.plan = os.path.join(folder, "devices.toml")
        self.ports = [0, 0]
        self.start()

    def start(self):
        with open(self.plan, "w") as f:
            f.write(PLAN.format(rig=os.path.join(DATA, "devices", "rig_volts_X.toml"), targets=TARGETS,
                                ports=self.ports))
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


class TcpClient(Client):
    def __init__(self, port):
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=30)
        self.file = self.socket.makefile("rwb")
        self.notes, self.id = [], 0


class Trouble(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        shutil.copy(os.path.join(DATA, "devices", "rig_volts_X.toml"), self.folder.name)
        self.simulator = Simulator(self.folder.name)
        self.tcp_port = free_port()
        self.daemon = Daemon(MDOFD, self.folder.name,
                             CONFIG.format(ports=self.simulator.ports, tcp_port=self.tcp_port))
        self.client = self.daemon.start()
        self.wait_for_samples()

    def tearDown(self):
        self.simulator.process.send_signal(signal.SIGCONT)
        self.daemon.stop()
        self.simulator.kill()
        self.folder.cleanup()

    def device(self):
        return self.client.call("device.list")["devices"][0]

    def wait_for_samples(self):
        before = self.device()["scans"]
        self.wait_until(lambda: self.device()["state"] == "open" and self.device()["scans"] > before + 300)

    def wait_until(self, condition, timeout_s=60):
        end = time.monotonic() + timeout_s
        while not condition():
            self.assertLess(time.monotonic(), end, self.device())
            time.sleep(0.02)

    def mdof(self, *words, elsewhere=True):
        # The default socket is not the socket of this mdofd.
        environment = {**os.environ, "XDG_RUNTIME_DIR": os.path.join(self.folder.name, "elsewhere")}
        environment.pop("RUNTIME_DIRECTORY", None)
        done = subprocess.run([MDOF, *map(str, words)], capture_output=True, text=True, env=environment, timeout=60)
        return done.returncode, done.stdout, done.stderr

    def run_meanwhile(self, work):
        run = self.client.call("run.start", axis="X")["run"]
        time.sleep(0.5)
        work()
        time.sleep(0.5)
        run = self.client.call("run.stop", run=run)["run"]
        return self.client.call("run.get", run=run)

    def test_doctor_and_probe_leave_a_run_alone(self):
        lost = self.device()["scans_lost"]

        def look():
            _, out, err = self.mdof("doctor", "--config", self.daemon.config)
            self.assertIn("mdofd is running", out + err)
            self.assertRegex(out, r"ok +device t7 \(labjack_t7\): open, \d+ scans, \d+ lost")
            for verb in ("probe", "monitor"):
                code, out, err = self.mdof("device", verb, "--config", self.daemon.config)
                self.assertEqual(code, 4, err)
                self.assertIn("mdofd runs", err)
                self.assertIn(self.daemon.socket, err)
                self.assertIn("mdof device list", err)

        self.check_undisturbed(self.run_meanwhile(look), lost)

    def test_without_the_socket_the_device_itself_is_locked(self):
        lost = self.device()["scans_lost"]

        def look():
            nowhere = os.path.join(self.folder.name, "nowhere")
            code, out, _ = self.mdof("doctor", "--config", self.daemon.config, "--socket", nowhere)
            self.assertEqual(code, 1)
            self.assertIn(f"in use by mdofd (process {self.daemon.process.pid})", " ".join(out.split()))
            code, _, err = self.mdof("device", "probe", "--config", self.daemon.config, "--socket", nowhere)
            self.assertEqual(code, 4)
            self.assertIn(f"in use by mdofd (process {self.daemon.process.pid})", err)

        self.check_undisturbed(self.run_meanwhile(look), lost)

    def check_undisturbed(self, header, lost):
        self.assertEqual(header["scans_lost"], 0, header)
        self.assertEqual(self.device()["scans_lost"], lost)
        self.assertEqual(self.device()["reopened"], 0)
        self.assertNotIn("t7", " ".join(n["text"] for n in header["notices"] if n["severity"] == "doubtful"))

    def test_the_first_value_of_a_silent_device_is_stale(self):
        self.simulator.process.send_signal(signal.SIGSTOP)
        time.sleep(1.5)  # no client reads in this time
        for count in (1, 2, 5):
            code, out, err = self.mdof("live", "--count", count, "--json", "--socket", self.daemon.socket)
            self.assertEqual(code, 0, err)
            self.check_stale(json.loads(out)["updates"], count)
        for transport in (lambda: Client(self.daemon.socket), lambda: TcpClient(self.tcp_port)):
            for count in (1, 2, 5):
                watcher = transport()
                watcher.call("live.subscribe", interval_ms=20, events=False)
                self.check_stale([watcher.next_note()["params"]["value"] for _ in range(count)], count)
                watcher.socket.close()
        self.simulator.process.send_signal(signal.SIGCONT)
        self.wait_for_samples()
        code, out, err = self.mdof("live", "--count", 1, "--json", "--socket", self.daemon.socket)
        self.assertFalse(json.loads(out)["updates"][0]["stale"])

    def check_stale(self, updates, count):
        self.assertEqual(len(updates), count)
        for update in updates:
            self.assertTrue(update["stale"], update)
            self.assertIsNone(update["errors"])
            self.assertTrue(all(p["quality"] == "stale" for p in update["probes"]), update)

    def test_a_restarted_encoder_is_told_at_once_and_by_its_cause(self):
        live = subprocess.Popen([MDOF, "live", "--ndjson", "--socket", self.daemon.socket], stdout=subprocess.PIPE,
                                text=True)
        record = subprocess.Popen([MDOF, "record", "--socket", self.daemon.socket, "--axis", "X", "--targets-mm",
                                   ",".join(map(str, TARGETS)), "--repeats", "100", "--json"],
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        lines = []

        # Messages have line breaks, because a terminal has 80 columns.
        def read_until(pattern):
            begin = len(lines)
            while not re.search(pattern, " ".join(" ".join(lines[begin:]).split())):
                line = record.stderr.readline()
                self.assertTrue(line, lines)
                self.assertLessEqual(len(line.rstrip()), 80)
                lines.append(line)

        read_until("point 3 of 800")
        self.simulator.kill()
        read_until('warning: .* axis X: device "t7": lost: ')
        self.simulator.start()
        read_until('device "t7": suspect: the encoder\'s datum is lost')
        read_until('device "t7": back: ')
        time.sleep(2)
        record.send_signal(signal.SIGINT)
        out, err = record.communicate(timeout=60)
        header = json.loads(out)
        text = " ".join(notice_lines(header))
        self.assertRegex(text, r'device "t7": the problem "lost" occurred \d+ times?, (?:first )?at \d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z: .*; the device sends samples again after a break of [\d.]+ s')
        self.assertRegex(text, r'device "t7": the problem "suspect" occurred 1 time, at \d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z: the encoder\'s datum is lost')
        self.assertRegex(text, r"\d+ points? ha(?:s|ve) no valid position .* first such point is [\d.]+ s after the first scan")
        self.assertNotIn("five probes", text)
        for points, of in re.findall(r"point (\d+) of (\d+)", "".join(lines) + err):
            self.assertLessEqual(int(points), int(of))
        for p in self.client.points(header["run"]):
            self.assertLess(min(abs(p["position_mm"] - t) for t in TARGETS), 0.01, p)
        self.check_replay(header)
        self.check_live(live)
        self.check_afterwards()

    # The recording contains no problems of devices, but a replay must not look better than the run.
    def check_replay(self, header):
        replayed = self.client.call("run.replay", path=header["recording"]["path"])
        text = " ".join(notice_lines(replayed))
        for kind in ("lost", "suspect"):
            self.assertEqual(len(re.findall(rf'run {header["run"]}: device "t7": the problem "{kind}" occurred', text)), 1, text)
        again = self.client.call("run.replay", path=header["recording"]["path"])
        self.assertEqual(len(notice_lines(again)), len(notice_lines(replayed)))

    def check_live(self, live):
        kinds = []
        while kinds[-1:] != ["back"]:
            value = json.loads(live.stdout.readline())
            kinds += [value["kind"]] if value.get("type") == "trouble" else []
        live.send_signal(signal.SIGINT)
        live.stdout.read()
        self.assertEqual(live.wait(20), 0)
        live.stdout.close()
        self.assertEqual(kinds, ["lost", "suspect", "back"])

    # An old error is not part of the state. A lost datum is part of the state, and mdofd reports it before the next
    # run.
    def check_afterwards(self):
        device = self.device()
        self.assertIsNone(device["error"])
        self.assertTrue(device["last_error"] and device["mended_utc"])
        self.assertEqual(len(device["trouble"]), 1)
        started = self.client.call("run.start", axis="X")
        self.assertIn("datum is lost", " ".join(notice_lines(started)))
        self.client.call("run.stop", run=started["run"], abort=True)
        with open(os.path.join(self.folder.name, "stderr")) as f:
            journal = f.read()
        for kind in ("lost", "suspect", "back"):
            self.assertEqual(len(re.findall(f'axis X: device "t7": {kind}: ', journal)), 1, journal)

    # Checks live, device list and status, in a pipe and on terminals with 80 and more columns.
    def test_no_line_is_wider_than_the_terminal(self):
        self.client.call("run.stop", run=self.client.call("run.start", axis="X", note="a note " * 30)["run"])
        for words in (("live", "--count", "3"), ("device", "list"), ("status",)):
            words = (*words, "--socket", self.daemon.socket)
            for columns in (80, 100, 160):
                self.check_width(self.on_terminal(columns, *words), columns, words)
            code, out, err = self.mdof(*words)
            self.assertEqual(code, 0, err)
            self.check_width(out, 80, words)
        self.simulator.process.send_signal(signal.SIGSTOP)  # the stopped simulator causes long messages
        self.wait_until(lambda: self.device()["state"] != "open")
        for words in (("live", "--count", "1"), ("device", "list"), ("status",)):
            words = (*words, "--socket", self.daemon.socket)
            out = self.on_terminal(80, *words)
            self.check_width(out, 80, words)
            self.assertIn("lost: ", out)

    def check_width(self, out, columns, words):
        self.assertTrue(out.strip(), words)
        for line in out.splitlines():
            if os.path.join(self.folder.name, "mdof.db") not in line:  # a path is not broken into lines
                self.assertLessEqual(len(line), columns, (words, line))

    # The text on the terminal, without movements of the cursor.
    def on_terminal(self, columns, *words):
        ours, its = pty.openpty()
        fcntl.ioctl(its, termios.TIOCSWINSZ, struct.pack("HHHH", 50, columns, 0, 0))
        environment = {key: value for key, value in os.environ.items() if key != "COLUMNS"}
        process = subprocess.Popen([MDOF, *words], stdout=its, stderr=subprocess.PIPE, env=environment)
        os.close(its)
        drawn = b""
        while True:
            try:
                drawn += os.read(ours, 65536)
            except OSError:  # the other side of the terminal has closed
                break
        os.close(ours)
        self.assertEqual(process.wait(60), 0, process.stderr.read())
        process.stderr.close()
        return re.sub(r"\x1b\[[0-9]*[A-Z]", "", drawn.decode()).replace("\r", "")

    def test_live_of_an_axis_that_there_is_not(self):
        begin = time.monotonic()
        code, _, err = self.mdof("live", "--axis", "Y", "--socket", self.daemon.socket)
        self.assertEqual(code, 3)
        self.assertIn("does not measure axis Y; it measures X", err)
        self.assertLess(time.monotonic() - begin, 5)

    def test_live_shows_an_axis_whose_rig_is_not_available(self):
        """A server that sends readings of X and Y, but has an error instead of the rig of Y."""
        path = os.path.join(self.folder.name, "half.sock")
        with socket.socket(socket.AF_UNIX) as listener:
            listener.bind(path)
            listener.listen()
            live = subprocess.Popen([MDOF, "live", "--ndjson", "--count", "2", "--socket", path], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            with listener.accept()[0] as client, client.makefile("rw") as lines:
                answers = {"server.info": {"axes": [{"axis": "X"}, {"axis": "Y"}]}, "live.subscribe": {}}
                asked = 0
                while asked < 2:
                    request = json.loads(lines.readline())
                    is_rig = request["method"] == "rig.get"
                    asked += is_rig
                    of_y = is_rig and request["params"]["axis"] == "Y"
                    answer = {"error": {"code": 1, "message": "no rig today"}} if of_y else {"result": answers.get(request["method"], {"probes": []})}
                    lines.write(json.dumps({"jsonrpc": "2.0", "id": request["id"], **answer}) + "\n")
                    lines.flush()
                for axis in "XY":
                    lines.write(json.dumps({"jsonrpc": "2.0", "method": "live.update", "params": {"value": {"axis": axis, "probes": []}}}) + "\n")
                lines.flush()
                out, err = live.communicate(timeout=60)
        self.assertEqual((live.returncode, [json.loads(line)["axis"] for line in out.splitlines()]), (0, ["X", "Y"]), err)
        self.assertIn("axis Y is shown without the ranges of its probes: no rig today", err)

    def test_ndjson_is_an_object_a_line(self):
        code, out, err = self.mdof("live", "--ndjson", "--count", 3, "--socket", self.daemon.socket)
        self.assertEqual(code, 0, err)
        updates = [json.loads(line) for line in out.splitlines()]
        self.assertEqual([u["axis"] for u in updates], ["X"] * 3)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[4:], verbosity=2)
