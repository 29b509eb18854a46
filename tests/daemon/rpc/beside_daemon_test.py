#!/usr/bin/python3
"""Every command of mdof works while mdofd runs and holds the database; commands that write ask mdofd to write. The
documents are the same as for a database without a daemon, apart from times and paths. A command that this test
does not know makes it fail. One exception, which the command states: a study is stored in a separate database.

usage: beside_daemon_test.py MDOFD MDOF"""
import gzip
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from mdofd import DATA, RIG, Daemon, simulator  # noqa: E402

MDOFD, MDOF = sys.argv[1:3]
ROOT = os.path.join(DATA, "..", "..")
LOG = {axis: os.path.join(DATA, "five-probe", f"log_{axis}.csv.gz") for axis in "XY"}
BAD_INPUT, IN_USE = 3, 4
SCAN = '[scan]\nprobe = "F"\nposition_mm = [0, 0, 0]\nmeasures = "+Z"\ncentre_mm = 0\n'
# The commands run in this order in one database. WRITES makes the data that READS shows. "@" is the folder. Runs: 1
# and 4 measure X; 2 measures Y; 3 is from a laser; 5 and 6 are scans.
WRITES = [("replay", LOG["X"], "--rig", RIG["X"]), ("replay", LOG["Y"], "--rig", RIG["Y"]),
          ("import", "@/laser.csv", "--axis", "X", "--u-um", "0.3", "--sense", "body", "--travel", "-", "--note", "laser"),
          ("replay", "@/again.csv", "--rig", RIG["X"], "--settle-s", "0.12", "--note", "again"),
          ("replay", "@/scan.csv", "--rig", "@/scan.toml"), ("squareness", "1", "2"),
          ("compensation", "build", "1"), ("compensation", "build", "3"),
          ("compensation", "build", "--machine", "@/machine.toml", "--plane", "XY", "--step-mm", "10", "--incomplete"),
          ("compensation", "activate", "1"), ("compensation", "deactivate", "--axis", "X"), ("compensation", "activate", "1"),
          ("replay", "@/scan_2.csv", "--rig", "@/scan.toml")]
READS = [("runs",), ("show", "1"), ("show", "3"), ("show", "1", "--figures"), ("parallelism", "1", "4"), ("compare", "1", "4"),
         ("iso230-2", "--run", "1"), ("trend", "--axis", "X"), ("budget", "1"), ("budget", "1", "2"),
         ("compensation", "show", "1"), ("compensation", "list"), ("machine", "error", "@/machine.toml", "--at", "X=10,Y=5"),
         ("machine", "map", "@/machine.toml", "--step-mm", "10"), ("machine", "diagonal", "@/machine.toml"),
         ("machine", "circle", "@/machine.toml", "--radius-mm", "5"), ("machine", "budget", "@/machine.toml", "--at", "X=10"),
         ("part", "@/part.toml"), ("form", "compare", "5", "6"), ("form", "clamp", "5", "6"), ("separate", "reversal", "--surface", "side", "1", "4"),
         ("compensation", "check", "2", "--format", "linuxcnc", "--unverified-sign"),
         ("verify",), ("history",), ("studies",)]
FILES = [("plot", "1", "--out", "@/plots"), ("report", "1", "--out", "@/report.html"),
         ("export", "1", "--format", "qif", "--out", "@/run.qif"), ("form", "scan", "5", "--pixel-mm", "5", "--out", "@/map.csv"),
         ("form", "cut", "5", "6", "--out", "@/next.csv"),
         ("form", "path", "5", "--speed-rpm", "300", "--feed-mm-min", "300", "--out", "@/spiral.csv"),
         ("compensation", "export", "1", "--format", "json", "--out", "@/table.json")]
