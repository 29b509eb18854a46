#!/usr/bin/python3
"""The recordings of live runs that are kept, one for each driver, give the results that they gave then.

usage: kept_recordings_test.py MDOF. They were made by each_device_test.py --keep."""
import glob
import json
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from each_device_test import replayed  # noqa: E402
from mdofd import DATA  # noqa: E402

files = sorted(glob.glob(os.path.join(DATA, "devices", "recordings", "*.mdofrec")))
assert files, "no recordings are kept"
for file in files:
    with open(file.replace(".mdofrec", ".json")) as f:
        expected = json.load(f)
    result = replayed(sys.argv[1], file, expected["targets_mm"])
    assert len(expected["points"]) >= 8, file
    assert result["points"] == expected["points"], f"{file}: the points are others"
    print(f"{os.path.basename(file)}: {len(result['points'])} points to the bit")
