"""Runs the tested mdof. ctest's environment contains the paths of mdof and of the test data."""
import gzip
import json
import os
import pathlib
import resource
import signal
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "text"))
from field_names import unknown_columns, unknown_members  # noqa: E402

MDOF = os.environ["MDOF"]
MAKE_RECORDING = os.environ.get("MDOF_MAKE_RECORDING", "")
DATA = pathlib.Path(os.environ["MDOF_TEST_DATA"])


def notice_lines(document):
    """The notices of a run, a table or another document, one line each, in the format of mdof. The severity begins
    the line, except for doubtful notices."""
    return [("" if n["severity"] == "doubtful" else n["severity"] + ": ") + n["text"] for n in document["notices"]]


def run(*arguments, stdin=None, env=None):
    """Runs mdof and returns (exit code, standard output, standard error). Fails if mdof help fields does not
    explain each column of a CSV and each member of a JSON document."""
    done = subprocess.run([MDOF, *map(str, arguments)], input=stdin, capture_output=True,
                          timeout=600, env={**os.environ, **(env or {})})
    out = done.stdout.decode()
    if done.returncode == 0 and "--json" not in arguments and "--help" not in arguments and (
            "--csv" in arguments or arguments[:1] == ("solve",)):
        unknown = unknown_columns(MDOF, out)
        assert not unknown, f"columns without a row in schema/field/names: {unknown}"
    if done.returncode == 0 and "--json" in arguments:
        unknown = unknown_members(MDOF, json.loads(out))
        assert not unknown, f"members without a row in schema/field/names: {unknown}"
    return done.returncode, out, done.stderr.decode()


def run_on_full_disk(*arguments, free_bytes):
    """Like run(), but no file can become larger than this size. SQLite needs 32 KiB in addition to a database."""
    def limit():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (free_bytes, free_bytes))

    done = subprocess.run([MDOF, *map(str, arguments)], capture_output=True, timeout=600, preexec_fn=limit)
    return done.returncode, done.stdout.decode(), done.stderr.decode()


def run_json(*arguments):
    """Runs a command that must succeed. Returns its only JSON document."""
    code, out, err = run(*arguments, "--json")
    assert code == 0, f"mdof {arguments}: exit {code}: {err}"
    return json.loads(out)


def read_text(path):
    path = pathlib.Path(path)
    with (gzip.open(path, "rt") if path.suffix == ".gz" else open(path)) as file:
        return file.read()


def read_csv(text):
    """The columns of numbers in a CSV, by name."""
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    rows = [[float(field) for field in line.split(",")] for line in lines[1:]]
    return {name: [row[i] for row in rows] for i, name in enumerate(lines[0].split(","))}
