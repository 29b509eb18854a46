#!/usr/bin/python3
"""Tests our Modbus client with the server of pymodbus, and our simulated slave with mbpoll. Both tests use TCP and
RTU. Returns 77 (skipped) if these programs are not installed.

usage: peers_test.py MODBUS_PEER
"""
import logging
import re
import shutil
import socket
import subprocess
import sys
import threading
import time

try:
    from pymodbus.datastore import (ModbusSequentialDataBlock, ModbusServerContext,
                                    ModbusSlaveContext)
    from pymodbus.server import StartTcpServer
    from pymodbus.transaction import ModbusRtuFramer, ModbusSocketFramer
except ImportError as error:
    print(f"python3-pymodbus, or what it needs, is not installed: {error}")
    sys.exit(77)
if not shutil.which("mbpoll"):
    print("mbpoll is not installed")
    sys.exit(77)

logging.disable()  # pymodbus logs the end of each connection as an error
PEER = sys.argv[1]
UNIT = 5


def peer(*arguments):
    done = subprocess.run([PEER, *map(str, arguments)], capture_output=True, text=True, timeout=30)
    return done.returncode, done.stdout.split(), done.stderr


def free_port():
    with socket.socket() as s:
        s.bind(("127.0.0.1", 0))
        return s.getsockname()[1]


def serve_pymodbus(framer):
    """Starts a server in a thread, which ends when the program ends. Returns the address of the server."""
    slave = ModbusSlaveContext(
        hr=ModbusSequentialDataBlock(0, [1000 + i for i in range(200)]),
        ir=ModbusSequentialDataBlock(0, [2000 + i for i in range(200)]), zero_mode=True)
    context = ModbusServerContext(slaves={UNIT: slave}, single=False)
    port = free_port()
    threading.Thread(daemon=True, target=StartTcpServer, kwargs={
        "context": context, "framer": framer, "address": ("127.0.0.1", port)}).start()
    for _ in range(200):
        try:
            socket.create_connection(("127.0.0.1", port)).close()
            return f"127.0.0.1:{port}"
        except OSError:
            time.sleep(0.05)
    raise SystemExit("pymodbus does not listen")


def check_client(kind, framer):
    address = serve_pymodbus(framer)
    for count in (1, 2, 7, 125):
        code, words, error = peer("read", kind, address, UNIT, "holding", 20, count)
        assert code == 0, error
        assert words == [str(1020 + i) for i in range(count)], words
        code, words, error = peer("read", kind, address, UNIT, "input", 30, count)
        assert words == [str(2030 + i) for i in range(count)], (words, error)
    code, _, error = peer("write", kind, address, UNIT, 50, 7, 65535, 0)
    assert code == 0, error
    _, words, _ = peer("read", kind, address, UNIT, "holding", 49, 5)
    assert words == ["1049", "7", "65535", "0", "1053"], words
    code, words, error = peer("read", kind, address, UNIT, "holding", 198, 4)
    assert code == 1 and "exception 2, illegal data address" in error, error
    print(f"client against pymodbus, {kind}: ok")


def mbpoll(*arguments):
    done = subprocess.run(["mbpoll", "-0", "-1", "-o", "5", *map(str, arguments)],
                          capture_output=True, text=True, timeout=60)
    return {int(at): value for at, value in re.findall(r"^\[(\d+)\]:\s+(\S+)", done.stdout, re.M)}, \
        done.stdout + done.stderr


class Served:
    """The simulated slave of a profile. `at` is the port or the line of the slave."""

    def __init__(self, profile):
        self.process = subprocess.Popen([PEER, "serve", profile], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, text=True)
        self.at = self.process.stdout.readline().strip()

    def __enter__(self):
        return self.at

    def __exit__(self, *_):
        self.process.stdin.close()
        assert self.process.wait(timeout=30) == 0


def check_slave():
    with Served("adam-6017") as port:
        words, text = mbpoll("-m", "tcp", "-p", port, "-a", 1, "-t", "4", "-r", 0, "-c", 8,
                             "127.0.0.1")
        raw = [int((i + 11) / 20 * 65535 + 0.5) for i in range(8)]
        got = [int(words.get(i, -1)) for i in range(8)]
        assert got == raw, text
        words, text = mbpoll("-m", "tcp", "-p", port, "-t", "4:hex", "-r", 210, "-c", 1, "127.0.0.1")
        assert words == {210: "0x6017"}, text
        words, text = mbpoll("-m", "tcp", "-p", port, "-t", "4", "-r", 300, "-c", 1, "127.0.0.1")
        assert not words and "Illegal data address" in text, text
    with Served("pokeys57e") as port:
        words, text = mbpoll("-m", "tcp", "-p", port, "-t", "4:int", "-r", 700, "-c", 25,
                             "127.0.0.1")
        assert words == {700 + 2 * i: str(i + 1) for i in range(25)}, text
    with Served("lika-smax") as line:
        words, text = mbpoll("-m", "rtu", "-b", 19200, "-P", "even", "-a", 1, "-t", "3", "-r", 0,
                             "-c", 7, line)
        assert words == {0: "0", 1: "1", 2: "0", 3: "0", 4: "0", 5: "0", 6: "0"}, text
    print("mbpoll against the simulated slaves, TCP and RTU: ok")


check_client("tcp", ModbusSocketFramer)
check_client("rtu", ModbusRtuFramer)
check_slave()
