#!/usr/bin/python3
"""Replaces LinuxCNC's screen. A test sends requests over the socket COMMANDS; requests and answers are lines of
JSON."""
import json
import os
import socket
import subprocess
import time

import hal
import linuxcnc

command, state, errors = linuxcnc.command(), linuxcnc.stat(), linuxcnc.error_channel()
component = hal.component("test-display")
component.ready()


def wait_until(done, seconds=60):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        state.poll()
        if done():
            return
        time.sleep(0.005)
    raise TimeoutError("LinuxCNC did not get there")


def do(what, *arguments):
    what(*arguments)
    command.wait_complete(60)


def on():
    do(command.state, linuxcnc.STATE_ESTOP_RESET)
    do(command.state, linuxcnc.STATE_ON)


def off():
    do(command.state, linuxcnc.STATE_OFF)


def manual():
    do(command.mode, linuxcnc.MODE_MANUAL)
    do(command.teleop_enable, 0)


def home():
    manual()
    do(command.home, -1)
    wait_until(lambda: all(state.homed[:state.joints]))


def ask_home():
    manual()
    do(command.home, -1)
    time.sleep(0.3)
    state.poll()
    return list(state.homed[:state.joints])


def unhome():
    manual()
    do(command.unhome, -1)
    wait_until(lambda: not any(state.homed[:state.joints]))


def mdi(text):
    do(command.mode, linuxcnc.MODE_MDI)
    begin(text)
    wait_until(lambda: state.inpos and state.interp_state == linuxcnc.INTERP_IDLE)


def begin(text):
    command.mode(linuxcnc.MODE_MDI)
    command.wait_complete()
    command.mdi(text)


def run(path):
    do(command.mode, linuxcnc.MODE_AUTO)
    command.program_open(path)
    command.auto(linuxcnc.AUTO_RUN, 0)
    time.sleep(0.5)


def idle():
    state.poll()
    return state.interp_state == linuxcnc.INTERP_IDLE and bool(state.inpos)


def stands():
    """Returns joint-pos, pos-in and pos-out of X, Y and Z after all motion has ended."""
    last = None
    while True:
        now = [[hal.get_value(f"mdof-compensation.{pin}-{k}") for k in range(3)] for pin in ("joint-pos", "pos-in", "pos-out")]
        if now == last:
            return now
        last = now
        time.sleep(0.01)


def go(places):
    """Moves to each place and returns the values of the pins there."""
    found = []
    do(command.mode, linuxcnc.MODE_MDI)
    for place in places:
        mdi("G0 " + " ".join(f"{axis}{at:.6f}" for axis, at in zip("XYZ", place)))
        found.append(stands())
    return found


def said():
    texts = []
    while (message := errors.poll()):
        texts.append(message[1])
    return texts


def get(*pins):
    return [hal.get_value(pin) for pin in pins]


def homed():
    state.poll()
    return list(state.homed[:state.joints])


def halcmd(*words):
    subprocess.run(["halcmd", *words], check=True, stdout=subprocess.DEVNULL, timeout=20)


def set_pin(pin, value):
    hal.set_p(pin, value)


asked = socket.socket(socket.AF_UNIX)
asked.connect(os.environ["COMMANDS"])
with asked.makefile("rw") as lines:
    for line in lines:
        name, arguments = json.loads(line)
        if name == "quit":
            break
        try:
            answer = {"result": globals()[name](*arguments)}
        except Exception as why:
            answer = {"error": repr(why)}
        lines.write(json.dumps(answer) + "\n")
        lines.flush()
off()
