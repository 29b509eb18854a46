"""A serial gadget (dummy_hcd, g_serial) with a Modbus RTU slave at its end, and the driver "modbus" at /dev/ttyACM0;
unplugged and plugged in again."""
# limit: 300 s
import os
import subprocess
import time

import guest

PROFILE = """
name = "counting slave"
protocol = "rtu"
baud = 115200
poll_ms = 20
response_timeout_ms = 400
[[value]]
name = "position"
registers = "holding"
address = 100
type = "u16"
unit = "count"
"""
CONFIG = """
[[axis.device]]
driver = "modbus"
name = "scale"
profile = "{profile}"
port = "/dev/ttyACM0"
channel = [{{ id = "encoder", input = "position", um_per_count = 10 }}]
"""


def crc(frame):
    value = 0xFFFF
    for byte in frame:
        value ^= byte
        for _ in range(8):
            value = value >> 1 ^ (0xA001 if value & 1 else 0)
    return value.to_bytes(2, "little")


def slave():
    """A slave whose holding register n of unit 1 always contains n; runs in a separate process."""
    import termios
    import tty
    line = os.open("/dev/ttyGS0", os.O_RDWR | os.O_NOCTTY)
    tty.setraw(line, termios.TCSANOW)
    received = b""
    while True:
        try:
            received += os.read(line, 256)
        except OSError:
            time.sleep(0.05)  # the host has gone
            received = b""
        while len(received) >= 8:
            frame, received = received[:8], received[8:]
            if frame[:2] != b"\x01\x03" or crc(frame[:6]) != frame[6:]:
                received = b""
                break
            first, count = int.from_bytes(frame[2:4], "big"), int.from_bytes(frame[4:6], "big")
            reply = bytes([1, 3, 2 * count]) + b"".join((first + i).to_bytes(2, "big") for i in range(count))
            os.write(line, reply + crc(reply))


def plugged():
    return os.path.exists("/dev/ttyACM0")


def gadget(plug):
    if plug:
        guest.load("g_serial")
    else:
        guest.run("modprobe", "-r", "g_serial")
    guest.wait_until(lambda: plugged() == plug, f"/dev/ttyACM0 {'comes' if plug else 'goes'}")


def serve():
    return subprocess.Popen(["python3", __file__, "slave"])


def main():
    guest.load("dummy_hcd", "cdc-acm")
    guest.start_udev()
    gadget(True)
    peer = serve()
    profile = os.path.join(guest.FOLDER, "slave.toml")
    os.makedirs(guest.FOLDER, exist_ok=True)
    with open(profile, "w") as f:
        f.write(PROFILE)
    config = CONFIG.format(profile=profile)
    found = guest.probe(guest.config_file(guest.PROBES_CONFIG + config), "scale")
    print(found)
    assert found["error"] is None and found["scans"] > 20, found
    channel = found["channels"][0]
    assert channel["low"] == channel["high"] == 1000, found  # 100 counts of 10 µm, and never another register
    guest.figure(f"{found['rate_hz']:.1f} polls a second of 50, {found['lost']} lost")

    station = guest.Station(guest.PROBES_CONFIG + config)
    station.wait_for_scans("scale", 50)
    for i in range(5):
        peer.kill()
        peer.wait()
        gadget(False)
        guest.wait_until(lambda: station.device("scale")["state"] != "open", "the device is away")
        assert "/dev/ttyACM0" in station.device("scale")["error"], station.device("scale")
        gadget(True)
        begin = time.monotonic()
        peer = serve()
        station.wait_for_scans("scale", 10)
        guest.figure(f"replug {i + 1}: 10 scans after {time.monotonic() - begin:.2f} s")
    station.stop()
    peer.kill()
    guest.check_kernel()


if __name__ == "__main__":
    import sys
    slave() if sys.argv[1:] == ["slave"] else main()
