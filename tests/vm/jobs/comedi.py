"""The kernel's comedi_test, a Comedi board without hardware, through comedilib: its sawtooth follows the kernel's
clock, so that each sample shows its own time. Checks volts, times, no lost scan, a buffer overrun, and the end of a
range."""
# limit: 400 s
import csv
import grp
import os
import signal
import stat
import subprocess
import time

import guest

AMPLITUDE_V, PERIOD_S, RATE_HZ = 5.0, 2.0, 500.0
CODE_V = 20 / 65535  # for -10 to 10 V


def plug(amplitude_V=AMPLITUDE_V, buffer_KiB=2048):
    """Loads the board again."""
    if os.path.exists("/sys/module/comedi"):
        guest.run("modprobe", "-r", "comedi_test")
        guest.run("modprobe", "-r", "comedi")
    guest.run("modprobe", "comedi", f"comedi_default_buf_size_kb={buffer_KiB}",
              f"comedi_default_buf_maxsize_kb={buffer_KiB}")
    guest.run("modprobe", "comedi_test", f"amplitude={amplitude_V * 1e6:.0f}", f"period={PERIOD_S * 1e6:.0f}")
    guest.wait_until(lambda: os.path.exists("/dev/comedi0"), "/dev/comedi0")
    guest.run("udevadm", "settle")


def phase_s(volts):
    """Time of a sample of the sawtooth in the kernel's clock, modulo the period."""
    return (volts + AMPLITUDE_V) / (2 * AMPLITUDE_V) * PERIOD_S


def wrapped_s(s):
    return (s + PERIOD_S / 2) % PERIOD_S - PERIOD_S / 2


def check_rules():
    status = os.stat("/dev/comedi0")
    assert grp.getgrgid(status.st_gid).gr_name == "iocard" and stat.S_IMODE(status.st_mode) == 0o660, status
    guest.figure("udev: /dev/comedi0 is iocard's, 0660")


def recorded(station):
    """Records some seconds; returns rows of time (s), sawtooth and square wave (V)."""
    run = station.client.call("run.start", axis="X")["run"]
    time.sleep(3 * PERIOD_S)
    station.client.call("run.stop", run=run)
    header = guest.wait_until(lambda: (h := station.client.call("run.get", run=run))["state"] != "open" and h,
                              "the run ends", timeout_s=60)
    out = os.path.join(guest.FOLDER, "raw.csv")
    guest.run("mdof", "export", header["recording"]["path"], "--csv", out)
    with open(out.replace(".csv", "-board.csv")) as f:
        rows = list(csv.DictReader(line for line in f if not line.startswith("#")))
    return [(float(r["time_s"]), float(r["D_V"]), float(r["E_V"])) for r in rows]


def check_samples(samples):
    step_s = 1 / RATE_HZ
    resolution_s = CODE_V / (2 * AMPLITUDE_V) * PERIOD_S
    assert len(samples) > 2 * PERIOD_S * RATE_HZ, len(samples)
    for (_, before, _), (_, after, _) in zip(samples, samples[1:]):
        away_s = wrapped_s(phase_s(after) - phase_s(before) - step_s)
        assert abs(away_s) < 2.5 * resolution_s, f"a scan is missing or is there twice: {before} V, {after} V"
    for _, sawtooth, square in samples:
        if min(abs(sawtooth), AMPLITUDE_V - abs(sawtooth)) > 0.01:
            assert abs(square - (AMPLITUDE_V if sawtooth > 0 else -AMPLITUDE_V)) < 2 * CODE_V, (sawtooth, square)
    late_s = [wrapped_s(t - phase_s(v)) for t, v, _ in samples]
    first, last = guest.quantile(late_s, 1), guest.quantile(late_s, 99)
    assert -0.005 < first and last < 0.1, (first, last)
    guest.figure(f"{len(samples)} scans in a row, none missing; times {1e3 * first:.2f} to {1e3 * last:.2f} ms after the "
                 "kernel's own (1 % and 99 %)")


def config(rate_hz=RATE_HZ, range_v=10):
    still = guest.still_config("A_um", "B_um", "C_um", "encoder_mm")
    return still + guest.COMEDI_CONFIG.format(rate_hz=rate_hz, range_v=range_v)


def check_overrun():
    """mdofd sleeps longer than the kernel's buffer lasts: 2 s of two inputs at 2 kHz."""
    plug(buffer_KiB=16)
    station = guest.Station(config(rate_hz=2000), beside=None)
    station.wait_for_scans("board", 1000)
    before = station.device("board")
    os.kill(station.daemon.process.pid, signal.SIGSTOP)
    time.sleep(4)
    os.kill(station.daemon.process.pid, signal.SIGCONT)
    guest.wait_until(lambda: station.device("board")["reopened"] > before["reopened"], "the board is opened again")
    station.wait_for_scans("board", 1000)
    after = station.device("board")
    lost = after["scans_lost"] - before["scans_lost"]
    assert lost > 1000, (before, after)
    guest.figure(f"a buffer that ran over in 4 s: {lost} scans counted as lost, opened again")
    station.stop()


def check_range():
    plug(amplitude_V=8)
    found = guest.probe(guest.config_file(config(range_v=5)), "board")
    print(found)
    square = found["channels"][1]
    assert square["values"] == 0 and square["unusable"] > 500, found
    guest.figure(f"8 V at a range of 5 V: all {square['unusable']} values are {square['worst']}")


guest.start_udev()
plug()
check_rules()
print(guest.run("comedi_board_info", "/dev/comedi0", check=False))
doctor = subprocess.run(["mdof", "doctor", "--config", guest.config_file(config())], capture_output=True, text=True)
print(doctor.stdout, doctor.stderr)
assert "Comedi board: /dev/comedi0" in doctor.stdout, doctor.stdout
found = guest.probe(guest.config_file(config()), "board")
print(found)
assert found["error"] is None and found["scans"] > 500 and 400 < found["rate_hz"] < 600, found
guest.figure(f"{found['description']}, {found['rate_hz']:.1f} scans a second, {found['lost']} lost")
station = guest.Station(config(), beside=None)
station.wait_for_scans("board", 500)
check_samples(recorded(station))
station.stop()
check_range()
check_overrun()
guest.check_kernel()
