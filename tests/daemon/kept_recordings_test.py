#!/usr/bin/python3
"""A replay of each kept recording gives the original result. There is one recording of a live run for each driver.

usage: kept_recordings_test.py MDOF. each_device_test.py --keep has made the recordings, some of them in format 1,
which did not contain the request for the run. The request was added to their headers later, except for format-1/,
whose replay needs the targets as options."""
import glob
import json
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from each_device_test import replayed  # noqa: E402
from mdofd import DATA  # noqa: E402
from recording_file import checked_hash, header_of  # noqa: E402


def check(file, *options):
    with open(file.replace(".mdofrec", ".json")) as f:
        expected = json.load(f)
    result = replayed(sys.argv[1], file, *options)
    assert result["recording"]["sha256"] == checked_hash(file), file
    assert len(expected["points"]) >= 8, file
    assert len(result["points"]) == len(expected["points"]), f"{file}: there are other points"
    for point, then in zip(result["points"], expected["points"]):
        # u_random, U, k and nu_eff were added in a later version. These rigs declare no uncertainties, so u has not
        # changed.
        assert {key: point[key] for key in then} == then, f"{file}: the points are others"
    print(f"{os.path.basename(file)}: {len(result['points'])} points to the bit")


FOLDER = os.path.join(DATA, "devices", "recordings")
files = sorted(glob.glob(os.path.join(FOLDER, "*.mdofrec")))
assert files, "no recordings are kept"
for file in files:
    assert header_of(file)["format_version"] == "2", file
    check(file)
old = os.path.join(FOLDER, "format-1", "mcc_usb1608fs_plus.mdofrec")
assert header_of(old)["format_version"] == "1", old
with open(old.replace(".mdofrec", ".json")) as f:
    check(old, "--targets-mm", *json.load(f)["targets_mm"])
