#!/usr/bin/python3
"""A live run of every driver: simulated devices on real sockets, lines and files -> mdofd -> correct points, and the
same bits from a replay of the recording. tests/vm/run live tests the USB devices.

usage: each_device_test.py MDOFD MDOF MDOF_SIMULATE [--comedi LIBRARY] [--keep FOLDER] [SETUP...]

--comedi LIBRARY replaces the boards of comedilib (comedi_by_rows.cpp); without it these setups are left out.

--keep FOLDER writes NAME.mdofrec, and NAME.json with the expected result of its replay, for
tests/data/devices/recordings, which tests/daemon/kept_recordings_test.py replays."""
import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from device_setups import COMEDI_CALIBRATION, SETUPS, Simulators, worst_errors  # noqa: E402
from mdofd import Client, Daemon, notice_lines  # noqa: E402


def wait_until_all_flow(client, timeout_s=60):
    end = time.monotonic() + timeout_s
    while True:
        devices = client.call("device.list")["devices"]
        # Before the clocks have settled, mdofd warns that times may be wrong. On a busy computer this takes longer.
        settled = all(not d["clock"] or d["clock"]["settled"] for d in devices)
        if settled and all(d["state"] == "open" and d["scans"] > 20 for d in devices):
            return
        assert time.monotonic() < end, f"not all devices give samples: {devices}"
        time.sleep(0.05)


def shown_at_zero_mm(daemon, setup):
    """The reading of an incremental encoder at the first target. Its zero is the position at which mdofd opened
    the device."""
    watcher = Client(daemon.socket)
    watcher.call("live.subscribe", interval_ms=20, events=False)
    pass_s = 2 * len(setup.targets) * (setup.dwell_s + 1)
    stops, end = [], time.monotonic() + pass_s
    while time.monotonic() < end:
        value = watcher.next_note()["params"]["value"]
        if value["still"]:
            stops.append(round(value["encoder_mm"], 2))
    # The axis also reverses beyond the last targets, but does not stop there.
    return min(s for s in set(stops) if stops.count(s) > 0.02 * len(stops)) - setup.targets[0]


def measured(daemon, client, targets, axis="X", meanwhile=lambda run: None):
    """Measures a complete run, with each target once in both directions. Returns its id."""
    watcher = Client(daemon.socket, timeout_s=120)
    watcher.call("live.subscribe", interval_ms=20)
    # If a run begins at the end of a stop, it includes this stop. The stop then has too few readings for a point.
    while not (value := watcher.next_note()["params"]["value"]).get("axis") == axis or value.get("still", True):
        pass
    run = client.call("run.start", axis=axis, targets_mm=targets, repeats=1)["run"]
    meanwhile(run)
    limit = time.monotonic() + 120
    while True:
        value = watcher.next_note()["params"]["value"]
        assert time.monotonic() < limit, ("the run does not end", client.call("device.list"), client.points(run)[:3])
        if value.get("type") == "ended":
            header = client.call("run.get", run=value["run"])
            assert header["state"] == "complete", header
            assert value["run"] == run or header["supersedes"] == run
            return header


def replayed(mdof, recording, *options):
    done = subprocess.run([mdof, "replay", recording, "--no-store", "--json", *map(str, options)],
                          capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def check(options, name):
    setup = SETUPS[name]
    with tempfile.TemporaryDirectory() as folder:
        simulators = Simulators(options.mdof_simulate, setup, folder)
        shutil.copy(setup.rig, folder)
        daemon = Daemon(os.path.abspath(options.mdofd), folder, setup.config_text(simulators.addresses),
                        relative=True)
        if setup.comedi:
            with open(os.path.join(folder, "board.calibration"), "w") as f:
                f.write(COMEDI_CALIBRATION)
            daemon.environment = {"LD_PRELOAD": os.path.abspath(options.comedi),
                                  "MDOF_COMEDI_CALIBRATION": "board.calibration"}
        try:
            client = daemon.start(timeout_s=60)
            wait_until_all_flow(client)
            zero_mm = shown_at_zero_mm(daemon, setup) if setup.usb else 0.0
            targets = [round(t + zero_mm, 4) for t in setup.targets]
            header = measured(daemon, client, targets)
            points = client.points(header["run"])
            daemon.stop()
        finally:
            simulators.kill()
            daemon.process.kill()
            daemon.process.wait()
        recording = header["recording"]["path"]
        again = replayed(options.mdof, recording)  # no options are needed: the recording contains them
        assert again["points"] == points, f"{name}: a replay gives other points"
        for key in ("state", "options", "straightness", "angles", "note"):
            assert again[key] == header[key], f"{name}: a replay gives another {key}"
        unsolved = [p for p in points if any(p[key] is None for key in ("EYX_um", "EZX_um", "EAX_urad"))]
        assert not unsolved, (f"{name}: {len(unsolved)} points are not solved", unsolved[0]["flags"], notice_lines(header))
        worst = worst_errors(points, zero_mm)
        for key, error in worst.items():
            bound = setup.straightness_um if key.endswith("_um") else setup.angle_urad
            assert error < bound, (f"{name}: {key} is off by {error} (bound {bound})", [p["flags"] for p in points], notice_lines(header))
        assert {(p["target"], p["direction"]) for p in points} >= {
            (t + 1, d) for t in range(len(setup.targets)) for d in (1, -1)}
        if setup.position_um:
            off_um = max(abs(p["position_mm"] - setup.targets[p["target"] - 1]) for p in points) * 1e3
            assert off_um < setup.position_um, f"{name}: a position is off by {off_um} µm"
            worst["position_um"] = off_um
        if options.keep:
            keep(options.keep, name, recording, again)
        return f"{name}: {len(points)} points, worst " + ", ".join(f"{k} {v:.3g}" for k, v in worst.items())


def keep(folder, name, recording, result):
    os.makedirs(folder, exist_ok=True)
    shutil.copy(recording, os.path.join(folder, name + ".mdofrec"))
    expected = {"points": result["points"]}
    with open(os.path.join(folder, name + ".json"), "w") as f:
        json.dump(expected, f, indent=1)
        f.write("\n")


def main():
    parser = argparse.ArgumentParser()
    for program in ("mdofd", "mdof", "mdof_simulate"):
        parser.add_argument(program)
    parser.add_argument("setups", nargs="*", default=[n for n, s in SETUPS.items() if not s.usb])
    parser.add_argument("--keep")
    parser.add_argument("--comedi")
    options = parser.parse_intermixed_args()
    for name in options.setups:
        if SETUPS[name].comedi and not options.comedi:
            print(f"{name}: left out, as there is no --comedi", flush=True)
            continue
        print(check(options, name), flush=True)


if __name__ == "__main__":
    main()
