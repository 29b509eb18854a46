"""Starts mdofd in a separate folder with a configuration, and sends requests to it.

Messages of JSON-RPC are lines; notifications are kept apart from replies. In a unittest each result is checked
against its schema from rpc.discover; otherwise (benchmarks, a virtual machine) only the standard library is needed."""
import gzip
import json
import os
import signal
import socket
import subprocess
import sys
import time

DATA = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "data")
RIG = {axis: os.path.join(DATA, "five-probe", f"rig_{axis}.toml") for axis in "XY"}

SIMULATOR = """
[[axis]]
rig = "{rig}"
[axis.device]
driver = "simulator"
rate_hz = {rate_hz}
dwell_s = {dwell_s}
speed_mm_s = 100
acceleration_mm_s2 = 4000
targets_mm = {targets_mm}
repeats = {repeats}
{extra}
"""


def notice_lines(document):
    """The notices of a run, a table or another document, one line each, in the format of mdof. The severity begins
    the line, except for doubtful notices."""
    return [("" if n["severity"] == "doubtful" else n["severity"] + ": ") + n["text"] for n in document["notices"]]


def simulator(axis="X", rate_hz=2000, dwell_s=0.3, targets_mm=(0, 2, 4.1, 6.2), extra="",
              repeats=3):
    return SIMULATOR.format(rig=RIG[axis], rate_hz=rate_hz, dwell_s=dwell_s,
                            targets_mm=list(targets_mm), extra=extra, repeats=repeats)


def write_log(path):
    """Writes a log for a replay. The axis stops for half a second at 0, 1, 2 and 3 mm."""
    with open(path, "w") as log:
        log.write("time_s,encoder_mm,A_um,B_um,C_um,D_um,E_um\n")
        for i in range(2400):
            target, at = divmod(i, 600)
            encoder = target + (0 if at < 500 else (at - 500) / 100)
            log.write(f"{i * 1e-3:.6f},{encoder:.6f},0.1,0.2,0.3,0.4,{0.5 + target / 10}\n")


def recorded_again(log, folder):
    """A log with the same readings one day later. mdof counts readings of one recording only once, so a second
    recording is needed."""
    path, column = os.path.join(folder, "again.csv"), None
    with gzip.open(log, "rt") as first, open(path, "w") as second:
        for line in first:
            if not line.startswith("#"):
                cells = line.rstrip("\n").split(",")
                if column is None:
                    column = cells.index("time_s")
                else:
                    cells[column] = f"{float(cells[column]) + 86400:.6f}"
                line = ",".join(cells) + "\n"
            second.write(line)
    return path


def replay(axis, log):
    return f'\n[[axis]]\nrig = "{RIG[axis]}"\n[axis.device]\ndriver = "replay"\nfile = "{log}"\n'


class RpcError(Exception):
    def __init__(self, error):
        super().__init__(error["message"])
        self.code = error["code"]
        self.data = error.get("data")


class Client:
    schemas = None  # JSON Schemas of the results, from the tested mdofd

    def __init__(self, path, timeout_s=30):
        self.socket = socket.socket(socket.AF_UNIX)
        self.socket.settimeout(timeout_s)
        self.socket.connect(path)
        self.file = self.socket.makefile("rwb")
        self.notes = []
        self.id = 0

    def call(self, method, **params):
        self.id += 1
        request = {"jsonrpc": "2.0", "id": self.id, "method": method, "params": params}
        self.file.write(json.dumps(request).encode() + b"\n")
        self.file.flush()
        while True:
            reply = self.read()
            if reply.get("id") == self.id:
                if "error" in reply:
                    raise RpcError(reply["error"])
                wrong = self.schemas.wrong(method, reply["result"]) if self.schemas else []
                assert not wrong, "a result is not as rpc.discover describes it: " + "\n".join(wrong)
                return reply["result"]
            self.notes.append(reply)

    def read(self):
        line = self.file.readline()
        if not line:
            raise ConnectionError("mdofd closed the connection")
        assert len(line) <= 48 * 1024, "a reply line over 48 KiB"
        return json.loads(line)

    def next_note(self):
        return self.notes.pop(0) if self.notes else self.read()

    def points(self, run):
        points, offset = [], 0
        while True:
            page = self.call("run.points", run=run, offset=offset)
            points += page["points"]
            offset += len(page["points"])
            if offset >= page["total"]:
                return points


class Daemon:
    # `relative`: mdofd works in the folder and uses relative paths, so that it never writes the name of the folder.
    def __init__(self, program, folder, config, durability="full", relative=False):
        self.program, self.folder, self.relative = program, folder, relative
        os.makedirs(folder, exist_ok=True)
        self.socket = os.path.join(folder, "s")
        self.database = os.path.join(folder, "mdof.db")
        self.config = os.path.join(folder, "mdofd.toml")
        where = "" if relative else folder + "/"
        with open(self.config, "w") as f:
            f.write(f'[store]\ndatabase = "{where}mdof.db"\ndurability = "{durability}"\n'
                    f'[rpc]\nsocket = "{where}s"\n' + config)
        self.process = None
        self.arguments, self.environment = [], {}

    def start(self, timeout_s=60):
        """Waits until mdofd has answered. Reason: TSan (LLVM 14) may lose a signal during the first wait of the
        main thread."""
        self.log = open(os.path.join(self.folder, "stderr"), "ab")
        self.process = subprocess.Popen([self.program, *self.arguments, "--config", self.config],
                                        stderr=self.log, stdout=self.log,
                                        cwd=self.folder if self.relative else None,
                                        env={**os.environ, **self.environment})
        end = time.monotonic() + timeout_s
        while True:
            try:
                client = Client(self.socket)
                client.call("server.info")
                if Client.schemas is None and "unittest" in sys.modules and not self.environment:
                    from result_schemas import Schemas
                    Client.schemas = Schemas(client)
                return client
            except OSError:
                if self.process.poll() is not None:
                    raise RuntimeError(open(self.log.name).read())
                if time.monotonic() > end:
                    raise
                time.sleep(0.005)

    def kill(self):
        self.process.send_signal(signal.SIGKILL)
        self.process.wait()

    def stop(self):
        self.process.terminate()
        try:
            code = self.process.wait(20)
        except subprocess.TimeoutExpired:
            self.kill()
            raise
        assert code == 0, f"mdofd ended with {code}: {open(self.log.name).read()[-2000:]}"
