"""A live run of each USB driver: device on the kernel's USB -> mdofd -> correct points, and the same bits from a
replay. The recordings are written to build/vm/out/live; those in tests/data/devices/recordings come from there."""
# limit: 600 s
import argparse
import os

import guest
from device_setups import SETUPS
from each_device_test import check

guest.load("vhci-hcd", "usbhid", "hid-generic")
guest.start_udev()
if not os.path.exists("/dev/pts/ptmx"):  # serial lines
    os.makedirs("/dev/pts", exist_ok=True)
    guest.run("mount", "-t", "devpts", "devpts", "/dev/pts")
programs = argparse.Namespace(mdofd="/usr/bin/mdofd", mdof="mdof", mdof_simulate="mdof-simulate", keep="/out")
for name in (name for name, setup in SETUPS.items() if setup.usb):
    guest.figure(check(programs, name))
guest.check_kernel()
