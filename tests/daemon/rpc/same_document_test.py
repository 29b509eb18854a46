#!/usr/bin/python3
"""`mdof COMMAND --json` and the reply of the RPC method are the same document. The test calls each method that has
a command and compares all members. If the test does not know a method, it fails.

usage: same_document_test.py MDOFD MDOF"""
import json
import os
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from mdofd import DATA, RIG, Daemon, recorded_again, simulator  # noqa: E402
from result_schemas import methods  # noqa: E402

MDOFD, MDOF = sys.argv[1:3]
PAGED = "a reply has at most 48 KiB: points come in pages, by a method of their own"
NEXT = "the second of two alike"
VOLUME = 1
MACHINE = 'name = "m"\nmachine = {chain = "w-Y-X-b-t"}\n' + "".join(
    f'[[axis]]\nid = "{axis}"\nholds_at_mm = [0, 0, 0]\npoint = "standing"\nrange_mm = [0, 20]\nE{axis}{axis}_um = 2\n' for axis in "XY")
# Elements: method, its parameters, the command, and members that may differ, with the reason. Runs 1 and 3 measure X,
# run 2 measures Y, run 4 is imported.
SAME = [
    ("run.get", {"run": 1}, "show 1", {"points": PAGED}),
    ("run.get", {"run": 4}, "show 4", {"points": PAGED}),
    ("run.list", {}, "runs", {}),
    ("run.list", {"all": True}, "runs --all", {}),
    ("run.list", {"axis": "Y", "offset": 0, "count": 1}, "runs --axis Y --count 1", {}),
    ("run.analyse", {"run": 1}, "show 1 --figures", {}),
    ("run.analyse", {"run": 2, "reference": "carriage"}, "show 2 --figures --reference carriage", {}),
    ("run.budget", {"run": 1, "figure": "EYX_slope_urad"}, "budget 1 --figure EYX_slope_urad", {}),
    ("run.compare", {"before": 1, "after": 3}, "compare 1 3", {}),
    ("run.trend", {"figure": "EYX_slope_urad"}, "trend --figure EYX_slope_urad", {}),
    ("run.trend", {"figure": "EYX_slope_urad", "without": [3]}, "trend --figure EYX_slope_urad --without 3", {}),
    ("parallelism.fit", {"run_a": 1, "run_b": 3}, "parallelism 1 3", {}),
    ("squareness.fit", {"run_x": 1, "run_y": 2}, "squareness 1 2", {}),
    ("squareness.budget", {"run_x": 1, "run_y": 2}, "budget 1 2", {}),
    ("compensation.build", {"runs": [1]}, "compensation build 1", {"table": NEXT, "created_utc": NEXT}),
    ("compensation.table", {"table": 2}, "compensation show 2", {}),
    ("compensation.table", {"table": VOLUME}, f"compensation show {VOLUME}", {}),
    ("compensation.list", {}, "compensation list", {}),
    ("compensation.list", {"axis": "X"}, "compensation list --axis X", {}),
    ("compensation.activate", {"table": 2}, "compensation activate 2", {"changed": NEXT}),
    ("compensation.table", {"table": 2}, "compensation show 2", {}),
    ("compensation.deactivate", {"axis": "X"}, "compensation deactivate --axis X", {"changed": NEXT}),
    ("history.list", {"count": 5}, "history --count 5", {}),
    ("device.list", {}, "device list", {"scans": "they go on", "measured_hz": "it goes on", "clock": "it goes on"}),
    ("server.info", {}, "status server", {"uptime_s": "it goes on"}),
    ("compensation.status", {}, "status compensation", {}),
]
# No command gives the same document as these methods.
OTHERS = {
    "compensation.at": "a question of the machine's control", "compensation.grid": "as compensation.table",
    "compensation.build_volume": "tests/daemon/rpc/beside_daemon_test.py", "encoder.set": "tests/daemon/encoder_datum_test.py",
    "live.subscribe": "a stream", "live.unsubscribe": "a stream", "machine.at": "mdof machine error is of files",
    "rig.get": "what the page draws", "rpc.discover": "the methods", "run.import": "test_a_file_gives_the_same_document_to_both",
    "run.points": "pages of mdof show", "run.replay": "test_a_file_gives_the_same_document_to_both", "run.resume": "begins",
    "run.start": "begins; mdof record shows the run at its end", "run.stop": "ends", "server.health": "what the page shows",
}


def differences(command, reply, path=""):
    if isinstance(command, dict) and isinstance(reply, dict):
        found = []
        for key in sorted(command.keys() | reply.keys()):
            at = f"{path}/{key}"
            if key in command and key in reply:
                found += differences(command[key], reply[key], at)
            else:
                found.append((key, at, "only of the " + ("command" if key in command else "reply")))
        return found
    if isinstance(command, list) and isinstance(reply, list) and len(command) == len(reply):
        return [d for i, (a, b) in enumerate(zip(command, reply)) for d in differences(a, b, f"{path}/{i}")]
    if command == reply and isinstance(command, bool) == isinstance(reply, bool):
        return []
    return [(path.split("/")[-1], path, f"{command!r} of the command, {reply!r} of the reply")]


