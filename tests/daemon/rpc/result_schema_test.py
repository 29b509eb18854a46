#!/usr/bin/python3
"""The result schemas in rpc.discover are valid JSON Schema, permit no other members, and describe each member. If
a result has a missing member, an additional member or a wrong type, the check rejects it and names the member.
Every client of tests/daemon/mdofd.py checks its results.

usage: result_schema_test.py MDOFD MDOF"""
import copy
import json
import os
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import jsonschema  # noqa: E402
from mdofd import DATA, RIG, Client, Daemon, recorded_again, simulator  # noqa: E402

MDOFD, MDOF = sys.argv[1:3]
# Devices, clients and codes may add members to these objects.
OPEN = {"options", "methods", "notices", "components", "probes"}
MACHINE = """name = "m"
machine = {chain = "w-b-X-Y-t"}
[[axis]]
id = "X"
holds_at_mm = [0, 0, 0]
point = "moving"
range_mm = [0, 10]
EXX_um = 2
u_EXX_um = 0.1
[[axis]]
id = "Y"
holds_at_mm = [0, 0, 0]
point = "moving"
range_mm = [0, 10]
"""
# Runs 1 and 3 measure X, run 2 measures Y, run 4 is imported. Table 1 belongs to X, table 2 is the volume.
CALLS = [
    ("server.info", {}), ("server.health", {}), ("device.list", {}), ("rig.get", {"axis": "X"}), ("history.list", {}),
    ("run.list", {}), ("run.get", {"run": 1}), ("run.get", {"run": 4}), ("run.points", {"run": 1}), ("run.points", {"run": 4}),
    ("run.analyse", {"run": 1}), ("run.budget", {"run": 1, "figure": "EYX_um", "at_mm": 20}), ("run.budget", {"run": 1, "figure": "EYX_straightness_um"}),
    ("run.compare", {"before": 1, "after": 3}), ("run.trend", {}), ("squareness.fit", {"run_x": 1, "run_y": 2}),
    ("squareness.budget", {"run_x": 1, "run_y": 2}), ("parallelism.fit", {"run_a": 1, "run_b": 3}),
    ("compensation.build", {"runs": [1]}), ("compensation.build", {"runs": [4]}),
    ("compensation.build_volume", {"machine": MACHINE, "axes": "XY", "step_mm": 5, "incomplete": True}),
    ("compensation.list", {}), ("compensation.list", {"axis": "volume"}), ("compensation.table", {"table": 1}),
    ("compensation.table", {"table": 2}),
    ("compensation.activate", {"table": 1, "despite_warnings": True}), ("compensation.status", {}),
    ("compensation.grid", {"axis": "X"}), ("compensation.at", {"axis": "X", "position_mm": 20}),
    ("compensation.deactivate", {"axis": "X"}),
    ("machine.at", {"machine": MACHINE, "X_mm": 5}), ("live.subscribe", {"interval_ms": 10000, "events": False}),
    ("live.unsubscribe", {}), ("rpc.discover", {}),
]
VOLUME = [("compensation.status", {}), ("compensation.grid", {"axis": "volume"}), ("compensation.grid", {"axis": "volume", "u_parts": True}),
          ("compensation.at", {"axis": "volume", "X_mm": 3, "Y_mm": 4}), ("compensation.deactivate", {"axis": "volume"})]
# Other tests check the results of these methods, because they need a moving machine or a file.
ELSEWHERE = {"run.start", "run.resume", "run.stop", "run.replay", "run.import", "encoder.set"}


def parts(schema, path=""):
    """Each schema that is inside a schema, with its path."""
    yield path, schema
    for key in ("properties", "patternProperties"):
        for name, below in schema.get(key, {}).items():
            yield from parts(below, f"{path}/{name}")
    for below in schema.get("anyOf", []) + ([schema["items"]] if "items" in schema else []):
        yield from parts(below, path)


