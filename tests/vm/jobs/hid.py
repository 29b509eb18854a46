"""A PoKeys on the kernel's USB (vhci_hcd, usbhid, hidraw), and on its HID layer alone (uhid): `mdof device probe`,
and the live values of mdofd."""
# limit: 300 s
import guest

guest.load("vhci-hcd", "usbhid", "hid-generic", "uhid")
guest.start_udev()


def check(bus, interfaces):
    encoders = guest.Simulate("encoders", guest.POKEYS + f'bus = "{bus}"\n')
    print(encoders.start())
    guest.wait_until(lambda: len(guest.hidraw_nodes()) == interfaces, f"{interfaces} hidraw nodes on {bus}")
    guest.run("udevadm", "settle")
    found = guest.probe(guest.config_file(guest.PROBES_CONFIG + guest.POKEYS_CONFIG), "encoders")
    print(found)
    assert found["error"] is None and found["lost"] == 0, found
    assert "PoKeys57U 12345, firmware 4.2.19" in found["description"], found
    assert found["rate_hz"] > 20, found  # of 100, because the machine is emulated
    assert found["channels"][0]["values"] > 20, found  # late values are suspect
    guest.figure(f"{bus}: {found['rate_hz']:.1f} scans a second of 100, {found['lost']} lost")

    station = guest.Station(guest.PROBES_CONFIG + guest.POKEYS_CONFIG)
    station.wait_for_scans("encoders", 50)
    values = station.watch_targets()
    device = station.device("encoders")
    assert device["state"] == "open" and device["reopened"] == 0, device
    guest.figure(f"{bus}: the axis was seen at each target in {values} live values; {device['scans']} scans, {device['scans_lost']} lost")
    station.stop()
    encoders.kill()
    guest.wait_until(lambda: not guest.hidraw_nodes(), "the nodes of an unplugged device go")


check("usb", 3)
check("uhid", 1)
guest.check_kernel()
