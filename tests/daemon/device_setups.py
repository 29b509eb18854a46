"""Live setups, one for each driver. Each setup has simulated devices of mdof-simulate, a configuration of mdofd,
and the required accuracy of the result.

Each setup has five probes and an encoder at one simulated machine: EYX is a wave of 2 µm with a period of 10 mm, EBX
is a wave of 30 µrad with a period of 8 mm. {NAME} is replaced by the address that mdof-simulate gives to port NAME
("t7 stream": host and port)."""
import math
import os
import subprocess

from mdofd import DATA

MACHINE = """
rig = "{rig}"
[machine]
targets_mm = {targets}
speed_mm_s = {speed_mm_s}
acceleration_mm_s2 = 4000
dwell_s = {dwell_s}
noise_um = 0.002
[[machine.error]]
name = "EYX"
amplitude_um = 2
period_mm = 10
[[machine.error]]
name = "EBX"
amplitude_urad = 30
period_mm = 8
"""


class Setup:
    def __init__(self, rig, plan, devices, straightness_um, angle_urad, measure="", targets=(0, 2, 4.1, 6.2),
                 dwell_s=0.35, speed_mm_s=100, usb=False, comedi=False, position_um=None):
        self.rig = os.path.join(DATA, "devices", rig)
        self.plan, self.devices, self.measure = plan, devices, measure
        self.straightness_um, self.angle_urad = straightness_um, angle_urad
        # Largest distance between a position and its target; None if the positions are not machine positions.
        self.position_um = position_um
        self.usb = usb  # needs the kernel's vhci_hcd and root, so it runs in tests/vm
        self.comedi = comedi  # needs the library comedi_by_rows.cpp instead of comedilib
        self.targets, self.dwell_s, self.speed_mm_s = list(targets), dwell_s, speed_mm_s

    def plan_text(self):
        return MACHINE.format(rig=self.rig, targets=self.targets, dwell_s=self.dwell_s,
                              speed_mm_s=self.speed_mm_s) + self.plan

    def config_text(self, addresses):
        """The configuration. It is in a folder that contains the rig and is the working folder of mdof-simulate
        and mdofd."""
        devices = self.devices
        for name, address in addresses.items():
            host, _, port = address.rpartition(":")
            devices = devices.replace("{%s}" % name, address).replace("{%s port}" % name, port)
        return f'{self.measure}\n[[axis]]\nrig = "{os.path.basename(self.rig)}"\n{devices}'


def channels(**inputs):
    """Returns the text of the channels. Example: channels(A="AIN0", encoder=("DIO0", "um_per_count = 0.01"))"""
    rows = []
    for channel, row in inputs.items():
        row = row if isinstance(row, tuple) else (row,)
        keys = [f'id = "{channel}"', f'input = "{row[0]}"', *row[1:]]
        rows.append("{ " + ", ".join(keys) + " }")
    return "channel = [" + ", ".join(rows) + "]\n"


FAST = "most_counts_per_s = 1e9"  # the simulated counters lose no counts, and the axis may move fast
AINS = {channel: f"AIN{i}" for i, channel in enumerate("ABCDE")}
T7_PLAN = """
[[device]]
name = "t7"
kind = "labjack_t7"
inputs = ["A", "B", "C", "D", "E"]
um_per_count = 0.01
"""
T7 = """
[[axis.device]]
driver = "labjack_t7"
name = "t7"
address = "{t7 command}"
stream_port = {t7 stream port}
rate_hz = 1000
"""

# For the board in comedi_by_rows.cpp: volts = (code · 20 / 65535 - 10 - 0.05) / 1.05, near code 32768.
COMEDI_CALIBRATION = f"""{{
  driver_name => "rows",
  board_name => "rows-of-csv",
  calibrations =>
  [
    {{
      subdevice => 0,
      channels => [],
      ranges => [0],
      arefs => [],
      caldacs => [],
      softcal_to_phys =>
      {{
        coefficients => [{(32768 * 20 / 65535 - 10.05) / 1.05:.17e}, {20 / 65535 / 1.05:.17e}],
        expansion_origin => 32768.0
      }}
    }},
  ]
}}
"""

