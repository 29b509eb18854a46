#!/usr/bin/env python3
"""Prints a row of a probe log for each reading, flushed: write read_my_device() anew. This one is an axis that stands
0.4 s at each of four places, forth and back."""
import math
import time

TARGETS_MM = [-1, 0, 2, 4.1, 6.2, 7.2]
STAND_S, MOVE_S = 0.4, 0.1


def position_mm(t_s):
    there_and_back = TARGETS_MM + TARGETS_MM[-2:0:-1]
    step, s = divmod(t_s, STAND_S + MOVE_S)
    here = there_and_back[int(step) % len(there_and_back)]
    following = there_and_back[int(step + 1) % len(there_and_back)]
    share = max(0.0, (s - STAND_S) / MOVE_S)
    return here + (following - here) * (1 - math.cos(math.pi * share)) / 2


def read_my_device():
    """Position in mm; A to E in um, None for one that is missing."""
    t_s = time.monotonic()
    d = position_mm(t_s)
    trembling_um = [0.002 * math.sin(t_s * f) for f in (1511, 1733, 1999, 2251, 2503)]
    straightness_um = 2 * math.sin(2 * math.pi * d / 10)
    return t_s, d, [tremble + (straightness_um if probe in "DE" else 0) for probe, tremble in zip("ABCDE", trembling_um)]


print("time_s,encoder_mm,A_um,B_um,C_um,D_um,E_um", flush=True)
while True:
    t, mm, um = read_my_device()
    print(f"{t:.6f},{mm:.6f}," + ",".join("" if x is None else f"{x:.5f}" for x in um), flush=True)
    time.sleep(0.002)
