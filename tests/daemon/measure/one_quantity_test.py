#!/usr/bin/python3
"""Each quantity has the same name, value, u and U in every output: text, JSON, CSV and RPC. The test uses two runs
along X and one run along Y, whose rigs declare uncertainties. It calls every command and method that states an
uncertainty, and compares the values of each quantity. If the test does not know a command or method, it fails.

usage: one_quantity_test.py MDOFD MDOF"""
import copy
import csv
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from mdofd import DATA, RIG, Client, Daemon, recorded_again, simulator  # noqa: E402
from result_schemas import methods  # noqa: E402

MDOFD, MDOF = sys.argv[1:3]
ROOT = os.path.abspath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", ".."))
OF_PROBES = "u_calibration_um = 0.02\nu_sensitivity_ppm = 500\nu_position_mm = 0.05\nu_direction_mrad = 2\n"
OF_RIG = "\n[installation]\nu_angle_mrad = 2\n[drift]\nu_um_per_h = 0.1\n"
NOT_DECLARED = ["u_flatness_um", "[encoder] u_um", "u_offset_mm"]
EXACT = 1e-12  # relative difference

# The uncertainties of these commands and methods are compared here. They belong to a run, to two runs, or to a table
# ...
COMPARED = {"budget", "compare", "compensation build", "compensation show", "parallelism", "replay", "show",
            "squareness", "trend"}
COMPARED_METHODS = {"compensation.at", "compensation.build", "compensation.grid", "compensation.status", "compensation.table",
                    "parallelism.fit", "run.budget", "run.compare", "run.get", "run.points", "run.trend", "squareness.budget", "squareness.fit"}
# ... and these commands and methods state no uncertainty, or state uncertainties of files, studies, calibrations or
# descriptions of machines.
OTHERS = {"clearance", "completion", "demo", "help", "machine kinematics", "machine budget", "milling",
          "form scan", "form compare", "form clamp", "form cut", "form path", "part", "plot", "report",
          "calibrate certificate", "calibrate mounting", "calibrate sensitivity", "compensation activate", "compensation check",
          "compensation deactivate", "compensation export", "compensation linuxcnc", "compensation list", "device list", "device monitor",
          "device probe", "doctor", "drift", "encoder set", "export", "history", "import", "iso230-2", "live",
          "machine circle", "machine diagonal", "machine error", "machine map", "machine perpendicularity", "machine study", "record", "runs",
          "selftest", "sensitivity", "separate reversal", "separate shift", "separate square", "setup network",
          "solve", "status", "stop", "straightness", "studies", "token", "verify"}
OTHER_METHODS = {"compensation.activate", "compensation.build_volume", "compensation.deactivate", "compensation.list", "device.list", "encoder.set", "history.list",
                 "live.subscribe", "live.unsubscribe", "machine.at", "rig.get", "rpc.discover", "run.analyse", "run.import", "run.list", "run.replay", "run.resume",
                 "run.start", "run.stop", "server.health", "server.info"}


def mdof(*words):
    done = subprocess.run([MDOF, *map(str, words)], capture_output=True, text=True,
                          env={**os.environ, "COLUMNS": "400"})
    assert done.returncode == 0, (words, done.stderr)
    return done.stdout


def half_digit(text):
    """Half of the last digit of a number in a text, as its uncertainty of rounding. A number with two significant
    digits may end in zeros, for example "1200"."""
    whole = text.lstrip("-")
    step = 10.0 ** -len(whole.split(".")[1]) if "." in whole else 10.0 ** max(0, len(whole) - 2)
    return 0.6 * step


class Notes:
    """The values of each quantity that the outputs state: (name, place, {"value", "u", "U"}, half a digit of each
    value, or None)."""

    def __init__(self):
        self.said = []

    def add(self, name, where, shown=False, **numbers):
        there = {k: v for k, v in numbers.items() if v not in (None, "")}
        digits = {k: half_digit(v) for k, v in there.items()} if shown else None
        self.said.append((name, where, {k: float(v) for k, v in there.items()}, digits))

    def contradictions(self):
        found, first = [], {}
        for name, where, numbers, shown in self.said:
            for key, number in numbers.items():
                there, other = first.setdefault((name, key), (where, number))
                tolerance = shown[key] if shown else EXACT * abs(other)
                if not abs(number - other) <= tolerance:
                    found.append(f"{key} of {name}: {other} in {there}, {number} in {where}")
        return found

    def places(self, name):
        return {where for said, where, _, _ in self.said if said == name}