class SameDocument(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = temporary.name
        cls.daemon = Daemon(MDOFD, cls.folder, simulator("X"))
        logs = {axis: os.path.join(DATA, "five-probe", f"log_{axis}.csv.gz") for axis in "XY"}
        for axis, log in (("X", logs["X"]), ("Y", logs["Y"]), ("X", recorded_again(logs["X"], cls.folder))):
            cls.said("replay", log, "--rig", RIG[axis], "--db", cls.daemon.database)
        readings = os.path.join(cls.folder, "laser.csv")
        with open(readings, "w") as file:
            file.write("target_mm,direction,run,deviation_um\n" + "".join(f"{x},{d},{k},{.1 * x * d + k}\n" for k in (1, 2) for d in (1, -1) for x in (0, 9)))
        cls.readings, cls.log = readings, logs["X"]
        cls.said("import", readings, "--axis", "X", "--u-um", "0.2", "--db", cls.daemon.database)
        with open(os.path.join(cls.folder, "machine.toml"), "w") as file:
            file.write(MACHINE)
        cls.said("compensation", "build", "--machine", file.name, "--plane", "XY", "--step-mm", "5", "--incomplete", "--db", cls.daemon.database)
        cls.client = cls.daemon.start()
        cls.addClassCleanup(cls.daemon.stop)
        cls.addClassCleanup(cls.client.socket.close)

    @classmethod
    def said(cls, *words):
        done = subprocess.run([MDOF, *words], capture_output=True, text=True, timeout=60)
        assert done.returncode == 0, (words, done.stderr)
        return done.stdout

    @classmethod
    def document(cls, command):
        words = command.split()
        if words[0] == "status":
            return json.loads(cls.said("status", "--socket", cls.daemon.socket, "--json"))[words[1]]
        options = cls.said(*[w for w in words if w.isalpha()][:2 if words[0] in ("compensation", "device") else 1], "--help")
        for option, value in (("--db", cls.daemon.database), ("--socket", cls.daemon.socket)):
            words += [option, value] if option in options else []
        return json.loads(cls.said(*words, "--json"))

    def test_all_members_are_the_same(self):
        for method, params, command, allowed in SAME:
            with self.subTest(command):
                reply, document = self.client.call(method, **params), self.document(command)
                found = differences(document, reply)
                self.assertEqual([d for d in found if d[0] not in allowed], [], method)

    def test_a_file_gives_the_same_document_to_both(self):
        for method, path, params, options, allowed in (
                ("run.import", self.readings, {"axis": "X", "u_um": 0.2}, ("--axis", "X", "--u-um", "0.2"), {"run"}),
                ("run.replay", self.log, {"rig": open(RIG["X"]).read(), "rig_source": RIG["X"]}, ("--rig", RIG["X"]), {"run", "points", "started_utc"})):
            with self.subTest(method):
                reply = self.client.call(method, path=path, **params)
                command = self.said(method.split(".")[1], path, *options, "--db", self.daemon.database, "--socket", self.daemon.socket, "--json")
                found = differences(json.loads(command), reply)
                self.assertEqual([d for d in found if d[0] not in allowed], [])
                self.assertIn("notices", reply)

    # Control: the comparison must detect a missing member and a changed value.
    def test_a_member_less_or_another_value_is_seen(self):
        self.assertEqual(differences({"a": [1, {"b": None}]}, {"a": [1, {"b": None}]}), [])
        for other in ({}, {"a": [1]}, {"a": [1, {"b": 0}]}, {"a": [True, {"b": None}]}, {"a": [1, {}]}, {"a": [1, {"b": None}], "c": 0}):
            self.assertEqual(len(differences({"a": [1, {"b": None}]}, other)), 1, other)

    def test_every_method_is_known_here(self):
        self.assertEqual({m["name"] for m in methods(self.client)}, {method for method, *_ in SAME} | OTHERS.keys())

    def test_the_sense_stays_with_a_long_text(self):
        text = os.path.join(self.folder, "long.rtl")  # the document of this run is too long for one reply
        with open(text, "w", encoding="latin-1") as file:
            file.write("HEADER::\nFile type  : rtl\n\nTARGET DATA::\nFiletype : ISO\nTarget-count: 2\nTargets :\n0.0000 10.0000\n\nUSER-TEXT::\n" +
                       "".join(f"Remark {i}: {'x' * 40}\n" for i in range(3000)) +
                       "RUNS::\nRun-count: 2\n\nDEVIATIONS::\nRun Target Data:\n1 1 0.5\n1 2 0.7\n2 2 -0.3\n2 1 -0.5\nEOF::\n")
        imported = self.said("import", text, "--axis", "X", "--sense", "body", "--travel=-", "--db", self.daemon.database,
                             "--socket", self.daemon.socket, "--json")
        run = self.client.call("run.get", run=json.loads(imported)["run"])
        self.assertEqual((run["positioning_sense"], run["travel"], run["points_total"]), ("body", "-", 4))
        self.assertEqual(run["uncertainty"]["EXX_B_um"]["value"], 1)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
