"""Each USB device is unplugged and plugged in again 50 times while mdofd reads it: mdofd opens it again each time,
quickly, and without a leak. The last part shows that a late node and a leak are detected."""
# limit: 1800 s
import os
import time

import guest

ROUNDS = int(os.environ.get("MDOF_REPLUGS", "50"))
WARM_UP = 20  # in the first dozen rounds, memory grows by up to 2 MiB and then stays constant
MOST_S, MOST_GROWTH_KIB = 1.0, 1024

# For each USB device: its plan, the configuration with additional devices, a function that returns whether its node
# exists.
DEVICES = {
    "encoders": (guest.POKEYS, guest.still_config("A_um", "B_um", "C_um", "D_um", "E_um") + guest.POKEYS_CONFIG,
                 lambda: len(guest.hidraw_nodes()) == 3),
    "u6": (guest.U6, guest.still_config("A_um", "B_um", "C_um") + guest.U6_CONFIG,
           lambda: guest.usb_node("0cd5")),
    "mcc": (guest.MCC, guest.still_config("A_um", "B_um", "C_um", "encoder_mm") + guest.MCC_CONFIG,
            lambda: guest.usb_node("09db")),
}


class Rounds:
    def __init__(self, rounds):
        self.rounds, self.seconds = rounds, []
        self.descriptors, self.resident_KiB = [], []

    def failures(self):
        failed = []
        if len(self.seconds) != self.rounds:
            failed.append(f"reopened {len(self.seconds)} of {self.rounds} times")
        if guest.quantile(self.seconds, 99) > MOST_S:
            failed.append(f"p99 {guest.quantile(self.seconds, 99):.3f} s")
        if self.descriptors[-1] != self.descriptors[0]:
            failed.append(f"descriptors {self.descriptors[0]} -> {self.descriptors[-1]}")
        if self.resident_KiB[-1] - self.resident_KiB[0] > MOST_GROWTH_KIB:
            failed.append(f"memory {self.resident_KiB[-1] - self.resident_KiB[0]:+d} KiB")
        return failed

    def text(self):
        return (f"reopened {len(self.seconds)} of {self.rounds}, first scan after the node p50 "
                f"{guest.quantile(self.seconds, 50):.3f} s, p99 {guest.quantile(self.seconds, 99):.3f} s, "
                f"descriptors {self.descriptors[-1] - self.descriptors[0]:+d}, memory "
                f"{self.resident_KiB[-1] - self.resident_KiB[0]:+d} KiB")


def replug(station, name, plug, there, rounds, late_s=0.0):
    result = Rounds(rounds)
    for i in range(-WARM_UP, rounds):
        guest.wait_until(lambda: station.device(name)["state"] != "open", f"{name} is away")
        time.sleep((0.1, 0.4, 1.0)[i % 3])  # pauses of different lengths between openings
        before = station.device(name)["scans"]
        plug.start()
        guest.wait_until(there, f"nodes of {name}", pause_s=0.01)
        begin = time.monotonic()
        time.sleep(late_s)
        guest.wait_until(lambda: station.device(name)["scans"] > before, f"scans of {name}", pause_s=0.02)
        if i >= 0:
            result.seconds.append(time.monotonic() - begin)
            if result.seconds[-1] > MOST_S:
                print(f"{name}, round {i}: {result.seconds[-1]:.2f} s; last error: {station.device(name)['error']}")
        if i >= 0:
            result.descriptors.append(station.descriptors())
            result.resident_KiB.append(station.resident_KiB())
        plug.kill()
        guest.wait_until(lambda: not there(), f"nodes of {name} go")
    return result


guest.load("vhci-hcd", "usbhid", "hid-generic")
guest.start_udev()
for device, (plan, config, there) in DEVICES.items():
    plug = guest.Simulate(device, plan)
    if not plug.known():
        print(f"SKIPPED: mdof-simulate has no {device} yet")
        continue
    station = guest.Station(config, beside="")
    result = replug(station, device, plug, there, ROUNDS)
    guest.figure(f"{device}: {result.text()}")
    print([round(s, 2) for s in result.seconds], result.resident_KiB)
    assert not result.failures(), result.failures()
    # The control test.
    late = replug(station, device, plug, there, 2, late_s=1.1)
    late.descriptors[-1] += 1
    assert len(late.failures()) == 2, late.failures()
    station.stop()
guest.check_kernel()
