"""systemd as the first process, and mdofd installed like its package: units, user and group, udev rules. mdofd is
active and ready, opens devices without root (USB, Comedi), is restarted by the watchdog, keeps its socket, and gets
its permissions from the rules."""
# pid 1: systemd
# limit: 400 s
import grp
import os
import pwd
import socket
import stat
import time

import guest

CONFIG = "/etc/mdof/mdofd.toml"
SOCKET = "/run/mdof/mdof.sock"


def show(prop):
    return guest.run("systemctl", "show", "-P", prop, "mdofd.service").strip()


def wait_for_scans(device="encoders"):
    """Uses a new client, because the socket exists even while mdofd restarts."""
    client = guest.Client(SOCKET, timeout_s=60)

    def scans():
        return {d["device"]: d for d in client.call("device.list")["devices"]}[device]["scans"]

    before = scans()
    guest.wait_until(lambda: scans() > before + 10, "scans of the service", timeout_s=60)
    client.socket.close()


def node_of_interface(number):
    for node in guest.hidraw_nodes():
        path = os.path.realpath(f"/sys/class/hidraw/{os.path.basename(node)}/device")
        with open(os.path.join(os.path.dirname(path), "bInterfaceNumber")) as f:
            if int(f.read(), 16) == number:
                return node
    raise AssertionError(f"no hidraw node of interface {number}")


def check_rules():
    """The rule gives the group access to the devices of mdof, but not to the keyboard."""
    for number, group, mode in ((1, "mdof", 0o660), (0, "root", 0o600), (2, "root", 0o600)):
        status = os.stat(node_of_interface(number))
        assert grp.getgrgid(status.st_gid).gr_name == group, (number, status)
        assert stat.S_IMODE(status.st_mode) == mode, (number, oct(status.st_mode))
    guest.figure("udev: interface 1 is mdof's, 0660; keyboard and joystick are root's")


def check_user():
    pid = int(show("MainPID"))
    owner = os.stat(f"/proc/{pid}").st_uid
    assert pwd.getpwuid(owner).pw_name == "mdof", owner
    with open(f"/proc/{pid}/status") as f:
        status = dict(line.split(":\t", 1) for line in f if ":\t" in line)
    assert status["CapEff"].strip() == "0" * 16 and status["NoNewPrivs"].strip() == "1", status
    user = guest.run("setpriv", "--reuid", "nobody", "--regid", "nogroup", "--clear-groups", "test", "-r",
                     node_of_interface(1), check=False)
    assert user == "", user
    assert os.system(f"setpriv --reuid nobody --regid nogroup --clear-groups test -r {node_of_interface(1)}") != 0
    assert os.system(f"setpriv --reuid mdof --regid mdof --clear-groups test -w {node_of_interface(1)}") == 0
    guest.figure("the service runs as mdof, without capabilities; nobody else may open the device")


def check_watchdog():
    pid = show("MainPID")
    begin = time.monotonic()
    guest.run("kill", "-STOP", pid)
    # A client that connects meanwhile must wait and is not refused.
    waiting = socket.socket(socket.AF_UNIX)
    waiting.connect(SOCKET)
    guest.wait_until(lambda: show("NRestarts") == "1" and show("ActiveState") == "active", "a restart by the watchdog",
                     timeout_s=90, pause_s=0.2)
    assert show("MainPID") != pid
    waiting.close()
    wait_for_scans()
    guest.figure(f"watchdog: restarted {time.monotonic() - begin:.1f} s after SIGSTOP, samples again")


guest.load("vhci-hcd", "usbhid", "hid-generic", "uhid", "comedi_test")
guest.run("systemd-sysusers")
guest.run("udevadm", "control", "--reload")
encoders = guest.Simulate("encoders", guest.POKEYS)
encoders.start()
probes = guest.Simulate("probes", guest.CAPA)
probes.start()
guest.wait_until(lambda: len(guest.hidraw_nodes()) == 3, "hidraw nodes")
guest.run("udevadm", "settle", "-t", "60")
os.makedirs("/etc/mdof", exist_ok=True)
with open(CONFIG, "w") as f:
    rig = "/etc/mdof/rig_X.toml"
    board = guest.COMEDI_CONFIG.format(rate_hz=100, range_v=10)
    f.write((guest.CAPA_CONFIG + board + guest.POKEYS_CONFIG).replace(guest.RIG, rig))
    with open(guest.RIG) as source, open(rig, "w") as copy:
        copy.write(source.read())
begin = time.monotonic()
guest.run("systemctl", "daemon-reload")
guest.run("systemctl", "start", "mdofd.socket")
guest.run("systemctl", "start", "mdofd.service")
assert show("ActiveState") == "active" and show("SubState") == "running", show("ActiveState")
guest.figure(f"active and ready {time.monotonic() - begin:.1f} s after systemctl start: {show('StatusText')}")
check_rules()
wait_for_scans()
wait_for_scans("board")
guest.figure("the service reads a Comedi board, which is iocard's")
check_user()
# mdofd runs in systemd's unit, with the udev rule. The device is unplugged and plugged in again.
encoders.kill()
guest.wait_until(lambda: not guest.hidraw_nodes(), "hidraw nodes go")
encoders.start()
wait_for_scans()
guest.figure("unplugged and plugged in: the service reads it again")
check_watchdog()
exposure = guest.run("systemd-analyze", "security", "--no-pager", "mdofd.service").splitlines()[-1].strip(" →")
guest.figure(f"systemd-analyze security: {exposure}")
guest.run("systemctl", "stop", "mdofd.service")
assert show("Result") == "success", show("Result")
guest.check_kernel()
