#!/usr/bin/python3
"""mdof beside a running mdofd: it stops runs, it replays into the database of mdofd, and its replies are the same
with and without mdofd.

usage: command_line_test.py MDOFD MDOF"""
import contextlib
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from mdofd import DATA, RIG, Daemon, RpcError, simulator  # noqa: E402

MDOFD, MDOF = sys.argv[1:3]
LOG = {axis: os.path.join(DATA, "five-probe", f"log_{axis}.csv.gz") for axis in "XY"}


def mdof(*words, stdin=None):
    done = subprocess.run([MDOF, *map(str, words)], capture_output=True, text=True, stdin=stdin, timeout=300)
    return done.returncode, done.stdout, done.stderr


class CommandLine(unittest.TestCase):
    DWELL_S = 0.2

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.daemon = Daemon(MDOFD, os.path.join(self.folder.name, "d"),
                             simulator("X", targets_mm=(0, 2, 4.1, 6.2), dwell_s=self.DWELL_S))
        self.client = self.daemon.start()
        self.at = ("--db", self.daemon.database, "--socket", self.daemon.socket)

    def tearDown(self):
        self.daemon.stop()
        self.folder.cleanup()

    def done(self, *words):
        code, out, err = mdof(*words)
        self.assertEqual(code, 0, err)
        return out


class Stop(CommandLine):
    DWELL_S = 0.4  # long enough for a stop

    def test_ends_the_run_under_way(self):
        started = self.client.call("run.start", axis="X")["run"]
        time.sleep(2.5)
        stopped = json.loads(self.done("stop", "--socket", self.daemon.socket, "--json"))["stopped"]
        self.assertEqual([s["axis"] for s in stopped], ["X"])
        self.assertIn(started, (stopped[0]["run"], self.client.call("run.get", run=stopped[0]["run"])["supersedes"]))
        self.assertNotEqual(self.client.call("run.get", run=stopped[0]["run"])["state"], "open")

    def test_the_remedy_names_the_database_of_the_run(self):
        self.client.call("run.start", axis="X")
        time.sleep(2.5)
        told = self.done("stop", "--socket", self.daemon.socket)
        words = re.search(r"show the run with: mdof (show \d+ --db .+)\n", told)[1].split(" ")
        self.assertIn("axis X", self.done(*words))
        self.assertEqual([line for line in told.splitlines() if len(line) > 80 and " /" not in line], [])

    def test_the_remedy_names_no_database_that_is_the_default(self):
        self.client.call("run.start", axis="X")
        time.sleep(2.5)
        environment = {**os.environ, "STATE_DIRECTORY": os.path.dirname(self.daemon.database)}
        told = subprocess.run([MDOF, "stop", "--socket", self.daemon.socket], capture_output=True, text=True, env=environment).stdout
        self.assertRegex(told, r"show the run with: mdof show \d+\n")

    def test_a_run_that_failed_is_an_error_with_its_reason(self):
        for words in (("--json",), ()):
            run = self.client.call("run.start", axis="X", targets_mm=[1000, 2000])["run"]
            time.sleep(2.5)
            code, out, err = mdof("stop", "--socket", self.daemon.socket, *words)
            self.assertEqual(code, 1, out + err)
            self.assertRegex(err, rf"run {run} of axis X failed: none of the \d+ stops\s+is near a given target; check\s+targets_mm")
            if words:
                stopped, = json.loads(out)["stopped"]
                self.assertEqual((stopped["run"], stopped["axis"], stopped["state"]), (run, "X", "failed"))
                self.assertIn("failure", [n["code"] for n in stopped["notices"]])
            else:
                self.assertNotIn("has ended", out)

    def test_without_a_run_it_is_an_error(self):
        for words, message in (((), "no run is in progress;"), (("--axis", "X"), "no run of axis X is in progress"),
                               (("--axis", "Z"), "mdofd does not measure axis Z")):
            code, _, err = mdof("stop", *words, "--socket", self.daemon.socket)
            self.assertEqual(code, 3)
            self.assertIn(message, err)


