"""Prints rows of five probes that stand still, for the driver csv_stream."""
import time

print("A_um,B_um,C_um,D_um,E_um", flush=True)
while True:
    print("0,0,0,0,0", flush=True)
    time.sleep(0.02)
