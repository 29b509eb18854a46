"""A headless LinuxCNC with the compiled realtime component of tools/linuxcnc, controlled over a socket, and an
mdofd. LinuxCNC refuses root, so it runs as nobody. Its folder of modules is replaced only for this process (a mount
namespace), so that nothing is installed."""
import csv
import io
import json
import os
import pathlib
import shutil
import socket
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
FROM = ROOT / "tools/linuxcnc"
MODULES = pathlib.Path("/usr/lib/linuxcnc/modules")
sys.path[:0] = [str(HERE.parent / "tools"), str(HERE.parent / "daemon")]
SKIPPED = 77
PERIOD_S = 1e-3
COLUMNS = [f"{pin}_{axis}" for pin in ("at", "in", "out") for axis in "xyz"]

HAL = """loadrt [KINS]KINEMATICS
loadrt [EMCMOT]EMCMOT servo_period_nsec=[EMCMOT]SERVO_PERIOD num_joints=[KINS]JOINTS
loadrt comp count=[KINS]JOINTS
addf motion-command-handler servo-thread
addf motion-controller servo-thread
net estop iocontrol.0.user-enable-out => iocontrol.0.emc-enable-in
net prepare iocontrol.0.tool-prepare => iocontrol.0.tool-prepared
net change iocontrol.0.tool-change => iocontrol.0.tool-changed
"""
# The drives follow their commands exactly. Their feedback is one period late. The home switches are at -3 mm of the
# drives.
DRIVES = "".join(f"net drive-{k} => sampler.0.pin.{6 + k}\n"
                 f"net mdof-{axis}-position => sampler.0.pin.{k}\nnet mdof-{axis}-command => sampler.0.pin.{3 + k}\n"
                 for k, axis in enumerate("xyz"))
SWITCH = ("net drive-{0} => comp.{0}.in0\nsetp comp.{0}.in1 {1}\nnet switch-{0} comp.{0}.out => joint.{0}.home-sw-in\n"
          "addf comp.{0} servo-thread\n")
# Axis Y has two joints. Their home switches are RACKED_MM apart, so the positions of the two drives differ by this
# length.
GANTRY, RACKED_MM = "XYZY", 0.25
SECOND = "net drive-3 => sampler.0.pin.10\nnet mdof-y2-command => sampler.0.pin.9\n"


def missing():
    """Returns the reason why the tests cannot run here, or None if they can."""
    for program in ("linuxcnc", "halcompile"):
        if not shutil.which(program):
            return f"no {program} here (Debian: apt-get install --no-install-recommends linuxcnc-uspace linuxcnc-uspace-dev)"
    if os.geteuid() != 0:
        return "needs root, to give LinuxCNC the compiled component in a mount namespace"
    if subprocess.run(["unshare", "--mount", "true"], capture_output=True).returncode:
        return "no mount namespaces here"
    return None


def skip_where_missing():
    if why := missing():
        print("SKIPPED:", why)
        sys.exit(SKIPPED)


def ini(limits, velocity, acceleration, min_ferror=0.02, inch=False, joints="XYZ"):
    """Returns the ini file. All values are in mm. joints: the axis of each joint; a second joint of an axis has
    the settings of the first."""
    if inch:
        limits, (velocity, acceleration, min_ferror) = [(low / 25.4, high / 25.4) for low, high in limits], [
            x / 25.4 for x in (velocity, acceleration, min_ferror)]
    mm = 1 / 25.4 if inch else 1
    axes = "".join(f"[AXIS_{axis}]\nMIN_LIMIT = {low}\nMAX_LIMIT = {high}\nMAX_VELOCITY = {velocity}\n"
                   f"MAX_ACCELERATION = {acceleration}\n" for axis, (low, high) in zip("XYZ", limits))
    sequence = lambda axis: -1 if joints.count(axis) > 1 else 0  # the joints of an axis with two joints home together
    sections = "".join(f"[JOINT_{k}]\nTYPE = LINEAR\nHOME = 0\nHOME_SEQUENCE = {sequence(axis)}\nHOME_OFFSET = {-3 * mm}\n"
                     f"HOME_SEARCH_VEL = {-20 * mm}\nHOME_LATCH_VEL = {-0.2 * mm}\nFERROR = {0.5 * mm}\nMIN_FERROR = {min_ferror}\n"
                     f"MIN_LIMIT = {low}\nMAX_LIMIT = {high}\nMAX_VELOCITY = {velocity}\nMAX_ACCELERATION = {acceleration}\n"
                     for k, axis in enumerate(joints) for low, high in [limits["XYZ".index(axis)]])
    return f"""[EMC]
VERSION = 1.1
MACHINE = live
[DISPLAY]
DISPLAY = ./display.py
[TASK]
TASK = milltask
CYCLE_TIME = 0.001
[RS274NGC]
PARAMETER_FILE = parameters.var
[EMCIO]
EMCIO = io
CYCLE_TIME = 0.1
TOOL_TABLE = tools.tbl
[EMCMOT]
EMCMOT = motmod
COMM_TIMEOUT = 4.0
SERVO_PERIOD = 1000000
[HAL]
HALFILE = machine.hal
HALFILE = mdof_compensation.hal
HALFILE = drives.hal
[TRAJ]
COORDINATES = {joints}
LINEAR_UNITS = {"inch" if inch else "mm"}
ANGULAR_UNITS = degree
MAX_LINEAR_VELOCITY = {velocity * 2}
DEFAULT_LINEAR_VELOCITY = {velocity}
NO_FORCE_HOMING = 0
[KINS]
JOINTS = {len(joints)}
KINEMATICS = trivkins coordinates={joints}{" kinstype=BOTH" if len(joints) > 3 else ""}
{axes}{sections}"""


