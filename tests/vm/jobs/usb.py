"""A LabJack U6 and an MCC USB-1608FS-Plus on the kernel's USB (vhci_hcd, usbfs), read by libusb: `mdof device
probe`, and the live values of mdofd."""
# limit: 400 s
import guest

guest.load("vhci-hcd", "usbhid", "hid-generic")
guest.start_udev()

DEVICES = {
    "u6": (guest.U6, guest.CAPA, guest.CAPA_CONFIG + guest.U6_CONFIG, "0cd5"),
    "mcc": (guest.MCC, guest.CAPA + guest.POKEYS, guest.CAPA_CONFIG + guest.MCC_CONFIG + guest.POKEYS_CONFIG, "09db"),
}
for name, (plan, beside, config, vendor) in DEVICES.items():
    device = guest.Simulate(name, plan)
    if not device.known():
        guest.skip(f"mdof-simulate has no {name} yet")
    device.start()
    guest.wait_until(lambda: guest.usb_node(vendor), f"node of {name}")
    guest.run("udevadm", "settle")
    found = guest.probe(guest.config_file(config), name)
    print(found)
    assert found["error"] is None and found["scans"] > 500, found
    assert 400 < found["rate_hz"] < 600, found  # by the device's own clock, however slow the machine is
    guest.figure(f"{name}: {found['description']}, {found['rate_hz']:.1f} scans a second, {found['lost']} lost")
    station = guest.Station(config, beside)
    station.wait_for_scans(name, 500)
    values = station.watch_targets(from_zero=name != "u6")
    state = station.device(name)
    assert state["state"] == "open" and state["reopened"] == 0, state
    guest.figure(f"{name}: the axis was seen at each target in {values} live values; {state['scans']} scans, "
                 f"{state['scans_lost']} lost")
    station.stop()
    device.kill()
    guest.wait_until(lambda: not guest.usb_node(vendor), f"the node of {name} goes")
guest.check_kernel()