class FreeText(CommandLine):
    def test_control_characters_reach_no_terminal(self):
        config = os.path.join(self.folder.name, "hostile.toml")
        with open(config, "w") as f:
            f.write('[[axis]]\nrig = "none\\u001b[2J.toml"\n')
        done = subprocess.run([MDOFD, "--check-config", "--config", config], capture_output=True, text=True)
        self.assertEqual(done.returncode, 3)
        self.assertIn("none?[2J.toml", done.stderr)
        self.client.call("run.start", axis="X", note="\x1b]0;owned\x07")
        code, out, err = mdof("status", *self.at[2:])
        self.assertEqual(code, 0, err)
        self.assertIn("?]0;owned?", out)
        self.assertNotIn("\x1b", out + err + done.stderr)


class Record(CommandLine):
    def test_ends_with_what_show_prints_and_fits_the_terminal(self):
        # A run is shown whether or not it is complete.
        _, out, _ = mdof("record", "--axis", "X", "--for-s", 6, "--socket", self.daemon.socket)
        run = self.client.call("run.list")["runs"][0]["run"]
        self.assertEqual(re.search(r"^run (\d+), axis X", out, re.MULTILINE)[1], str(run))
        self.assertEqual(out, self.done("show", run, "--db", self.daemon.database))
        self.assertIn("EYX/µm", out)
        self.assertEqual([line for line in out.splitlines() if len(line) > 80 and " /" not in line], [])


    def test_names_the_run_that_has_the_result(self):
        # If a run begins in reverse, it numbers its targets again when it reaches targets at smaller positions.
        other = Daemon(MDOFD, os.path.join(self.folder.name, "back"), simulator("X", dwell_s=0.4))
        client = other.start()
        self.addCleanup(other.stop)
        for attempt in range(12):
            time.sleep(0.3 * attempt)  # starts in another part of the cycle
            _, _, err = mdof("record", "--axis", "X", "--for-s", 3.5, "--socket", other.socket)
            newest = client.call("run.list", count=1)["runs"][0]
            if newest["supersedes"]:
                break
        before = newest["supersedes"]
        self.assertIsNotNone(before, err)
        self.assertIn(f"run {newest['run']} contains the result", err)
        self.assertIn(f"contains the result and replaces run {before}", err)
        # Several runs may come from one measurement. Only one of them is listed.
        started = [r["started_utc"] for r in json.loads(self.done("runs", "--db", other.database, "--json"))["runs"]]
        self.assertEqual((len(set(started)), started[0]), (len(started), newest["started_utc"]))
        self.assertNotRegex(self.done("runs", "--db", other.database), rf"(?m)^ *{before} ")
        self.assertNotIn(before, [r["run"] for r in client.call("run.list")["runs"]])
        everything = {r["run"]: r["superseded_by"] for r in client.call("run.list", all=True)["runs"]}
        self.assertEqual((everything[before], everything[newest["run"]]), (newest["run"], None))
        self.assertRegex(self.done("runs", "--all", "--db", other.database),
                         rf"(?m)^ *{before} +X +superseded by {newest['run']} ")
        for words in (("show",), ("show", "--csv"), ("show", "--json"), ("show", "--figures"),
                      ("show", "--json", "--figures"), ("show", "--csv", "--figures")):
            _, _, err = mdof(words[0], before, *words[1:], "--db", other.database)
            self.assertIn(f"run {newest['run']} supersedes run {before}", err)
        for run, by in ((before, newest["run"]), (newest["run"], None)):
            self.assertEqual(json.loads(self.done("show", run, "--figures", "--json", "--db", other.database))["superseded_by"], by)