class LinuxCnc:
    def __init__(self, folder, text, mdofd, plant=("", ""), words=()):
        """plant: (text, replacement), an error in the component that the test must detect. words: options of mdof
        compensation linuxcnc."""
        self.folder = folder
        folder.mkdir()
        count = text.count("[JOINT_")
        drives = DRIVES + (SECOND if count > 3 else "") + "".join(
            SWITCH.format(k, f"[JOINT_{k}]HOME_OFFSET" if k < 3 else -3 + RACKED_MM) for k in range(count))
        hal = (HAL + f"loadrt sampler depth=20000 cfg={'f' * (11 if count > 3 else 9)}\n"
               + "".join(f"net drive-{k} joint.{k}.motor-pos-cmd => joint.{k}.motor-pos-fb\n" for k in range(count)))
        for name, content in (("machine.ini", text), ("machine.hal", hal),
                              ("drives.hal", drives + "addf sampler.0 servo-thread\n"), ("tools.tbl", "")):
            (folder / name).write_text(content)
        mdofd.mdof("compensation", "linuxcnc", "--ini", folder / "machine.ini", "--out", folder, "--margin-mm", 0.15, *words)
        shutil.copy(HERE / "display.py", folder)
        component = (FROM / "mdof_compensation.comp").read_text()
        if plant[0] not in component:
            raise ValueError(f"{plant[0]} is not in the component")
        (folder / "mdof_compensation.comp").write_text(component.replace(*plant) if plant[0] else component)
        shutil.copy(FROM / "mdof_compensation.h", folder)
        subprocess.run(["halcompile", "--compile", "mdof_compensation.comp"], cwd=folder, check=True, capture_output=True)
        shutil.copytree(MODULES, folder / "modules")
        shutil.copy(folder / "mdof_compensation.so", folder / "modules")
        subprocess.run(["chown", "-R", "nobody", folder], check=True)
        listening = socket.socket(socket.AF_UNIX)
        listening.bind(str(folder / "commands"))
        shutil.chown(folder / "commands", "nobody")
        listening.listen()
        listening.settimeout(60)
        self.log = open(folder / "log", "w")
        self.environment = {"HOME": str(folder), "PATH": f"/usr/bin:/bin:{FROM}", "LANG": "C", "COMMANDS": str(folder / "commands"),
                            "RTAPI_FIFO_PATH": str(folder / "fifo")}
        self.process = subprocess.Popen(self.as_nobody("linuxcnc", "-r", "machine.ini"), cwd=folder, stdout=self.log,
                                        stderr=subprocess.STDOUT, env=self.environment)
        try:
            connection, _ = listening.accept()
        except TimeoutError:
            self.process.terminate()
            raise RuntimeError(f"LinuxCNC did not start:\n{self.words()}") from None
        connection.settimeout(120)
        self.lines = connection.makefile("rw")
        self.samples = open(folder / "samples", "w")
        self.sampler = subprocess.Popen(self.as_nobody("halsampler", "-t"), cwd=folder, stdout=self.samples, env=self.environment)

    def as_nobody(self, *command):
        modules = self.folder / "modules"
        return ["unshare", "--mount", "sh", "-c", 'mount --bind "$0" "$1" && shift && exec setpriv --reuid=nobody '
                '--regid=nogroup --clear-groups "$@"', str(modules), str(MODULES), *command]

    def words(self):
        return (self.folder / "log").read_text()[-4000:]

    def ask(self, name, *arguments):
        try:
            self.lines.write(json.dumps([name, arguments]) + "\n")
            self.lines.flush()
            answer = json.loads(self.lines.readline())
        except (OSError, ValueError) as why:
            raise RuntimeError(f"LinuxCNC is gone ({why}):\n{self.words()}") from None
        if "error" in answer:
            raise RuntimeError(f"{name}{arguments}: {answer['error']}; {self.said()}\n{self.words()}")
        return answer["result"]

    def __getattr__(self, name):
        return lambda *arguments: self.ask(name, *arguments)

    def pin(self, name):
        return self.ask("get", f"mdof-compensation.{name}")[0]

    def wait_for(self, pin, value, seconds=30):
        end = time.monotonic() + seconds
        while (now := self.pin(pin)) != value:
            if time.monotonic() > end:
                raise RuntimeError(f"{pin} is {now}, not {value}, after {seconds} s\n{self.words()}")
            time.sleep(0.02)

    def sample(self):
        """Starts to record the pins in each servo period."""
        time.sleep(0.3)
        self.from_byte = (self.folder / "samples").stat().st_size

    def sampled(self):
        """Returns the rows since sample(): [number, at x y z, in x y z, out x y z]. With a gantry, `in` and `out`
        of the second joint follow."""
        time.sleep(0.3)
        with open(self.folder / "samples") as samples:
            samples.seek(self.from_byte)
            lines = samples.read().splitlines()[1:-1]
        if any(line.startswith("overrun") for line in lines):
            raise RuntimeError("samples were lost")
        return [[float(field) for field in line.split()] for line in lines]

    def end(self):
        self.sampler.terminate()
        self.sampler.wait()
        try:
            self.lines.write('["quit", []]\n')
            self.lines.flush()
            self.process.wait(30)
        except (OSError, subprocess.TimeoutExpired):
            self.process.terminate()
            self.process.wait(30)