SETUPS = {
    "capancdt": Setup("rig_X.toml", """
[[device]]
name = "capa-1"
kind = "capancdt"
inputs = ["A", "B"]
clock_ppm = 60
jitter_ms = 1
[[device]]
name = "capa-2"
kind = "capancdt"
inputs = ["", "C"]
clock_ppm = -40
jitter_ms = 1
seed = 2
[[device]]
name = "t7"
kind = "labjack_t7"
inputs = ["D", "E"]
um_per_count = 0.01
""", """
[[axis.device]]
driver = "capancdt"
name = "capa-1"
address = "{capa-1 command}"
data_port = {capa-1 data port}
sample_time_us = 960
""" + channels(A="1", B="2") + """
[[axis.device]]
driver = "capancdt"
name = "capa-2"
address = "{capa-2 command}"
data_port = {capa-2 data port}
sample_time_us = 960
""" + channels(C="2") + T7 + channels(encoder=("DIO0", "um_per_count = 0.01", FAST), D="AIN0", E="AIN1"),
                      straightness_um=0.03, angle_urad=2),
    "labjack_t7": Setup("rig_volts_X.toml", T7_PLAN, T7 + channels(
        encoder=("DIO0", "um_per_count = 0.01", FAST), **AINS), straightness_um=0.03, angle_urad=2),
    # The encoder is a voltage. Half a code of the converter is 0.16 µm.
    "position_in_volts": Setup("rig_position_volts_X.toml", """
[[device]]
name = "t7"
kind = "labjack_t7"
inputs = ["A", "B", "C", "D", "E", "encoder"]
""", T7 + channels(encoder="AIN5", **AINS), straightness_um=0.03, angle_urad=2, position_um=0.2),
    "csv_stream": Setup("rig_X.toml", """
[[device]]
name = "script"
kind = "csv_stream"
inputs = ["encoder", "A", "B", "C", "D", "E"]
rate_hz = 500
""", """
[[axis.device]]
driver = "csv_stream"
name = "script"
source = "tcp://{script rows}"
""", straightness_um=0.01, angle_urad=1),
    "qsb": Setup("rig_volts_X.toml", T7_PLAN + """
[[device]]
name = "scale"
kind = "qsb"
um_per_count = 0.1
""", """
[[axis.device]]
driver = "qsb"
name = "scale"
port = "{scale serial}"
""" + channels(encoder=("count", "um_per_count = 0.1")) + T7 + channels(**AINS), straightness_um=0.03, angle_urad=2),
    "linux_comedi": Setup("rig_volts_X.toml", """
[[device]]
name = "board"
kind = "csv_stream"
inputs = ["A", "B", "C", "D", "E"]
rate_hz = 500
[[device]]
name = "scale"
kind = "qsb"
um_per_count = 0.1
""", """
[[axis.device]]
driver = "linux_comedi"
name = "board"
device = "{board rows}"
rate_hz = 500
""" + channels(**{c: f"CH{i}" for i, c in enumerate("ABCDE")}) + """
[[axis.device]]
driver = "qsb"
name = "scale"
port = "{scale serial}"
""" + channels(encoder=("count", "um_per_count = 0.1")), straightness_um=0.03, angle_urad=2, comedi=True),
    # The scale has 0.1 mm per count. Each amplifier has ten readings per second.
    "modbus": Setup("rig_volts_X.toml", """
[[device]]
name = "adam"
kind = "modbus"
profile = "adam-6017"
inputs = ["A", "B", "C", "D", "E"]
[[device]]
name = "slide"
kind = "modbus"
profile = "lika-smax"
inputs = ["encoder"]
um_per_count = 100
""", """
[[axis.device]]
driver = "modbus"
name = "adam"
profile = "adam-6017"
address = "{adam modbus}"
""" + channels(**{c: f"AI{i}" for i, c in enumerate("ABCDE")}) + """
[[axis.device]]
driver = "modbus"
name = "slide"
profile = "lika-smax"
port = "{slide modbus}"
""" + channels(encoder=("position", "um_per_count = 100")), straightness_um=0.05, angle_urad=3,
        measure="[measure]\nmax_gap_s = 0.5", targets=(10, 12, 14.1, 16.2), dwell_s=1.6, speed_mm_s=20),
    # Capacitance converters with 30 scans per second, and a counter of the kernel with 200 scans per second.
    "linux": Setup("rig_gaps_X.toml", """
[[device]]
name = "counter"
kind = "linux_counter"
sysfs_root = "counter"
um_per_count = 0.05
""" + "".join(f"""
[[device]]
name = "iio{i}"
kind = "linux_iio"
sysfs_root = "iio{i}"
inputs = [{inputs}]
area_mm2 = 5
""" for i, inputs in enumerate(('"A", "B"', '"C", "D"', '"E"'))), """
[[axis.device]]
driver = "linux_counter"
name = "counter"
sysfs_root = "counter"
rate_hz = 200
""" + channels(encoder=("count0", "um_per_count = 0.05")) + "".join(f"""
[[axis.device]]
driver = "linux_iio"
name = "iio{i}"
sysfs_root = "iio{i}"
sampling_hz = 91
rate_hz = 30
""" + channels(**{c: (f"capacitance{k}", "area_mm2 = 5") for k, c in enumerate(inputs)})
                                                                    for i, inputs in enumerate(("AB", "CD", "E"))),
        straightness_um=0.03, angle_urad=3, measure="[measure]\nmax_gap_s = 0.2", dwell_s=0.8, speed_mm_s=20),
    "labjack_u6": Setup("rig_volts_X.toml", """
[[device]]
name = "u6"
kind = "labjack_u6"
inputs = ["A", "B", "C", "D", "E"]
um_per_count = 0.1
""", """
[[axis.device]]
driver = "labjack_u6"
name = "u6"
rate_hz = 100
""" + channels(encoder=("FIO0", "um_per_count = 0.1", FAST), **AINS), straightness_um=0.03, angle_urad=3,
        dwell_s=1, speed_mm_s=20, usb=True),
    "mcc_usb1608fs_plus": Setup("rig_volts_X.toml", """
[[device]]
name = "mcc"
kind = "mcc_usb1608fs_plus"
inputs = ["A", "B", "C", "D", "E"]
[[device]]
name = "scale"
kind = "qsb"
um_per_count = 0.1
""", """
[[axis.device]]
driver = "mcc_usb1608fs_plus"
name = "mcc"
rate_hz = 100
""" + channels(**{c: f"CH{i}" for i, c in enumerate("ABCDE")}) + """
[[axis.device]]
driver = "qsb"
name = "scale"
port = "{scale serial}"
""" + channels(encoder=("count", "um_per_count = 0.1")), straightness_um=0.03, angle_urad=3,
        dwell_s=1, speed_mm_s=20, usb=True),
    "pokeys57u": Setup("rig_volts_X.toml", T7_PLAN + """
[[device]]
name = "encoders"
kind = "pokeys57u"
um_per_count = 0.1
""", """
[[axis.device]]
driver = "pokeys57u"
name = "encoders"
serial = 12345
poll_ms = 10
""" + channels(encoder=("encoder1", "um_per_count = 0.1")) + T7.replace("rate_hz = 1000", "rate_hz = 100") + channels(**AINS),
        straightness_um=0.03, angle_urad=3,
        dwell_s=1, speed_mm_s=20, usb=True),
}


