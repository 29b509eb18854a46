#!/usr/bin/python3
"""Sends requests to every method of mdofd. The values have all types; they are within and beyond the limits of
rpc.discover. mdofd must answer each request once, with a result or with an error of a known code, in one line.
mdofd must continue to serve and end with exit code 0.

usage: typed_requests_test.py MDOFD MDOF [--requests 100000] [--seed 1]"""
import argparse
import atexit
import json
import os
import random
import sys
import tempfile
import time

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from mdofd import RIG, Client, Daemon, simulator, write_log  # noqa: E402
from result_schemas import methods  # noqa: E402

INTERNAL = -32603
TOGETHER = 32  # number of requests that are sent before the first reply is read
MOST_BYTES = 48 * 1024
MOST_GROWTH_KIB = 200 * 1024
SLOWEST_S = 10
NUMBERS = [0, 1, -1, 2, 3, 0.5, -0.0, 1e-320, 1e308, -1e308, 2 ** 31, 2 ** 53 + 1, 2 ** 63 - 1, -2 ** 63, 2 ** 64, 10 ** 30]
TEXTS = ["", "X", "Y", "x", "fixture", "carriage", "tool", "EYX", "EC0Y", "rigid", "exact", "latest", "\x00", "\x1b[2J", "\u202e",
         "é" * 40, "a" * 1025, "a" * 5000, "/", "..", "/dev/null", "/etc/passwd", "%s%n", "1", "null", "🙂", "-", "\\u0000"]

MACHINE = """name = "m"
machine = {chain = "w-X-b-Y-t"}
[[axis]]
id = "X"
holds_at_mm = [0, 0, 0]
point = "standing"
range_mm = [0, 10]
runs = 1
EXX_um = 2
[[axis]]
id = "Y"
holds_at_mm = [0, 0, 0]
point = "moving"
range_mm = [0, 10]
"""


def any_value(rng, depth=0):
    way = rng.randrange(8 if depth < 3 else 5)
    if way == 0:
        return rng.choice(NUMBERS)
    if way == 1:
        return rng.choice(TEXTS)
    if way == 2:
        return rng.choice((True, False, None))
    if way == 3:
        return rng.uniform(-1e4, 1e4)
    if way == 4:
        return rng.randrange(-5, 1000)
    if way == 5:
        return [any_value(rng, depth + 1) for _ in range(rng.choice((0, 1, 3, 70)))]
    if way == 6:
        return {rng.choice(TEXTS): any_value(rng, depth + 1) for _ in range(rng.choice((0, 1, 4)))}
    return rng.choice([[]] * 3 + [[[[[[[]]]]]]])


def value_for(rng, parameter, world):
    """A value for this parameter. In four of five cases, rpc.discover permits the value."""
    if rng.random() < 0.2:
        return any_value(rng)
    schema, name = parameter["schema"], parameter["name"]
    if name in world and rng.random() < 0.7:
        return rng.choice(world[name])
    kind = schema["type"]
    if kind == "boolean":
        return rng.choice((True, False))
    if kind == "integer":
        return rng.choice((schema.get("minimum", 0), schema.get("maximum", 9), rng.randrange(-2, 60), rng.choice(NUMBERS)))
    if kind == "number":
        return rng.choice((schema.get("minimum", -5.0), schema.get("maximum", 5.0), rng.uniform(-1, 70), rng.choice(NUMBERS)))
    if kind == "array":
        return [rng.choice((rng.randrange(0, 20), rng.uniform(-1, 60))) for _ in range(rng.choice((0, 1, 2, 5, 100)))]
    return rng.choice(TEXTS)


def is_beyond_64_bits(value):
    """True if a number is an integer beyond 64 bits. mdofd rejects it as invalid JSON, and the reply then has no
    id."""
    if isinstance(value, dict):
        return any(map(is_beyond_64_bits, value.values()))
    if isinstance(value, list):
        return any(map(is_beyond_64_bits, value))
    return isinstance(value, int) and not -2 ** 63 <= value < 2 ** 64


NEEDED = {"despite_warnings", "incomplete", "position_mm", "rig", "run_x", "run_y"}