class Grid:
    """A table from `mdof compensation show --csv`. Between its nodes it is linear. Unit: mm."""

    def __init__(self, text):
        rows = list(csv.DictReader(line for line in io.StringIO(text) if not line.startswith("#")))
        self.axes = [sorted({float(r[f"{axis}_mm"]) for r in rows}) for axis in "XYZ"]
        self.at = {tuple(float(r[f"{axis}_mm"]) for axis in "XYZ"): [float(r[f"correction_{k}_um"]) / 1000 for k in "XYZ"] for r in rows}

    def correction(self, place):
        corners = [((), 1.0)]
        for grid, x in zip(self.axes, place):
            if len(grid) == 1:
                corners = [(at + (grid[0],), w) for at, w in corners]
                continue
            i = max(k for k, v in enumerate(grid[:-1]) if v <= x or k == 0)
            p = min(1.0, max(0.0, (x - grid[i]) / (grid[i + 1] - grid[i])))
            corners = [(at + (grid[i + a],), w * (p if a else 1 - p)) for at, w in corners for a in (0, 1)]
        return [sum(w * self.at[at][k] for at, w in corners if w) for k in range(3)]


class Mdofd:
    """An mdofd whose socket LinuxCNC's user may use. It has the tables of its own database."""

    def __init__(self, folder):
        from mdofd import Daemon, simulator
        self.folder = folder
        self.daemon = Daemon(os.environ["MDOFD"], str(folder), simulator())
        self.tables = 0
        self.start()

    def start(self):
        if self.daemon.process and self.daemon.process.poll() is None:
            return
        self.client = self.daemon.start()
        shutil.chown(self.daemon.socket, "nobody")

    def mdof(self, *words):
        from mdof_runner import run
        database = [] if words[1] == "linuxcnc" else ["--db", self.daemon.database]
        code, out, err = run(*words, *database, "--socket", self.daemon.socket)
        if code:
            raise RuntimeError(f"mdof {words}: {code}: {err}")
        return out

    def build(self, machine, *words):
        built = json.loads(self.mdof("compensation", "build", "--machine", machine, *words, "--json"))
        return built["table"]

    def grid(self, table):
        from mdof_runner import run
        code, out, err = run("compensation", "show", table, "--csv", "--db", self.daemon.database)
        assert code == 0, err
        return Grid(out)

    def activate(self, table, *words):
        return json.loads(self.mdof("compensation", "activate", table, *words, "--json"))["generation"]

    def take(self, database, table):
        """Replaces the database of mdofd and activates a table of the new database. Returns the generation."""
        self.daemon.stop()
        shutil.copy(database, self.daemon.database)
        for more in ("-wal", "-shm"):
            pathlib.Path(self.daemon.database + more).unlink(missing_ok=True)
        self.start()
        return self.activate(table)

    def deactivate(self):
        self.mdof("compensation", "deactivate", "--axis", "volume")


def write_machine(folder, errors, simulated=False, length=320, step=10, chain="w-b-X-Y-Z-t"):
    """Writes MACHINE.toml. The positioning errors are errors(axis, position_mm) in um; all other errors are 0."""
    folder.mkdir()
    text = 'name = "mill"\n' + ("simulated = true\n" if simulated else "") + f'machine = {{chain = "{chain}"}}\n'
    for axis, more in (("X", ""), ("Y", "EC0Y_urad = 0\n"), ("Z", "EA0Z_urad = 0\nEB0Z_urad = 0\n")):
        rows = [[x, errors(axis, x)] for x in range(0, length + 1, step)]
        none = "".join(f"{key} = 0\n" for key in [f"E{a}{axis}_um" for a in "XYZ" if a != axis] + [f"E{r}{axis}_urad" for r in "ABC"])
        text += f'[[axis]]\nid = "{axis}"\nholds_at_mm = [0, 0, 0]\npoint = "moving"\nE{axis}{axis}_um = {rows}\n{none}{more}'
    (folder / "machine.toml").write_text(text)
    return folder / "machine.toml"
