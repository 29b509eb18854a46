"""systemd as the first process, mdofd installed like its package, and separate users: the history names them, their
groups decide who may activate a table and who may use the connection reserved for the CNC control, each user has a
limit of connections, and the group mdof can read the results. The unit with PrivateUsers=yes is the control test: it
fails."""
# pid 1: systemd
# limit: 900 s
import json
import os
import subprocess
import sys

import guest
from mdofd import RIG, RpcError, simulator, write_log

CONFIG = "/etc/mdof/mdofd.toml"
SOCKET = "/run/mdof/mdof.sock"
DATABASE = "/var/lib/mdof/mdof.db"
UID = {"approver": 2001, "cnc": 2002, "plain": 2003, "other": 2004, "stranger": 2005}
GROUPS = {"metrology": (2101, ["approver"]), "cnc_machine": (2102, ["cnc"])}
FORBIDDEN = -32003

# One call, or connections that are held until the standard input ends; the replies are JSON.
CLIENT = """
import json, sys
from mdofd import Client, RpcError
words = json.loads(sys.argv[1])
def call(client, method, params):
    try:
        return client.call(method, **params)
    except RpcError as error:
        return {"code": error.code, "message": str(error)}
    except OSError as error:
        return {"code": 0, "message": str(error)}
if "hold" in words:
    clients, served = [], 0
    for i in range(words["hold"]):
        clients.append(Client(words["socket"], timeout_s=60))
        served += "code" not in call(clients[-1], "server.info", {})
    print(json.dumps(served), flush=True)
    sys.stdin.read()
else:
    print(json.dumps(call(Client(words["socket"], timeout_s=60), words["method"], words["params"])))
"""


def command(user, *words):
    return ["setpriv", "--reuid", str(UID[user]), "--regid", str(UID[user]), "--init-groups", *words]


def client(user, **words):
    return command(user, "python3", "-c", CLIENT, json.dumps({"socket": SOCKET, **words}))


def call(user, method, **params):
    done = subprocess.run(client(user, method=method, params=params), capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def hold(user, connections):
    """Returns the process that holds the connections, and how many connections mdofd served."""
    process = subprocess.Popen(client(user, hold=connections), stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    return process, json.loads(process.stdout.readline())


def let_go(processes):
    for process in processes:
        process.stdin.close()
        assert process.wait(60) == 0


def add_users():
    guest.run("systemd-sysusers")
    with open("/etc/passwd", "a") as passwd, open("/etc/group", "a") as group:
        for name, uid in UID.items():
            passwd.write(f"{name}:x:{uid}:{uid}::/:/bin/sh\n")
            group.write(f"{name}:x:{uid}:\n")
        for name, (gid, members) in GROUPS.items():
            group.write(f"{name}:x:{gid}:{','.join(members)}\n")
    with open("/etc/group") as f:
        lines = f.read().splitlines()
    members = ",".join(name for name in UID if name != "stranger")
    with open("/etc/group", "w") as f:
        f.writelines((line + members if line.startswith("mdof:") else line) + "\n" for line in lines)


def start():
    guest.run("systemctl", "daemon-reload")
    guest.run("systemctl", "stop", "mdofd.service", "mdofd.socket")
    guest.run("systemctl", "start", "mdofd.socket")
    guest.run("systemctl", "start", "mdofd.service")


def make_table():
    with open(RIG["X"]) as rig:
        text = rig.read()
    root = guest.Client(SOCKET, timeout_s=120)
    run = root.call("run.replay", path="/etc/mdof/log.csv", rig=text)["run"]
    root.socket.close()
    return run, call("plain", "compensation.build", runs=[run])["table"]


def activated_by(user, table):
    """Returns the user in the history; None: the activation was refused."""
    answer = call(user, "compensation.activate", table=table, despite_warnings=True)
    if "code" in answer:
        assert answer["code"] == FORBIDDEN, answer
        return None
    return call(user, "history.list", count=1)["history"][0]["uid"]


def check_history(run):
    last = call("plain", "history.list", count=2)["history"]
    assert [d["deed"] for d in last][0] == "compensation.build", last
    assert (last[0]["uid"], last[0]["gid"]) == (UID["plain"], UID["plain"]), last
    assert last[1]["uid"] == 0, last
    text = guest.run(*command("other", "mdof", "history", "--db", DATABASE))
    assert "plain" in text, text
    guest.figure("history: the run is root's, the table that of the user who built it, by uid and name")


def check_approvers(table):
    assert activated_by("plain", table) is None
    assert activated_by("cnc", table) is None
    assert activated_by("approver", table) == UID["approver"]
    guest.figure("approve_group: its member activates a table, others are refused")


def check_connections():
    holders = []
    plain, served = hold("plain", 40)
    holders.append(plain)
    assert served == 32, served
    other, served_other = hold("other", 31)
    holders.append(other)
    assert served_other == 31, served_other
    # 63 of 64 connections are in use: the last one is reserved for the control.
    assert "code" in call("approver", "server.info"), "the connection of cnc_group went to another"
    assert "code" not in call("cnc", "server.info"), "cnc_group is turned away"
    let_go(holders)
    guest.wait_until(lambda: "code" not in call("plain", "server.info"), "connections are free again")
    guest.figure("connections: 32 of 40 of one user, 31 of another beside them, the last one is cnc_group's")


def check_files(run):
    for words in (["show", str(run)], ["verify"]):
        guest.run(*command("other", "mdof", *words, "--db", DATABASE))
    started = call("plain", "run.start", axis="X")["run"]
    guest.wait_until(lambda: call("plain", "run.points", run=started).get("total", 0), "points", timeout_s=60)
    call("plain", "run.stop", run=started)
    recording = call("plain", "run.get", run=started)["recording"]["path"]
    recording = os.path.join("/var/lib/mdof", recording)
    for file in (DATABASE, recording):
        guest.run(*command("other", "test", "-r", file))
        assert subprocess.run(command("other", "test", "-w", file)).returncode == 1, file
        assert subprocess.run(command("stranger", "test", "-r", file)).returncode == 1, file
    assert subprocess.run(client("stranger", method="server.info", params={}), capture_output=True).returncode != 0
    guest.run(*command("other", "mdof", "export", recording, "--csv", "/dev/null"))
    guest.figure("files: the group mdof reads database and recording, others do not, and nobody but mdof writes")


add_users()
os.makedirs("/etc/mdof", exist_ok=True)
write_log("/etc/mdof/log.csv")
with open(CONFIG, "w") as f:
    # No limit for idle clients, because the clock of an emulated machine can be far ahead of its connections.
    f.write('[rpc]\napprove_group = "metrology"\ncnc_group = "cnc_machine"\nidle_timeout_s = 0\n' + simulator("X"))
start()
run, table = make_table()
check_history(run)
check_approvers(table)
check_connections()
check_files(run)

os.makedirs("/etc/systemd/system/mdofd.service.d", exist_ok=True)
with open("/etc/systemd/system/mdofd.service.d/private.conf", "w") as f:
    f.write("[Service]\nPrivateUsers=yes\n")
start()
assert activated_by("approver", table) is None, "with PrivateUsers=yes groups are not seen"
call("plain", "compensation.build", runs=[run])
assert call("plain", "history.list", count=1)["history"][0]["uid"] == 65534
guest.figure("control: with PrivateUsers=yes the approver is refused and the history says 65534")
guest.run("systemctl", "stop", "mdofd.service")
guest.check_kernel()