def request(rng, number, method, world):
    parameters = method["params"]
    if parameters and rng.random() < 0.15:  # parameters by position
        given = [value_for(rng, p, world) for p in parameters[:rng.randrange(len(parameters) + 2)]]
    elif rng.random() < 0.3:  # only existing values, and few parameters
        given = {p["name"]: rng.choice(world[p["name"]]) for p in parameters
                 if p["name"] in world and (p["required"] or p["name"] in NEEDED)}
    else:
        given = {p["name"]: value_for(rng, p, world) for p in parameters
                 if rng.random() < (0.95 if p["required"] else 0.3)}
        if rng.random() < 0.03:
            given[rng.choice(TEXTS)] = any_value(rng)
    made = {"jsonrpc": "2.0", "id": number, "method": method["name"], "params": given}
    # If a line is longer than the limit, mdofd ends the connection (tests/daemon/rpc/line/hostile_test.cpp).
    return made if len(json.dumps(made)) < 60_000 else request(rng, number, method, world)


class Bench:
    def __init__(self, mdofd, folder):
        logs = [os.path.join(folder, f"log_{i}.csv") for i in range(3)]
        for i, log in enumerate(logs):
            write_log(log)
            with open(log) as f:
                text = f.read()
            with open(log, "w") as f:  # each log must have other readings
                f.write(text.replace(",0.1,0.2,0.3,0.4,", f",0.1{i},0.2{i},0.3{i},0.4{i},"))
        series = os.path.join(folder, "series.csv")
        with open(series, "w") as f:
            f.write("position_mm,deviation_um\n0,1\n10,2\n20,0\n")
        self.daemon = Daemon(mdofd, os.path.join(folder, "d"), simulator("X"), durability="normal")
        client = self.daemon.start()
        texts = {}
        for axis in "XY":
            with open(RIG[axis]) as rig:
                texts[axis] = rig.read()
        runs = [client.call("run.replay", path=log, rig=texts[axis])["run"] for log, axis in zip(logs, "XYX")]
        table = client.call("compensation.build", runs=[runs[0]])["table"]
        client.call("compensation.activate", table=table, despite_warnings=True)
        volume = client.call("compensation.build_volume", machine=MACHINE, axes="XY", step_mm=5, incomplete=True)["table"]
        self.methods = methods(client)
        # Values that exist, so that the methods succeed in some requests.
        self.world = {"run": runs + [99], "runs": [[r] for r in runs] + [runs], "run_x": runs, "run_y": runs, "run_z": [99], "run_a": runs,
                      "before": runs, "after": runs,
                      "run_b": runs, "table": [table, 2, volume, 99], "axis": ["X", "Y", "Z", "volume"], "path": logs + [series], "position_mm": [0, 1.5, 3],
                      "rig": list(texts.values()), "figure": ["EYX_um", "EAX_urad", "EYX_straightness_um", "ECX_range_urad"], "at_mm": [0, 1, 2, 3],
                      "reference": ["fixture", "carriage", "tool"], "despite_warnings": [True], "offset": [0, 1],
                      # A replay with many targets, or a run over kilometres, is valid but takes long. Therefore the
                      # values here are small.
                      "machine": [MACHINE], "X_mm": [0, 1], "axes": ["XY"], "step_mm": [1], "incomplete": [True], "approach": ["mean"],
                      "limit_um": [1000], "limit_um_per_mm": [50], "u_parts": [True], "reason": ["after scraping"], "baseline": [4],
                      "targets_mm": [[], [0, 1, 2, 3]], "interval_mm": [1], "from_mm": [0], "to_mm": [3]}
        client.socket.close()

    def resident_KiB(self):
        with open(f"/proc/{self.daemon.process.pid}/status") as f:
            return int(next(line for line in f if line.startswith("VmRSS")).split()[1])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("mdofd")
    parser.add_argument("mdof")
    parser.add_argument("--requests", type=int, default=3000)
    parser.add_argument("--seed", type=int, default=1)
    o = parser.parse_args()
    rng = random.Random(o.seed)
    answers, slowest, bad = {}, (0, ""), []
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(o.mdofd, folder)
        atexit.register(lambda: bench.daemon.process.poll() is None and bench.daemon.kill())
        before = bench.resident_KiB()
        client, number, begin = Client(bench.daemon.socket, timeout_s=120), 0, time.monotonic()
        while number < o.requests:
            sent = {}
            for _ in range(min(TOGETHER, o.requests - number)):
                number += 1
                method = rng.choice(bench.methods)
                # A replay takes as long as many other requests, and compensation.at needs an active table. Therefore
                # these methods are called less often.
                if method["name"] in ("run.replay", "compensation.deactivate") and rng.random() < 0.9:
                    method = rng.choice(bench.methods)
                sent[number] = request(rng, number, method, bench.world)
            at = time.monotonic()
            client.file.write("".join(json.dumps(r) + "\n" for r in sent.values()).encode())
            client.file.flush()
            while sent:
                try:
                    line = client.file.readline()
                except TimeoutError:
                    print(f"no answer to {json.dumps(list(sent.values()))[:4000]}")
                    return 1
                if not line:
                    log = open(os.path.join(folder, "d", "stderr"), errors="replace").read()[-2000:]
                    print(f"mdofd closed the connection; code {bench.daemon.process.poll()}; one of "
                          f"{json.dumps(list(sent.values()))[:4000]}\n{log}")
                    return 1
                reply = json.loads(line)
                if "id" not in reply:
                    continue  # a notification has no reply
                unread = [n for n in sent if reply["id"] is None and is_beyond_64_bits(sent[n])]
                asked = sent.pop(unread[0] if unread else reply["id"], None)
                took = time.monotonic() - at
                slowest = max(slowest, (took, asked and asked["method"]))
                code = reply["error"]["code"] if "error" in reply else 0
                if asked and asked["method"] == "run.start" and not code:
                    bench.world["run"] = bench.world["run"][:3] + [reply["result"]["run"]] * 3
                answers.setdefault(asked and asked["method"], {}).setdefault(code, 0)
                answers[asked and asked["method"]][code] += 1
                if asked is None or code == INTERNAL or len(line) > MOST_BYTES or ("result" in reply) == ("error" in reply) or \
                        (code and not reply["error"]["message"]):
                    bad.append(f"{json.dumps(asked)[:600]}\n  -> {line[:400]!r}")
        took = time.monotonic() - begin
        client.socket.close()
        again = Client(bench.daemon.socket, timeout_s=60)
        again.call("server.info")
        grown = bench.resident_KiB() - before
        bench.daemon.stop()
    known = {m["name"] for m in bench.methods}
    served = {name for name, codes in answers.items() if codes.get(0)}
    refused = {name for name, codes in answers.items() if any(codes)}
    print(f"{o.requests} requests, seed {o.seed}, {len(known)} methods, {took:.0f} s; slowest answer {slowest[0]:.2f} s "
          f"({slowest[1]}); memory {grown:+} KiB; codes {json.dumps(answers)}; {len(bad)} wrong")
    print("\n".join(bad[:20]))
    without = {name for name in known if not next(m for m in bench.methods if m["name"] == name)["params"]}
    checks = {"wrong answers": not bad, "a method was never asked": known == set(answers),
              # encoder.set succeeds only if the axis is at rest, which is seldom. If there are few requests, some
              # methods never succeed.
              f"never with success: {sorted(known - served)}":
                  known - served <= ({"encoder.set"} if o.requests >= 50_000 else {"encoder.set", "run.import", "run.replay", "run.resume", "run.start", "run.stop"}),
              f"never refused: {sorted(known - refused - without)}": known - refused <= without | {"rpc.discover"},
              f"an answer took {slowest[0]:.1f} s": slowest[0] < SLOWEST_S, f"memory grew by {grown} KiB": grown < MOST_GROWTH_KIB}
    for what, holds in checks.items():
        if not holds:
            print("FAILED:", what)
    return 0 if all(checks.values()) else 1


if __name__ == "__main__":
    sys.exit(main())
