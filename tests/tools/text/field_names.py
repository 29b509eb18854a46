"""The names of members and columns that mdof explains. They are the rows of mdof help fields."""
import functools
import os
import re
import subprocess

GROUPS = {"linear": "[XYZ]", "angular": "[ABC]", "axis": "[XYZABC]", "small": "[xyz]", "approach": "(forward|reverse|mean)",
          "probe": "[A-Z][0-9]*", "number": "[0-9][0-9.]*"}


@functools.lru_cache
def rows(mdof):
    """[(name, type, meaning)] in the order in which mdof prints them."""
    text = subprocess.run([mdof, "help", "fields"], capture_output=True, text=True, check=True,
                          env={**os.environ, "COLUMNS": "10000"}).stdout
    return [tuple(re.split(" {2,}", line.strip(), maxsplit=2)) for line in text.split("---\n", 1)[1].splitlines()]


@functools.lru_cache
def patterns(mdof):
    named = [re.split(r"\{(\w+)\}", name) for name, _, _ in rows(mdof)]
    plain = [parts for parts in named if not {"field", "figure"} & set(parts[1::2])]
    before_a_name = [parts[0] for parts in named if parts[1:2] == ["field"]]
    return ([re.compile("".join(GROUPS[p] if i % 2 else re.escape(p) for i, p in enumerate(parts))) for parts in plain],
            before_a_name)


@functools.lru_cache(maxsize=None)
def is_known(mdof, name):
    plain, before_a_name = patterns(mdof)
    return (any(p.fullmatch(name) for p in plain) or
            any(name.startswith(b) and is_known(mdof, name[len(b):]) for b in before_a_name))


def unknown_columns(mdof, csv):
    """Names in the header of a CSV that have no row."""
    head = next((line for line in csv.splitlines() if line and not line.startswith("#")), "")
    return [name for name in head.split(",") if name and not is_known(mdof, name)]


FREE = {"notices", "taken", "not_taken", "options"}  # numbers of a notice and options of an evaluation have no rows
# In these objects, the names are names of probes, errors, inputs or angles.
DATA = {"series", "inputs", "rotation_resolution_deg"}


def names_of(document):
    """The names of all members of a JSON document."""
    if isinstance(document, list):
        return set().union(*map(names_of, document))
    if not isinstance(document, dict):
        return set()
    deeper = (value if name not in DATA or isinstance(value, list) else list(value.values())
              for name, value in document.items() if name not in FREE)
    return set(document).union(*map(names_of, deeper))


def unknown_members(mdof, document):
    """Names of members of a JSON document that have no row."""
    return sorted(name for name in names_of(document) if not is_known(mdof, name))