class Simulators:
    """A running mdof-simulate that uses the plan of a setup."""

    def __init__(self, program, setup, folder):
        plan = os.path.join(folder, "devices.toml")
        with open(plan, "w") as f:
            f.write(setup.plan_text())
        self.process = subprocess.Popen([program, plan], stdout=subprocess.PIPE, text=True)
        self.addresses = {}
        while (line := self.process.stdout.readline().strip()) != "ready":
            assert line, "mdof-simulate ended"
            name, address = line.rsplit(" ", 1)
            self.addresses[name] = address

    def kill(self):
        self.process.kill()
        self.process.wait()
        self.process.stdout.close()


def worst_errors(points, zero_mm=0.0):
    """The largest difference between each error at the fixture and its true value. A constant difference is
    ignored. zero_mm: reading of the encoder at 0; it shifts the positions only. The pitch changes EZX, because
    the fixture has a lever arm."""
    def pitch_urad(d):
        return 30 * math.sin(2 * math.pi * d / 8)

    truth = {"EYX_um": lambda d: 2 * math.sin(2 * math.pi * d / 10),
             "EZX_um": lambda d: d * 1e-3 * pitch_urad(d),
             "EAX_urad": lambda d: 0, "EBX_urad": pitch_urad, "ECX_urad": lambda d: 0}
    worst = {}
    for key, wave in truth.items():
        error = [p[key] - wave(p["position_mm"] - zero_mm) for p in points]
        mean = sum(error) / len(error)
        worst[key] = max(abs(e - mean) for e in error)
    return worst
