"""Common code of the jobs: modules, simulated devices, the daemon, figures. Runs inside the virtual machine."""
import glob
import json
import os
import resource
import subprocess
import sys
import time

from mdofd import DATA, Client, Daemon  # noqa: F401

RIG = os.path.join(DATA, "devices", "rig_X.toml")
FOLDER = "/tmp/mdof-vm"


def run(*command, check=True):
    done = subprocess.run(command, capture_output=True, text=True)
    if check and done.returncode != 0:
        raise AssertionError(f"{' '.join(command)}: {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def load(*modules):
    for module in modules:
        run("modprobe", module)


def start_udev():
    """For jobs in which systemd is not the first process."""
    os.makedirs("/run/udev", exist_ok=True)
    run("/lib/systemd/systemd-udevd", "--daemon")
    run("udevadm", "trigger")
    run("udevadm", "settle", "-t", "30")


def wait_until(condition, what, timeout_s=30, pause_s=0.01):
    end = time.monotonic() + timeout_s
    while not (value := condition()):
        if time.monotonic() > end:
            raise AssertionError(f"{what}: not within {timeout_s} s")
        time.sleep(pause_s)
    return value


def figure(text):
    print(f"figure: {text}", flush=True)


def check_kernel():
    """Checks that the kernel reported no error."""
    bad = [line for line in run("dmesg").splitlines()
           if any(word in line for word in ("BUG:", "WARNING:", "Oops", "Call Trace"))]
    assert not bad, "\n".join(bad)


class Simulate:
    """mdof-simulate with a plan; killing it unplugs the devices."""

    def __init__(self, name, devices):
        os.makedirs(FOLDER, exist_ok=True)
        self.plan = os.path.join(FOLDER, name + ".toml")
        with open(self.plan, "w") as f:
            f.write(f'rig = "{RIG}"\n[machine]\ntargets_mm = [0, 2, 4.1, 6.2]\nspeed_mm_s = 100\n'
                    f"acceleration_mm_s2 = 4000\ndwell_s = 1\n{devices}")
        self.process = None

    def start(self):
        self.process = subprocess.Popen(["mdof-simulate", self.plan], stdout=subprocess.PIPE, text=True)
        lines = []
        while not lines or lines[-1] != "ready":
            line = self.process.stdout.readline()
            assert line, "mdof-simulate ended"
            lines.append(line.strip())
        return lines[:-1]

    def known(self):
        """Whether mdof-simulate knows these devices."""
        done = subprocess.run(["timeout", "5", "mdof-simulate", self.plan], capture_output=True, text=True)
        return "known kinds" not in done.stderr

    def kill(self):
        self.process.kill()
        self.process.wait()
        self.process.stdout.close()


# Simulated probes on sockets of the guest, in addition to the tested device, and their configuration.
CAPA = """
[[device]]
name = "capa"
kind = "capancdt"
ports = [2301, 2302]
inputs = ["A", "B", "C"]
"""
CAPA_CONFIG = f"""
[[axis]]
rig = "{RIG}"
[[axis.device]]
driver = "capancdt"
name = "capa"
address = "127.0.0.1:2301"
data_port = 2302
sample_time_us = 8000
channel = [{{ id = "A", input = "1" }}, {{ id = "B", input = "2" }}, {{ id = "C", input = "3" }}]
"""
PROBES = CAPA + """
[[device]]
name = "t7"
kind = "labjack_t7"
ports = [2303, 2304]
inputs = ["D", "E"]
"""
PROBES_CONFIG = CAPA_CONFIG + """
[[axis.device]]
driver = "labjack_t7"
name = "t7"
address = "127.0.0.1:2303"
stream_port = 2304
rate_hz = 200
channel = [{ id = "D", input = "AIN0" }, { id = "E", input = "AIN1" }]
"""
POKEYS = """
[[device]]
name = "encoders"
kind = "pokeys57u"
um_per_count = 0.5
"""
POKEYS_CONFIG = """
[[axis.device]]
driver = "pokeys57u"
name = "encoders"
serial = 12345
poll_ms = 10
channel = [{ id = "encoder", input = "encoder1", um_per_count = 0.5 }]
"""


def still_config(*columns):
    """A configuration with columns of csv_stream whose values are constant; they need little processor time."""
    script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "still_probes.py")
    command = json.dumps(["python3", script, *columns])
    return f'[[axis]]\nrig = "{RIG}"\n[[axis.device]]\ndriver = "csv_stream"\nname = "still"\ncommand = {command}\n'