class ResultSchema(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = temporary.name
        cls.daemon = Daemon(MDOFD, cls.folder, simulator("X"))
        logs = {axis: os.path.join(DATA, "five-probe", f"log_{axis}.csv.gz") for axis in "XY"}
        for axis, log in (("X", logs["X"]), ("Y", logs["Y"]), ("X", recorded_again(logs["X"], cls.folder))):
            cls.mdof("replay", log, "--rig", RIG[axis], "--db", cls.daemon.database)
        readings = os.path.join(cls.folder, "laser.csv")
        with open(readings, "w") as file:
            file.write("target_mm,direction,run,deviation_um\n" +
                       "".join(f"{x},{d},{k},{.1 * x * d + k}\n" for k in (1, 2) for d in (1, -1) for x in (0, 9)))
        cls.mdof("import", readings, "--axis", "X", "--u-um", "0.2", "--db", cls.daemon.database)
        cls.client = cls.daemon.start()
        cls.addClassCleanup(cls.daemon.stop)
        cls.addClassCleanup(cls.client.socket.close)
        cls.results = [(method, cls.client.call(method, **params)) for method, params in CALLS]
        volume = next(r["table"] for m, r in cls.results if m == "compensation.build_volume")
        cls.client.call("compensation.activate", table=volume, despite_warnings=True)
        cls.volume, cls.status = volume, cls.mdof("status", "--socket", cls.daemon.socket)
        cls.results += [(method, cls.client.call(method, **params)) for method, params in VOLUME]

    @classmethod
    def mdof(cls, *words):
        done = subprocess.run([MDOF, *map(str, words)], capture_output=True, text=True, timeout=60)
        assert done.returncode == 0, (words, done.stderr)
        return done.stdout

    def test_mdof_status_shows_the_active_volume(self):
        row = next(line for line in self.status.splitlines() if line.startswith("volume "))
        self.assertEqual(row.split()[1], str(self.volume))
        self.assertTrue(row.rstrip().endswith("DOUBTFUL  no"), row)
        self.assertNotIn("no table is active", self.status)

    def test_every_method_has_one(self):
        self.assertEqual({m for m, _ in self.results} | ELSEWHERE, set(Client.schemas.of))
        for method, schema in Client.schemas.of.items():
            with self.subTest(method):
                jsonschema.Draft7Validator.check_schema(schema)
                self.assertLess(len(json.dumps(schema)), 40_000)
                for path, part in parts(schema):
                    name = path.split("/")[-1]
                    if "object" in part.get("type", []) and name not in OPEN:
                        self.assertIs(part.get("additionalProperties"), False, path)
                    if path and ("anyOf" in part or part["type"] not in ("object", "array")) and "description" not in part:
                        # The description of an array is also the description of its elements.
                        self.assertTrue(any(p == path and "description" in other for p, other in parts(schema)), path)

    def test_a_member_less_or_more_or_of_another_type_is_seen(self):
        tried = 0
        for method, result in self.results:
            self.assertEqual(Client.schemas.wrong(method, result), [])
            if not result:
                continue
            name = next(iter(result))
            for change in (lambda r: r.pop(name), lambda r: r.update(another=1), lambda r: r.update({name: [[True]]})):
                changed = copy.deepcopy(result)
                change(changed)
                wrong = Client.schemas.wrong(method, changed)
                self.assertTrue(wrong, (method, name))
                tried += 1
        self.assertGreater(tried, 90)

    def test_a_point_without_an_error_is_seen(self):
        result = copy.deepcopy(next(r for m, r in self.results if m == "run.points"))
        del result["points"][3]["samples"]
        self.assertIn("samples", " ".join(Client.schemas.wrong("run.points", result)))
        result["points"][3].update(samples=1, EYX_mm=1)
        self.assertIn("EYX_mm", " ".join(Client.schemas.wrong("run.points", result)))

    def test_a_small_page_is_no_longer_than_asked(self):
        with Raw(self.daemon.socket) as raw:
            seen, offset = [], 0
            while offset is not None:
                line = raw.line("rpc.discover", {"offset": offset, "max_bytes": 4096})
                self.assertLessEqual(len(line), 4096)
                page = json.loads(line)["result"]
                seen += [m["name"] for m in page["methods"]]
                offset = page.get("x-next-offset")
            self.assertEqual(set(seen), set(Client.schemas.of))


class Raw:
    def __init__(self, socket):
        self.client = Client(socket)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.client.socket.close()

    def line(self, method, params):
        self.client.file.write(json.dumps({"jsonrpc": "2.0", "id": 1, "method": method, "params": params}).encode() + b"\n")
        self.client.file.flush()
        return self.client.file.readline()


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
