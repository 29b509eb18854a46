"""Programs that run beside a measuring mdofd in the tests that end it: a second writer (mdof compensation build,
mdof squareness), run.replay and mdof verify of foreign files, and a program that opens and closes the database.

The foreign files are:
- a log
- a database whose rollback journal names a file of mdofd as its super-journal: the -wal of mdofd's database, or the
  current recording. When any program opens the foreign database for writing, SQLite deletes this file of mdofd.
- mdofd's own database, -wal, -shm and recording. If mdofd closed a second descriptor of such a file, the locks on the
  file would be released.

With `naive`, a program opens the foreign database for writing, as any program with SQLite does: acknowledged data must
then be lost."""
import json
import os
import sqlite3
import struct
import subprocess
import tempfile
import threading
import time
from contextlib import closing

from mdofd import DATA, RIG, Client, RpcError, write_log

MAGIC = b"\xd9\xd5\x05\xf9\x20\xa1\x63\xd7"
OWN = ("mdof.db", "mdof.db-wal", "mdof.db-shm")


def half_written():
    """The bytes of a database with an incomplete transaction, and the bytes of its journal."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "made")
        with closing(sqlite3.connect(path, isolation_level=None)) as connection:
            connection.executescript("PRAGMA cache_size = 1; CREATE TABLE t (x); INSERT INTO t VALUES (1); BEGIN; UPDATE t SET x = 2;")
            connection.execute("WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n LIMIT 3000) "
                               "INSERT INTO t SELECT randomblob(100) FROM n")
            return [read_bytes(path + ending) for ending in ("", "-journal")]


def read_bytes(path):
    with open(path, "rb") as file:
        return file.read()


def super_journal(name):
    """The last part of a journal. It names the journal of a transaction over several databases."""
    return struct.pack(">I", 1) + name + struct.pack(">II", len(name), sum(name)) + MAGIC


class Others:
    """The programs that run beside one mdofd. Call prepare() once, and start() and stop() for each start of mdofd."""

    def __init__(self, daemon, mdof, naive=False):
        self.daemon, self.mdof, self.naive = daemon, mdof, naive
        self.folder = os.path.join(daemon.folder, "beside")
        self.tables, self.replays = [], []  # acknowledged data: (time_ns, number)
        self.victim, self.half = False, half_written()
        self.forgotten = [0, 0]
        self.counts = {"refused": 0, "verified": 0, "opened": 0}

    def __str__(self):
        told = ", ".join(f"{n} {what}" for what, n in self.counts.items())
        tables, replays = len(self.tables) + self.forgotten[0], len(self.replays) + self.forgotten[1]
        return f"{tables} tables and {replays} replays (foreign files: {told})"

    def prepare(self):
        os.makedirs(self.folder, exist_ok=True)
        self.log = os.path.join(self.folder, "log.csv")
        write_log(self.log)
        with open(RIG["X"]) as rig:
            self.rig = rig.read()
        self.runs = []
        for axis in "XY":
            log = os.path.join(DATA, "five-probe", f"log_{axis}.csv.gz")
            done = self.command("replay", log, "--rig", RIG[axis], *self.at())
            assert done.returncode == 0, done.stderr
            self.runs.append(json.loads(done.stdout)["run"])

    def at(self):
        return "--db", self.daemon.database, "--socket", self.daemon.socket, "--json"

    def command(self, *words):
        return subprocess.run([self.mdof, *map(str, words)], capture_output=True, text=True)

    def start(self):
        self.over = threading.Event()
        self.threads = [threading.Thread(target=self.repeat, args=(work,)) for work in (self.write, self.replay, self.verify, self.open)]
        for thread in self.threads:
            thread.start()

    def stop(self):
        self.over.set()
        for thread in self.threads:
            thread.join()

    def repeat(self, work):
        while not self.over.is_set():
            try:
                work()
            except (OSError, ValueError, RpcError, sqlite3.Error):
                pass  # the program was killed, or its disk has no power
            self.over.wait(0.02)

    def write(self):
        done = self.command("compensation", "build", self.runs[0], "--partial", *self.at())
        if done.returncode == 0:
            self.tables.append((time.monotonic_ns(), json.loads(done.stdout)["table"]))
        self.command("squareness", *self.runs, *self.at())

    def own_files(self):
        """The files of mdofd, with the newest recording."""
        recordings = os.path.join(self.daemon.folder, "recordings")
        all_of_them = [entry for entry in os.scandir(recordings) if entry.name.endswith(".mdofrec")]
        newest = sorted(all_of_them, key=lambda entry: entry.stat().st_mtime)[-1:]
        return [os.path.join(self.daemon.folder, name) for name in OWN] + [entry.path for entry in newest]

    def replay(self):
        client = Client(self.daemon.socket)
        with closing(client.socket), closing(client.file):
            for path in [self.log, os.path.join(self.folder, "foreign.db"), *self.own_files()]:
                try:
                    run = client.call("run.replay", path=path, rig=self.rig)["run"]
                    self.replays.append((time.monotonic_ns(), run))
                except RpcError:
                    self.counts["refused"] += 1

    def verify(self):
        foreign = os.path.join(self.folder, "foreign.db")
        self.victim = not self.victim
        victim = self.own_files()[-1] if self.victim else self.daemon.database + "-wal"
        for ending, content in (("", self.half[0]), ("-journal", self.half[1] + super_journal(victim.encode()))):
            with open(foreign + ending, "wb") as file:
                file.write(content)
        if self.naive:
            with closing(sqlite3.connect(foreign)) as connection:
                connection.execute("SELECT count(*) FROM t")
        for file in [foreign, *self.own_files()]:
            self.command("verify", "--recording", file)
            self.counts["verified"] += 1
        self.command("verify", "--db", foreign)
        self.command("verify", "--db", self.daemon.database)

    def open(self):
        """Opens the database for writing without mdof, as any other program could do."""
        with closing(sqlite3.connect(self.daemon.database)) as connection:
            connection.execute("SELECT count(*) FROM run").fetchone()
        self.counts["opened"] += 1

    def forget(self):
        """Forgets the lost data, so that each loss counts once."""
        self.forgotten = [self.forgotten[0] + len(self.tables), self.forgotten[1] + len(self.replays)]
        self.tables, self.replays = [], []

    def lost(self, database, until_ns=None):
        """Descriptions of data that were acknowledged before and are missing now."""
        losses = []
        with closing(sqlite3.connect(f"file:{database}?mode=ro", uri=True)) as connection:
            for kind, told in (("compensation_table", self.tables), ("run", self.replays)):
                there = {number for (number,) in connection.execute(f"SELECT id FROM {kind}")}
                gone = sorted({number for at, number in told if until_ns is None or at <= until_ns} - there)
                if gone:
                    losses.append(f"{len(gone)} acknowledged rows of {kind} are lost, first {gone[0]}")
        return losses
