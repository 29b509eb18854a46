#!/usr/bin/python3
"""Replaces LinuxCNC's screen. It switches LinuxCNC on, homes, moves to each place and records the commands of all
joints and motors. Environment variables: WAY contains the places as JSON, in mm, the same for the three axes.
SEEN is the file for the result, a JSON list."""
import json
import os
import time

import hal
import linuxcnc

command, state, errors = linuxcnc.command(), linuxcnc.stat(), linuxcnc.error_channel()
component = hal.component("places-seen")
component.ready()


def wait_until(done, seconds=30):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        state.poll()
        if done():
            return
        time.sleep(0.01)
    raise SystemExit("LinuxCNC did not get there")


def said():
    texts = []
    while (message := errors.poll()):
        texts.append(message[1])
    return texts


def joints():
    return [{"command_mm": hal.get_value(f"joint.{j}.pos-cmd"), "motor_mm": hal.get_value(f"joint.{j}.motor-pos-cmd")}
            for j in range(3)]


def do(what, *arguments):
    what(*arguments)
    command.wait_complete(30)


time.sleep(1)
seen = [{"said": said()}]
do(command.state, linuxcnc.STATE_ESTOP_RESET)
do(command.state, linuxcnc.STATE_ON)
do(command.mode, linuxcnc.MODE_MANUAL)
do(command.home, -1)
wait_until(lambda: state.homed[:3] == (1, 1, 1))
do(command.mode, linuxcnc.MODE_MDI)
do(command.mdi, "G21 G90 G64")
for place in json.loads(os.environ["WAY"]):
    do(command.mdi, f"G0 X{place:.6f} Y{place:.6f} Z{place:.6f}")
    wait_until(lambda: state.inpos and state.interp_state == linuxcnc.INTERP_IDLE)
    time.sleep(0.25)  # the velocity of the correction is limited, so it follows later
    seen.append({"place_mm": place, "joints": joints(), "said": said()})
do(command.state, linuxcnc.STATE_OFF)
with open(os.environ["SEEN"], "w") as file:
    json.dump(seen, file)