class Replay(CommandLine):
    def test_goes_through_the_daemon_and_says_the_same(self):
        words = ("replay", LOG["X"], "--rig", RIG["X"], "--model", "exact",
                 "--note", "x", "--settle-s", "0.15", "--tolerance-um", "1.5", "--json")
        alone = json.loads(self.done(*words, "--db", os.path.join(self.folder.name, "other.db")))
        through = json.loads(self.done(*words, *self.at))
        self.assertEqual(through["run"], self.client.call("run.list")["runs"][0]["run"])
        for document in (alone, through):
            document.pop("started_utc")
            document.pop("run")
        self.assertEqual(through, alone)
        self.assertEqual(through["note"], "x")
        self.assertIn('"settle_s":0.15', json.dumps(through["options"]).replace(" ", ""))

    def test_an_error_of_the_daemon_is_told(self):
        missing = os.path.join(self.folder.name, "none.csv")
        code, _, err = mdof("replay", missing, "--rig", RIG["X"], *self.at)
        self.assertEqual(code, 3)
        self.assertIn("none.csv: No such file", err)
        code, _, err = mdof("replay", LOG["Y"], "--rig", RIG["X"], *self.at)
        self.assertEqual(code, 3)
        self.assertIn("the log is for axis Y", err)
        self.assertEqual(self.client.call("run.list")["total"], 0)

    def test_the_standard_input_cannot_be_handed_over(self):
        code, _, err = mdof("replay", "-", "--rig", RIG["X"], *self.at, stdin=subprocess.DEVNULL)
        self.assertEqual(code, 3)
        self.assertIn("standard input", err)

    def test_only_what_the_caller_may_read_and_a_file(self):
        for path, words in (("log.csv", "must be absolute"), ("/dev/zero", "not a regular file"),
                            (self.folder.name, "not a regular file")):
            with self.subTest(path=path), self.assertRaisesRegex(RpcError, words):
                self.client.call("run.replay", path=path)
        with self.assertRaisesRegex(RpcError, "settle_s.* must be from 0"):
            self.client.call("run.replay", path=LOG["X"], rig=open(RIG["X"]).read(), settle_s=-1)

    def wait_until_read(self):
        """Waits until mdofd has started the thread that reads a CSV log. The replay itself may take only 0.2 s."""
        tasks = f"/proc/{self.daemon.process.pid}/task"
        for _ in range(10_000):
            for task in os.listdir(tasks):
                with contextlib.suppress(FileNotFoundError, ProcessLookupError), open(f"{tasks}/{task}/comm") as name:
                    if name.read().strip() == "csv read":
                        return
            time.sleep(0.001)
        self.fail("the daemon reads no log")

    def test_a_daemon_that_stops_gives_the_log_up(self):
        log = os.path.join(self.folder.name, "long.csv")
        with open(log, "w") as file:
            file.write("time_s,encoder_mm,A_um,B_um,C_um,D_um,E_um\n")
            for i in range(1_500_000):
                file.write(f"{i * 0.001:.3f},{i // 1000}.{i % 7},1,2,3,4,{i % 5}\n")
        asked = subprocess.Popen([MDOF, "replay", log, "--rig", RIG["X"], *self.at], stderr=subprocess.PIPE)
        self.wait_until_read()
        begin = time.monotonic()
        self.daemon.stop()
        self.assertLess(time.monotonic() - begin, 5)
        asked.communicate()
        self.assertNotEqual(asked.returncode, 0)
        self.daemon.start()


class Holder(CommandLine):
    """A command either acts on the named database or does nothing."""

    def setUp(self):
        super().setUp()
        self.other = Daemon(MDOFD, os.path.join(self.folder.name, "e"), simulator("Y", targets_mm=(0, 2)))
        self.client_of_other = self.other.start()

    def tearDown(self):
        self.other.stop()
        super().tearDown()

    def test_the_daemon_of_another_database_is_asked_for_nothing(self):
        crossed = ("--db", self.daemon.database, "--socket", self.other.socket)
        code, _, err = mdof("replay", LOG["X"], "--rig", RIG["X"], *crossed)
        self.assertEqual(code, 4)
        self.assertIn(f"{self.daemon.database}: mdofd (process {self.daemon.process.pid}) is writing to this database", err)
        self.assertIn(f"uses the database {self.other.database}", err)
        for client in (self.client, self.client_of_other):
            self.assertEqual(client.call("run.list")["total"], 0)

    def test_no_daemon_at_the_socket(self):
        code, _, err = mdof("replay", LOG["X"], "--rig", RIG["X"], "--db", self.daemon.database,
                            "--socket", os.path.join(self.folder.name, "none"))
        self.assertEqual(code, 4)
        self.assertIn("no mdofd answers at", err)
        self.assertIn(f"process {self.daemon.process.pid}", err)

    def test_a_name_for_the_same_file_is_the_same_database(self):
        link = os.path.join(self.folder.name, "link")
        os.symlink(os.path.dirname(self.daemon.database), link)
        out = self.done("replay", LOG["X"], "--rig", RIG["X"], "--db", os.path.join(link, "mdof.db"),
                        "--socket", self.daemon.socket, "--json")
        self.assertEqual(self.client.call("run.get", run=json.loads(out)["run"])["axis"], "X")