U6 = """
[[device]]
name = "u6"
kind = "labjack_u6"
inputs = ["D", "E"]
um_per_count = 0.5
"""
U6_CONFIG = """
[[axis.device]]
driver = "labjack_u6"
name = "u6"
rate_hz = 500
channel = [{ id = "D", input = "AIN0" }, { id = "E", input = "AIN1" },
           { id = "encoder", input = "FIO0", um_per_count = 0.5, most_counts_per_s = 1e9 }]
"""
MCC = """
[[device]]
name = "mcc"
kind = "mcc_usb1608fs_plus"
inputs = ["D", "E"]
"""
MCC_CONFIG = """
[[axis.device]]
driver = "mcc_usb1608fs_plus"
name = "mcc"
rate_hz = 500
channel = [{ id = "D", input = "CH0" }, { id = "E", input = "CH1" }]
"""
# The kernel's own test board: a sawtooth and a square wave.
COMEDI_CONFIG = """
[[axis.device]]
driver = "linux_comedi"
name = "board"
board = "comedi_test"
rate_hz = {rate_hz}
range_v = {range_v}
channel = [{{ id = "D", input = "CH0" }}, {{ id = "E", input = "CH1" }}]
"""


class Station:
    """mdofd with `config`, and simulated devices in addition to the tested device."""

    def __init__(self, config, beside=PROBES):
        self.probes = beside and Simulate("probes", beside)
        if self.probes:
            self.probes.start()
        self.daemon = Daemon("/usr/bin/mdofd", os.path.join(FOLDER, "daemon"), config)
        self.client = self.daemon.start(timeout_s=60)

    def device(self, name):
        return {d["device"]: d for d in self.client.call("device.list")["devices"]}[name]

    def wait_for_scans(self, name, more=1, timeout_s=30):
        """Waits for this many more scans; returns the time in s."""
        begin, before = time.monotonic(), self.device(name)["scans"]
        wait_until(lambda: self.device(name)["scans"] >= before + more, f"scans of {name}: {self.device(name)}",
                   timeout_s)
        return time.monotonic() - begin

    def descriptors(self):
        return len(os.listdir(f"/proc/{self.daemon.process.pid}/fd"))

    def resident_KiB(self):
        with open(f"/proc/{self.daemon.process.pid}/statm") as f:
            return int(f.read().split()[1]) * resource.getpagesize() // 1024

    def watch_targets(self, from_zero=True, targets_mm=(0, 2, 4.1, 6.2), timeout_s=120):
        """Waits until the axis has stopped at each target, in fresh live values; returns the number of values.
        For a U6, which counts from its position at the start, `from_zero` is false."""
        watcher = Client(self.daemon.socket, timeout_s=timeout_s)
        watcher.call("live.subscribe", interval_ms=100, events=False)
        stood, last, values, end = set(), None, 0, time.monotonic() + timeout_s

        def all_from(zero_mm):
            return all(any(abs(zero_mm + t - s) < 0.002 for s in stood) for t in targets_mm)

        while not any(all_from(zero_mm) for zero_mm in ([0] if from_zero else stood)):
            value = watcher.next_note()["params"]["value"]
            values += 1
            if not value["stale"] and value["encoder_mm"] == last:
                stood.add(last)
            last = value["encoder_mm"]
            assert time.monotonic() < end, f"the axis stood at {stood}: {value}"
        watcher.socket.close()
        return values

    def stop(self):
        self.daemon.stop()
        if self.probes:
            self.probes.kill()


def probe(station_or_config, name):
    """Runs `mdof device probe`, which opens the device itself."""
    done = subprocess.run(["mdof", "device", "probe", name, "--config", station_or_config, "--for-s", "2",
                           "--json"], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    return json.loads(done.stdout)["devices"][0]


def config_file(text):
    os.makedirs(FOLDER, exist_ok=True)
    path = os.path.join(FOLDER, "probe.toml")
    with open(path, "w") as f:
        f.write(f'[store]\ndatabase = "{FOLDER}/probe.db"\n[rpc]\nsocket = "{FOLDER}/probe.sock"\n' + text)
    return path


def quantile(values, q):
    return sorted(values)[max(0, -(-len(values) * q // 100) - 1)]


def skip(why):
    print(why)
    sys.exit(77)


def hidraw_nodes():
    return sorted(glob.glob("/dev/hidraw*"))


def usb_node(vendor):
    """/dev/bus/usb/... of the device with this vendor id."""
    for path in glob.glob("/sys/bus/usb/devices/*/idVendor"):
        try:
            with open(path) as f:
                if f.read().strip() != vendor:
                    continue
            with open(os.path.join(os.path.dirname(path), "uevent")) as f:
                node = "/dev/" + dict(line.strip().split("=", 1) for line in f)["DEVNAME"]
        except OSError:
            continue  # the device has just gone
        return node if os.path.exists(node) else None
    return None