def figures(notes, where, block):
    for name, f in block.items():
        notes.add(name, where, **{key: f[key] for key in ("value", "u", "U")})


def straightness(notes, where, block):
    for key, by_approach in block.items():
        mean = by_approach["mean"]
        notes.add(f"{key[:3]}_slope_urad", where, value=mean["slope_least_squares_urad"],
                  u=mean["u_slope_least_squares_urad"])
        notes.add(f"{key[:3]}_form_urad", where, value=mean["form_urad"])
        notes.add(f"{key[:3]}_straightness_um", where, value=mean["least_squares_um"])


def points(notes, where, of):
    for i, p in enumerate(of):
        for key in p["u"]:
            notes.add(f"point {i} {key}", where, value=p[key], u=p["u"][key], U=p["U"][key])


def rows(text):
    return list(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))


def table(notes, where, of):
    for p in of:
        for side in ("forward", "reverse"):
            for key, u in p[side]["u"].items():
                notes.add(f"table {side} {p['position_mm']:.6f} {key}", where, value=p[side][key], u=u)


class OneQuantity(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.daemon = Daemon(MDOFD, cls.folder.name, simulator("X"))
        cls.db = ("--db", cls.daemon.database)
        rigs = {}
        for axis in "XY":
            rigs[axis] = os.path.join(cls.folder.name, f"{axis}.toml")
            with open(RIG[axis]) as plain, open(rigs[axis], "w") as declared:
                declared.write("u_artefact_angle_urad = 0.4\n" + plain.read().replace("range_um", OF_PROBES + "range_um") + OF_RIG)
        logs = {axis: os.path.join(DATA, "five-probe", f"log_{axis}.csv.gz") for axis in "XY"}
        again = recorded_again(logs["X"], cls.folder.name)
        cls.replayed = [mdof("replay", log, "--rig", rigs["X"], *cls.db, *words)
                        for log, words in ((logs["X"], ("--json",)), (again, ("--all",)))]
        mdof("replay", logs["Y"], "--rig", rigs["Y"], *cls.db)
        cls.documents, cls.csvs, cls.texts, cls.replies = {}, {}, {}, {}
        cls.run_commands()
        client = cls.daemon.start()
        cls.discovered = {m["name"] for m in methods(client)}
        cls.call_methods(client)
        cls.notes = cls.collected()

    @classmethod
    def tearDownClass(cls):
        cls.daemon.stop()
        cls.folder.cleanup()

    @classmethod
    def run_commands(cls):
        cls.documents["replay"], cls.texts["replay"] = json.loads(cls.replayed[0]), cls.replayed[1]
        # Runs 1 and 2 measure X and have the same log. Run 3 measures Y.
        for name, words, forms, *key in (("squareness", (2, 3), "tj"), ("budget", (1,), "tjc"), ("parallelism", (1, 2), "tj"),
                                   ("show", (1,), "tjc"), ("show", (1, "--figures"), "tjc", "show --figures"),
                                   ("compensation build", (1,), "tj")):
            cls.ask(name, words, forms, *key)
        cls.ask("compensation show", (1,), "tjc")
        cls.ask("trend", ("--axis", "X"), "tjc", "trend")
        cls.ask("trend", ("--figure", "EC0Y_urad"), "tjc", "trend of EC0Y")
        cls.ask("budget", (2, 3), "tjc", "budget of two")
        cls.ask("compare", (1, 2), "j")
        for name in ("EYX_slope_urad", "EYX_straightness_um"):
            cls.ask("budget", (1, "--figure", name), "t", f"budget {name}")
        mdof("compensation", "activate", 1, "--despite-warnings", *cls.db)

    @classmethod
    def ask(cls, command, words, forms, name=None):
        at = (*command.split(), *words, *cls.db)
        if "t" in forms:
            cls.texts[name or command] = mdof(*at)
        if "j" in forms:
            cls.documents[name or command] = json.loads(mdof(*at, "--json"))
        if "c" in forms:
            cls.csvs[name or command] = rows(mdof(*at, "--csv"))

    @classmethod
    def call_methods(cls, client):
        replies = cls.replies
        replies["run.get"] = client.call("run.get", run=1)
        replies["run.points"] = client.call("run.points", run=1, offset=0, count=100)
        whole = client.points(1)
        replies["all points"] = {"points": whole, "u_covers": "", "not_declared": []}
        for name in ("EYX_slope_urad", "EZX_slope_urad", "EYX_straightness_um", "ECX_range_urad"):
            replies[f"run.budget {name}"] = client.call("run.budget", run=1, figure=name)
        replies["squareness.fit"] = client.call("squareness.fit", run_x=2, run_y=3)
        replies["squareness.budget"] = client.call("squareness.budget", run_x=2, run_y=3)
        replies["parallelism.fit"] = client.call("parallelism.fit", run_a=1, run_b=2)
        compared = client.call("run.compare", before=1, after=2)
        replies["run.compare"] = compared | {"figures": {k: f["before"] for k, f in compared["figures"].items()}}
        trend = client.call("run.trend", axis="X")
        replies["run.trend"] = trend | {"figures": {k: f | {key: f["values"][-1][key] for key in ("value", "u", "U")}
                                                    for k, f in trend["figures"].items()}}
        replies["compensation.build"] = client.call("compensation.build", runs=[1])
        replies["compensation.status"] = client.call("compensation.status")
        replies["compensation.grid"] = client.call("compensation.grid", axis="X", offset=0, count=100)
        replies["compensation.table"] = client.call("compensation.table", table=replies["compensation.build"]["table"], count=100)
        cls.at = []
        for p in replies["compensation.grid"]["points"]:
            for side, direction in (("forward", 1), ("reverse", -1)):
                reply = client.call("compensation.at", axis="X", position_mm=p["position_mm"], direction=direction)
                cls.at.append((side, p["position_mm"], reply))
        replies["compensation.at"] = cls.at[0][2]

    @classmethod
    def collected(cls):
        n = Notes()
        for name in ("replay", "show"):
            figures(n, name, cls.documents[name]["uncertainty"])
            straightness(n, name, cls.documents[name]["straightness"])
            points(n, name, cls.documents[name]["points"])
        points(n, "run.points", cls.replies["all points"]["points"])
        for where, block in (("show --figures", cls.documents["show --figures"]), ("run.get", cls.replies["run.get"])):
            figures(n, where, block["uncertainty"])
            straightness(n, where, block["straightness"])
        for where in ("budget", "budget of two", "parallelism"):
            figures(n, where, cls.documents[where]["figures"])
        figures(n, "compare", {k: f["before"] for k, f in cls.documents["compare"]["figures"].items()})
        for where, reply in cls.replies.items():
            if "figures" in reply:
                figures(n, where, reply["figures"])
        for where, s in (("squareness", cls.documents["squareness"]), ("squareness.fit", cls.replies["squareness.fit"])):
            n.add("EC0Y_urad", where, value=s["EC0Y_urad"], u=s["u_EC0Y_urad"], U=s["U_EC0Y_urad"])
            for error in ("EYX", "EXY"):
                n.add(f"{error}_slope_urad", where, value=s[f"slope_{error}_urad"], u=s[f"u_slope_{error}_urad"])
            figures(n, where + ", uncertainty", s["uncertainty"])
        for where in ("trend", "trend of EC0Y"):
            for name, f in cls.documents[where]["figures"].items():
                n.add(name, where, **{key: f["values"][-1][key] for key in ("value", "u", "U")})
        table(n, "compensation show", cls.documents["compensation show"]["points"])
        table(n, "compensation build", cls.documents["compensation build"]["points"])
        table(n, "compensation.grid", cls.replies["compensation.grid"]["points"])
        table(n, "compensation.table", cls.replies["compensation.table"]["points"])
        for side, at_mm, reply in cls.at:
            for key, u in reply["u"].items():
                n.add(f"table {side} {at_mm:.6f} {key}", "compensation.at", value=reply["error"][key], u=u)
        cls.collect_csv(n)
        cls.collect_text(n)
        return n

    @classmethod
    def collect_csv(cls, n):
        for where in ("budget", "budget of two"):
            for r in cls.csvs[where]:
                n.add(r["figure"], where + " --csv", value=r["value"], u=r["u"], U=r["U"])
        for where in ("trend", "trend of EC0Y"):
            last = {r["figure"]: r for r in cls.csvs[where]}
            for name, r in last.items():
                n.add(name, where + " --csv", value=r["value"], u=r["u"], U=r["U"])
        for r in cls.csvs["show --figures"]:
            if r["approach"] != "mean":
                continue
            for figure, column in (("straightness_um", "least_squares_um"), ("slope_urad", "slope_least_squares_urad"),
                                   ("range_urad", "range_urad")):
                if r[column]:
                    n.add(f"{r['error']}_{figure}", "show --figures --csv", value=r[column], u=r["u_" + column], U=r["U_" + column])
            if r["form_urad"]:
                n.add(f"{r['error']}_form_urad", "show --figures --csv", value=r["form_urad"])
        for i, r in enumerate(cls.csvs["show"]):
            for key in [c[2:] for c in r if re.fullmatch(r"u_E.._u(m|rad)", c)]:
                n.add(f"point {i} {key}", "show --csv", value=r[key], u=r["u_" + key], U=r["U_" + key])
        for r in cls.csvs["compensation show"]:
            for side in ("forward", "reverse"):
                for key in [c[len(side) + 1:] for c in r if c.startswith(side + "_")]:
                    n.add(f"table {side} {float(r['position_mm']):.6f} {key}", "compensation show --csv",
                          value=r[f"{side}_{key}"], u=r[f"u_{side}_{key}"])

    @classmethod
    def collect_text(cls, n):
        number = r"(-?[\d.]+)"
        for where, name in (("squareness", "EC0Y_urad"), ("budget EYX_slope_urad", "EYX_slope_urad"),
                            ("budget EYX_straightness_um", "EYX_straightness_um"), ("budget of two", "EC0Y_urad")):
            short = name.rsplit("_", 1)[0]
            value, u, U = re.search(rf"{short} = {number} ± {number} \S+, expanded U = {number}", cls.texts[where]).groups()
            n.add(name, where + " in text", True, value=value, u=u, U=U)
        for where in ("replay", "show --figures"):
            for error in ("EYX", "EZX"):
                value, u, form = re.search(rf"{error} +mean +[\d.]+ +[\d.]+ +{number} ± {number} +{number} ",
                                           cls.texts[where]).groups()
                n.add(f"{error}_slope_urad", where + " in text", True, value=value, u=u)
                n.add(f"{error}_form_urad", where + " in text", True, value=form)
        for where in ("replay", "show", "show --figures", "budget"):
            found = re.findall(rf"(E\S+_\S+) +{number} ± {number} +(µm|µrad) +{number} ", cls.texts[where])
            assert len(found) == 7, (where, found)
            for short, value, u, unit, U in found:
                n.add(f"{short}_{unit.replace('µ', 'u')}", where + " in text", True, value=value, u=u, U=U)
        for error in ("EYX", "EXY"):
            value, u = re.search(rf"{error}, run \d +{number} ± {number}", cls.texts["squareness"]).groups()
            n.add(f"{error}_slope_urad", "squareness in text", True, value=value, u=u)
        value, u = re.findall(rf"Z +{number} ± {number}", cls.texts["trend of EC0Y"])[-1]
        n.add("EC0Y_urad", "trend in text", True, value=value, u=u)
        for row, r in zip(cls.replies["compensation.grid"]["points"],
                          cls.texts["compensation show"].split("\nforward\n")[1].splitlines()[2:]):
            for key, (value, u) in zip(row["forward"]["u"], re.findall(rf"{number} ± {number}", r)):
                n.add(f"table forward {row['position_mm']:.6f} {key}", "compensation show in text", True, value=value, u=u)

    def test_one_value_one_u_one_U(self):
        self.assertEqual(self.notes.contradictions(), [])
        self.assertGreater(len(self.notes.said), 2500)
        self.assertEqual(len(self.notes.places("EYX_slope_urad")), 23)
        self.assertEqual(len(self.notes.places("EC0Y_urad")), 12)

    # Control: the comparison must detect a changed number.
    def test_a_changed_number_is_found(self):
        changed = 0
        for i, (name, where, numbers, shown) in enumerate(self.notes.said):
            if name.startswith(("point", "table")) and i % 50:
                continue
            for key in numbers:
                others = [1 for other, _, more, _ in self.notes.said if other == name and key in more]
                if len(others) < 2 or numbers[key] == 0:
                    continue
                notes = Notes()
                notes.said = copy.deepcopy([said for said in self.notes.said if said[0] == name])
                mine = next(said for said in notes.said if said[1] == where and key in said[2])
                mine[2][key] *= 1.02 if shown else 1 + 1e-9
                if shown and abs(numbers[key]) * 0.02 <= 2 * shown[key]:
                    continue
                self.assertNotEqual(notes.contradictions(), [], (name, where, key))
                changed += 1
        self.assertGreater(changed, 300)

    # Form and noise are not uncertainties of the slope. The output contains all three, and they differ.
    def test_form_is_not_u(self):
        f = self.documents["show --figures"]["straightness"]["EYX_um"]["mean"]
        budget = self.documents["budget"]["figures"]["EYX_slope_urad"]
        self.assertGreater(f["form_urad"], 10 * f["u_slope_least_squares_urad"])
        self.assertGreater(budget["u"], 2 * budget["u_random"])
        self.assertIsNone(self.documents["show --figures"]["straightness"]["EYX_um"]["forward"]["u_slope_least_squares_urad"])

    def test_what_u_covers_is_in_every_document(self):
        for where, document in {**self.documents, **self.replies}.items():
            with self.subTest(where):
                covers = self.all_of(document, "u_covers")
                self.assertTrue(covers, "no u_covers")
                self.assertTrue(all("noise only" not in text and "repeatability only" not in text for text in covers))
                keys = self.all_of(document, "not_declared")
                self.assertTrue(keys, "no not_declared")
                if where != "all points":
                    self.assertTrue(all(any(key.endswith(k) for key in named) for k in NOT_DECLARED for named in keys), keys)
        for where, table_of in self.csvs.items():
            with self.subTest(where + " --csv"):
                for r in table_of:
                    self.assertIn("declare", r["u_covers"])
                    self.assertIn("u_flatness_um", r["not_declared"])

    def all_of(self, document, key):
        if isinstance(document, list):
            return [x for part in document for x in self.all_of(part, key)]
        if not isinstance(document, dict):
            return []
        return ([document[key]] if key in document else []) + [x for part in document.values() for x in self.all_of(part, key)]

    def test_every_command_and_method_is_known_here(self):
        with open(os.path.join(ROOT, "tools", "mdof", "commands", "commands.inc")) as f:
            commands = {name.replace("_", " ") for name in re.findall(r"^COMMAND\((\w+)\)", f.read(), re.M)}
        known = {name.replace("-", " ") for name in COMPARED | OTHERS}
        self.assertEqual(commands - known, set(), "say in this test what these state")
        self.assertEqual(self.discovered - COMPARED_METHODS - OTHER_METHODS, set(), "say in this test what these state")
        asked = {name.split(" ")[0] for name in self.replies} - {"all"}
        self.assertEqual(COMPARED_METHODS - asked, set())
        self.assertEqual(COMPARED - {name.split(" of ")[0] for name in self.documents}, set())


# If the rigs declare no uncertainties, the first line of every text says so.
class NothingDeclared(unittest.TestCase):
    def test_the_first_line_says_so(self):
        with tempfile.TemporaryDirectory() as folder:
            db = ("--db", os.path.join(folder, "mdof.db"))
            texts = {}
            for axis in "XY":
                log = os.path.join(DATA, "five-probe", f"log_{axis}.csv.gz")
                texts[f"replay {axis}"] = mdof("replay", log, "--rig", RIG[axis], *db)
            mdof("replay", recorded_again(os.path.join(DATA, "five-probe", "log_X.csv.gz"), folder), "--rig", RIG["X"], *db)
            for words in (("show", 1), ("show", 1, "--figures"), ("squareness", 1, 2), ("budget", 1), ("budget", 1, 2),
                          ("budget", 1, "--figure", "EYX_slope_urad"), ("parallelism", 1, 3), ("trend",),
                          ("compensation", "build", 1), ("compensation", "show", 1)):
                texts[words] = mdof(*words, *db)
            for words, text in texts.items():
                self.assertTrue(text.startswith("NOISE ONLY: no declared uncertainty"), (words, text[:200]))
            for words in (("show", 1), ("show", 1, "--figures"), ("budget", 1), ("trend",), ("compensation", "show", 1)):
                for r in rows(mdof(*words, "--csv", *db)):
                    self.assertRegex(r["u_covers"], "^noise( and repeatability)? only", words)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
