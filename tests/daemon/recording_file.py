"""Reads the header and the chain of hashes of a recording. It follows schema/recording/recording.h and uses no
code of mdof."""
import hashlib
import sqlite3

ENTRIES = ["format_version", "software_version", "rig", "devices", "configuration", "started_utc", "simulated"]


def sha256(data):
    return hashlib.sha256(data).hexdigest()


def header_of(path):
    file = sqlite3.connect(f"file:{path}?mode=ro", uri=True)
    try:
        return dict(file.execute("SELECT key, value FROM header"))
    finally:
        file.close()


def header_hash(header):
    keys = ENTRIES + (["request"] if int(header["format_version"]) >= 2 else [])
    fields = [(key.encode(), header[key].encode()) for key in keys]
    return sha256(b"".join(b"%s\n%d\n%s\n" % (key, len(value), value) for key, value in fields))


def checked_hash(path):
    """Checks every hash in the file. Returns the hash of the recording."""
    header = header_of(path)
    before = header_hash(header)
    assert before == header["sha256"], f"{path}: the header"
    file = sqlite3.connect(f"file:{path}?mode=ro", uri=True)
    for *numbers, stored, payload in file.execute("SELECT seq, device, first_ns, last_ns, scans, lost, sha256, payload "
                                                  "FROM chunk ORDER BY seq"):
        before = sha256("".join(f"{x}\n" for x in [before, *numbers]).encode() + payload)
        assert before == stored, f"{path}: chunk {numbers[0]}"
    *numbers, stored = file.execute("SELECT chunks, scans, lost, finished_utc, sha256 FROM seal").fetchone()
    file.close()
    assert sha256("\n".join(map(str, [before, *numbers])).encode()) == stored, f"{path}: the seal"
    return before
