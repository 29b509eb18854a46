#!/usr/bin/python3
"""Every parameter of every method has a limit. If a value exceeds its limit, mdofd rejects the request at once,
names the parameter, and continues to serve.

usage: bounds_test.py MDOFD MDOF"""
import os
import sys
import tempfile
import time
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from mdofd import Client, Daemon, RpcError, simulator  # noqa: E402
from result_schemas import methods  # noqa: E402

MDOFD, MDOF = sys.argv[1:3]
USAGE = -32602
LONG = 60_000  # bytes; a value of this length still fits into a request line


def beyond(schema):
    """Values that have the right type and that every method must reject."""
    kind = schema["type"]
    if kind == "string":
        return ["x" * (schema["maxLength"] + 1)] if schema["maxLength"] < LONG else []
    if kind == "array":
        return [[1] * (schema["maxItems"] + 1), [1e300], [-1e300]]
    if kind in ("number", "integer"):
        return [schema.get("minimum", -2**53) - 1 if "minimum" in schema else -2**54,
                schema.get("maximum", 2**53) * 2, 2**63 - 1, -2**63]
    return []


class Bounds(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.daemon = Daemon(MDOFD, cls.folder.name, simulator("X"))
        cls.client = cls.daemon.start()

    @classmethod
    def tearDownClass(cls):
        cls.daemon.stop()
        cls.folder.cleanup()

    def refused(self, method, **params):
        begin = time.monotonic()
        with self.assertRaises(RpcError, msg=f"{method} takes {str(params)[:80]}") as refusal:
            self.client.call(method, **params)
        self.assertLess(time.monotonic() - begin, 1, method)
        return refusal.exception

    def test_every_parameter_of_every_method_is_bounded(self):
        tried = 0
        for method in methods(self.client):
            for param in method["params"]:
                for value in beyond(param["schema"]):
                    with self.subTest(method=method["name"], param=param["name"], value=str(value)[:40]):
                        error = self.refused(method["name"], **{**method["x-example-params"], param["name"]: value})
                        self.assertEqual(error.code, USAGE, error)
                        self.assertIn(param["name"], str(error))
                        tried += 1
        self.assertGreater(tried, 80)
        self.assertEqual(self.client.call("server.info")["server"], "mdofd")

    def test_a_table_of_many_or_doubled_runs_is_refused_before_any_is_read(self):
        self.assertIn("at most 64", str(self.refused("compensation.build", runs=[1] * 16_000)))
        self.assertIn("given twice", str(self.refused("compensation.build", runs=[1] * 64)))
        self.assertIn("twice", str(self.refused("compensation.build", runs=[1, 2, 1])))

    def test_an_interval_is_at_most_an_hour(self):
        client = Client(self.daemon.socket)
        self.assertEqual(client.call("live.subscribe", interval_ms=3_600_000)["interval_ms"], 3_600_000)
        for interval in (3_600_001, 2**62, -2**62):
            self.assertIn("interval_ms", str(self.refused("live.subscribe", interval_ms=interval)))

    def test_a_run_has_at_most_as_many_targets_as_its_reply_can_name(self):
        self.assertIn("limit 1500", str(self.refused("run.start", axis="X", from_mm=0, to_mm=2700, interval_mm=1)))
        self.assertIn("1500", str(self.refused("run.start", axis="X", targets_mm=list(range(2700)))))
        self.assertIn("1024", str(self.refused("run.start", axis="X", note="n" * 1025)))
        self.assertIsNone(self.client.call("server.info")["axes"][0]["run"], "a refused run has begun")
        most = self.client.call("run.start", axis="X", from_mm=-1000, to_mm=499, interval_mm=1, jitter_mm=0.4)
        self.assertEqual(len(most["targets_mm"]), 1500)
        self.client.call("run.stop", run=most["run"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