# sensitivity would write checkpoints for hours, and `studies` shows studies. shift and square accept the same runs as
# separate reversal.
NOT_TRIED = {"sensitivity", "separate shift", "separate square"}
MACHINE = """name = "m"
machine = {chain = "w-Y-X-b-t"}
squareness = 1
[[axis]]
id = "X"
holds_at_mm = [0, 0, 0]
point = "standing"
tables = [1]
[[axis]]
id = "Y"
holds_at_mm = [0, 0, 0]
point = "standing"
runs = [2]
"""
PART = """machine = "machine.toml"
path = "path.csv"
[layers]
axes = true
"""
# These members differ if the time, the folder or the writing program differs.
BY_OCCASION = {"started_utc", "ended_utc", "utc", "created_utc", "activated_utc", "generation", "pid", "uid", "gid", "user", "database", "recording",
               "path", "file", "bytes", "hash", "link", "head", "chain", "sha256", "table_sha256", "rig_source"}


class BesideDaemon(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = temporary.name
        with open(os.path.join(cls.folder, "laser.csv"), "w") as series:
            series.write("position_mm,deviation_um\n0,1\n5,2\n10,0\n")
        with open(os.path.join(cls.folder, "again.csv"), "w") as log:
            log.write(changed_log(lambda n, row: row[:2] + [f"{float(row[2]) + 1e-3 * (n % 2):.6f}"] + row[3:]))
        for name, height_um in (("scan", "0"), ("scan_2", "1")):
            with open(os.path.join(cls.folder, f"{name}.csv"), "w") as log:
                log.write(changed_log(lambda n, row: row[:2] + [f"{float(row[2]) + 2e-3 * (n % 2):.6f}"] + row[3:] +
                                      [str(n % 360), height_um], ["angle_deg", "F_um"]))
        with open(RIG["X"]) as rig, open(os.path.join(cls.folder, "scan.toml"), "w") as scan:
            scan.write(rig.read() + SCAN)
        for name, text in (("machine.toml", MACHINE), ("part.toml", PART), ("path.csv", "x_mm,y_mm,z_mm\n1,1,0\n9,9,0\n")):
            with open(os.path.join(cls.folder, name), "w") as file:
                file.write(text)
        cls.daemon = Daemon(MDOFD, os.path.join(cls.folder, "d"), simulator())
        cls.daemon.start().socket.close()
        cls.addClassCleanup(cls.daemon.stop)
        cls.held, cls.free = cls.daemon.database, os.path.join(cls.folder, "free.db")
        for words in WRITES:
            for database in (cls.held, cls.free):
                cls.said(database, *words)

    @classmethod
    def said(cls, database, *words):
        words = [word.replace("@", cls.folder) for word in words]
        socket = ["--socket", cls.daemon.socket] if database == cls.held and "--socket" in cls.help_of(words) else []
        done = subprocess.run([MDOF, *words, "--db", database, *socket], capture_output=True, text=True, timeout=60)
        assert done.returncode == 0, (words, done.returncode, done.stderr)
        return done.stdout

    @classmethod
    def help_of(cls, words):
        command = name_of(words).split()
        return subprocess.run([MDOF, *command, "--help"], capture_output=True, text=True, timeout=60).stdout

    def test_what_was_written_is_the_same(self):
        for words in READS:
            with self.subTest(words):
                held, free = (self.document(database, *words) for database in (self.held, self.free))
                self.assertEqual(held, free)
                self.assertTrue(held)

    def document(self, database, *words):
        if "--json" in self.help_of(words):
            return without_occasion(json.loads(self.said(database, *words, "--json")))
        return self.said(database, *words)

    def test_files_are_written(self):
        for words in FILES:
            with self.subTest(words):
                self.said(self.held, *words)
                self.assertTrue(os.path.exists(words[-1].replace("@", self.folder)))

    def test_a_file_that_mdofd_refuses(self):
        for name, text, reason in (("none.csv", "position_mm\n1\n", "deviation_um"),
                                   ("mm.csv", "position_mm,deviation_um\n0,0\n1,2000\n", "check that the values are in um")):
            path = os.path.join(self.folder, name)
            with open(path, "w") as file:
                file.write(text)
            done = subprocess.run([MDOF, "import", path, "--axis", "X", "--db", self.held, "--socket", self.daemon.socket],
                                  capture_output=True, text=True, timeout=60)
            self.assertEqual(done.returncode != 0, True)
            self.assertIn(reason, done.stderr)
            self.assertIn(name, done.stderr)

    # If a file is missing, the messages differ: mdofd opens the file by its absolute path, and the message contains
    # this path.
    def test_a_mistake_has_the_code_and_the_words_that_it_has_without_mdofd(self):
        for words in (("squareness", "2", "1"), ("squareness", "1", "1"), ("squareness", "1", "3"), ("squareness", "1", "99"),
                      ("squareness", "1", "4"), ("compare", "1", "1"), ("parallelism", "1", "1"),
                      ("compensation", "build", "1", "1"), ("compensation", "activate", "99"),
                      ("replay", "@/nowhere.csv", "--rig", RIG["X"]), ("import", "@/nowhere.csv", "--axis", "X")):
            with self.subTest(words):
                held, free = (self.refused(database, *words) for database in (self.held, self.free))
                self.assertEqual(held[0], free[0], held[1])
                self.assertEqual(held[0], BAD_INPUT, held[1])
                if words[0] not in ("replay", "import"):
                    self.assertEqual(held[1], free[1])

    def refused(self, database, *words):
        words = [word.replace("@", self.folder) for word in words]
        socket = ["--socket", self.daemon.socket] if database == self.held and "--socket" in self.help_of(words) else []
        done = subprocess.run([MDOF, *words, "--db", database, *socket], capture_output=True, text=True, timeout=60)
        return done.returncode, done.stderr.replace(database, "DATABASE")

    def test_a_socket_of_another_database_is_refused(self):
        """If mdof accepted this socket, it would activate a table in a database that mdofd does not serve."""
        for words in (("compensation", "activate", "1"), ("compensation", "deactivate", "--axis", "X"),
                      ("compensation", "build", "1"), ("runs",)):
            done = subprocess.run([MDOF, *words, "--db", self.free, "--socket", self.daemon.socket],
                                  capture_output=True, text=True, timeout=60)
            self.assertEqual(done.returncode, BAD_INPUT, done.stderr)
            self.assertIn(f"uses the database {self.held}", done.stderr)
            self.assertIn("--db", done.stderr)

    def test_no_command_is_left_out(self):
        with open(os.path.join(ROOT, "tools", "mdof", "commands", "commands.inc")) as file:
            commands = {name.replace("_", " ") for name in re.findall(r"^COMMAND\((\w+)\)", file.read(), re.M)}
        with_database = {command for command in commands if "--db" in subprocess.run(
            [MDOF, *command.replace("iso230 2", "iso230-2").split(), "--help"], capture_output=True, text=True).stdout}
        tried = {name_of(words).replace("-", " ") for words in WRITES + READS + FILES}
        self.assertEqual(with_database - tried, NOT_TRIED)

    def test_a_study_says_that_it_needs_a_database_of_its_own(self):
        done = subprocess.run([MDOF, "sensitivity", "--preset", "simulation-1", "--trials", "100", "--db", self.held],
                              capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, IN_USE)
        self.assertIn("give another database", done.stderr)


def name_of(words):
    """The name of a command, which has one or two words."""
    return " ".join(words[:2] if words[0] in ("compensation", "machine", "form", "separate") else words[:1])


def changed_log(change, further=()):
    with gzip.open(LOG["X"], "rt") as file:
        lines = file.read().splitlines()
    head = next(n for n, line in enumerate(lines) if not line.startswith("#"))
    rows = [",".join(change(n, line.split(","))) for n, line in enumerate(lines[head + 1:])]
    return "\n".join([*lines[:head], ",".join([lines[head], *further]), *rows]) + "\n"


def without_occasion(document):
    if isinstance(document, list):
        return [without_occasion(part) for part in document]
    if not isinstance(document, dict):
        return document
    if document.get("deed") in ("compensation.activate", "compensation.deactivate"):
        # The id is a generation, which is a time.
        document = {key: value for key, value in document.items() if key != "id"}
    return {key: without_occasion(value) for key, value in document.items() if key not in BY_OCCASION}


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