class TheSame(unittest.TestCase):
    """The output of mdof does not depend on whether a daemon holds the database."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        alone = os.path.join(self.folder.name, "alone.db")
        for axis in "XY":
            code, _, err = mdof("replay", LOG[axis], "--rig", RIG[axis], "--db", alone)
            self.assertEqual(code, 0, err)
        self.daemon = Daemon(MDOFD, os.path.join(self.folder.name, "d"), simulator("X"))
        shutil.copy(alone, self.daemon.database)
        self.client = self.daemon.start()
        self.generations = {"alone": [], "daemon": []}
        self.at = {"alone": ("--db", alone), "daemon": ("--db", self.daemon.database, "--socket", self.daemon.socket)}

    def tearDown(self):
        self.daemon.stop()
        self.folder.cleanup()

    def counted(self, name, text):
        """Replaces each generation by 1, 2, ... in the order of their first occurrence. A generation is a time in
        seconds since 1970, so it differs from run to run."""
        seen = self.generations[name]

        def count(match):
            if match[0] not in seen:
                seen.append(match[0])
            return str(seen.index(match[0]) + 1)
        # The digits after a decimal point are not a generation.
        return re.sub(r"(?<![\d.])\d{10}(?![\d.])", count, text)

    def generation(self, reply):
        return int(self.counted("daemon", str(reply["generation"])))

    def both(self, *words, code=0):
        said = {}
        for name, at in self.at.items():
            reads = words[:2] in (("compensation", "show"), ("compensation", "list"))
            got, out, err = mdof(*words, *(at[:2] if reads else at))
            self.assertEqual(got, code, err)
            out = self.counted(name, re.sub(r"\d{4}-\d\d-\d\dT[\d:.]+Z", "TIME", out))
            said[name] = out, re.sub(r" --socket \S+", "", err.replace(at[1], "DB"))
        self.assertEqual(said["alone"], said["daemon"])
        return said["alone"][0]

    def test_text_and_json_with_and_without_it(self):
        for form in ((), ("--json",)):
            self.both("squareness", 1, 2, *form)
            self.both("squareness", "latest", "latest", "--artefact-urad", -1.3, "--u-artefact-urad", 0.5, *form)
            self.both("compensation", "build", 1, *form)
            self.both("compensation", "build", "latest", "--axis", "X", "--keep-slope", *form)
        first = self.both("compensation", "activate", 1)
        self.assertEqual(first, "table 1 is active, generation 1\n")
        self.assertEqual(self.both("compensation", "activate", 1), "table 1 is already active, generation 1\n")
        self.assertEqual(json.loads(self.both("compensation", "activate", 2, "--json")),
                         {"table": 2, "generation": 2, "changed": True, "simulated": False, "doubtful": False})
        for form in ((), ("--json",), ("--csv",)):
            self.both("compensation", "show", *form)
        self.both("compensation", "list")
        self.both("compensation", "activate", 99, code=3)
        self.both("squareness", 1, 99, code=3)

    def test_a_table_out_of_force(self):
        self.both("compensation", "build", 1)
        self.both("compensation", "activate", 1)
        at = dict(axis="X", position_mm=10)
        self.assertEqual(self.generation(self.client.call("compensation.at", **at)), 1)
        self.assertEqual(self.both("compensation", "deactivate", "--axis", "X"),
                         "the table of axis X is no longer active, generation 2\n")
        self.assertEqual(self.both("compensation", "deactivate", "--axis", "X"),
                         "no table of axis X was active, generation 2\n")
        with self.assertRaisesRegex(RpcError, "no compensation table is active for axis X"):
            self.client.call("compensation.at", **at)
        status = self.client.call("compensation.status")
        self.assertEqual((self.generation(status), status["axes"]), (2, {}))
        self.assertEqual(self.generation(self.client.call("server.info")), 2)
        self.daemon.stop()
        self.client = self.daemon.start()
        self.assertEqual(self.client.call("compensation.status"), status)
        self.assertEqual(self.both("compensation", "activate", 1), "table 1 is active, generation 3\n")
        self.assertEqual(self.generation(self.client.call("compensation.at", **at)), 3)


if __name__ == "__main__":
    del sys.argv[1:3]
    unittest.main(warnings="ignore")
