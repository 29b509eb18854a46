"""Prints rows of columns (A_um ... encoder_mm) with constant values, for the driver csv_stream.

usage: still_probes.py COLUMN..."""
import sys
import time

print(",".join(sys.argv[1:]), flush=True)
while True:
    print(",".join("0" for _ in sys.argv[1:]), flush=True)
    time.sleep(0.02)
