#!/usr/bin/python3
"""For each action over the socket or on the command line, the history contains the user, and the uid, gid and pid of
the requesting process. Also checks which users may act.

usage: history_test.py MDOFD MDOF"""
import grp
import json
import os
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from mdofd import RIG, Client, Daemon, RpcError, simulator, write_log  # noqa: E402

MDOFD, MDOF = sys.argv[1:3]
FORBIDDEN, CHANGED = -32003, -32001
ME = {"uid": os.getuid(), "gid": os.getgid(), "pid": os.getpid()}


def mdof(*words):
    process = subprocess.Popen([MDOF, *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    out, err = process.communicate()
    assert process.returncode == 0, err
    return process.pid, out


class History(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)  # must be the last cleanup, after mdofd has ended
        self.log = os.path.join(self.folder.name, "log.csv")
        write_log(self.log)

    def serve(self, config=""):
        daemon = Daemon(MDOFD, os.path.join(self.folder.name, "d"), config + simulator("X"))
        self.addCleanup(lambda: daemon.process.poll() is None and daemon.stop())
        return daemon, daemon.start()

    def table(self, client):
        with open(RIG["X"]) as rig:
            run = client.call("run.replay", path=self.log, rig=rig.read())["run"]
        return client.call("compensation.build", runs=[run])["table"]

    def test_a_client_is_named_with_all_that_it_changes(self):
        daemon, client = self.serve()
        run = client.call("run.start", axis="X")["run"]
        read = client.call("run.stop", run=run, abort=True)["run"]
        history = client.call("run.get", run=read)["history"]
        self.assertEqual([(d["deed"], d["id"]) for d in history], [("run.start", run), ("run.abort", run)])
        for deed in history:
            self.assertEqual({key: deed[key] for key in ME}, ME)
        table = self.table(client)
        client.call("compensation.activate", table=table, despite_warnings=True)
        self.assertIn(f"gid {ME['gid']} pid {ME['pid']}", client.call("compensation.status")["axes"]["X"]["activated_by"])
        client.call("compensation.deactivate", axis="X")
        deeds = client.call("history.list", count=4)["history"]
        self.assertEqual([d["deed"] for d in deeds], ["compensation.deactivate", "compensation.activate", "compensation.build", "run.replay"])
        self.assertTrue(all(d["pid"] == ME["pid"] for d in deeds))
        _, shown = mdof("show", read, "--db", daemon.database)
        self.assertRegex(shown, rf"run {run}: run.abort by uid {ME['uid']} .*pid {ME['pid']}")

    def test_a_table_is_not_replaced_by_one_who_decided_before_another_client_changed_it(self):
        daemon, client = self.serve()
        other = Client(daemon.socket)
        first = self.table(client)
        second = client.call("compensation.build", runs=client.call("compensation.table", table=first)["runs"])["table"]
        shown = client.call("compensation.status")["generation"]
        changed = other.call("compensation.activate", table=first, despite_warnings=True, expected_generation=shown)["generation"]
        with self.assertRaisesRegex(RpcError, f"table {first}") as refusal:
            client.call("compensation.activate", table=second, despite_warnings=True, expected_generation=shown)
        self.assertEqual(refusal.exception.code, CHANGED)
        for words in (("activate", second, "--despite-warnings"), ("deactivate", "--axis", "X")):
            with self.assertRaisesRegex(AssertionError, f"table {first}"):
                mdof("compensation", *words, "--expected-generation", shown, "--db", daemon.database, "--socket", daemon.socket)
        self.assertEqual(client.call("compensation.status")["axes"]["X"]["table"], first)
        daemon.stop()
        listed = json.loads(mdof("compensation", "list", "--json", "--db", daemon.database)[1])
        self.assertEqual(listed["generation"], changed)
        with self.assertRaisesRegex(AssertionError, f"table {first}"):  # without mdofd, mdof writes the database itself
            mdof("compensation", "activate", second, "--despite-warnings", "--expected-generation", shown, "--db", daemon.database)
        mdof("compensation", "activate", second, "--despite-warnings", "--expected-generation", changed, "--db", daemon.database)

    def test_the_command_line_is_named_where_it_writes_itself(self):
        database = os.path.join(self.folder.name, "own.db")
        replayed, _ = mdof("replay", self.log, "--rig", RIG["X"], "--db", database)
        built, _ = mdof("compensation", "build", 1, "--db", database)
        activated, _ = mdof("compensation", "activate", 1, "--despite-warnings", "--db", database)
        _, out = mdof("history", "--json", "--db", database)
        history = json.loads(out)["history"]
        self.assertEqual([(d["deed"], d["pid"]) for d in history],
                         [("compensation.activate", activated), ("compensation.build", built), ("run.replay", replayed)])
        self.assertTrue(all(d["uid"] == ME["uid"] for d in history))
        self.assertIn("compensation.build", mdof("history", "--db", database)[1])

    def test_a_table_is_put_in_force_by_the_group_of_approvers_alone(self):
        mine = set(os.getgroups()) | {os.getgid()}
        other = next((g.gr_name for g in grp.getgrall() if g.gr_gid not in mine), None)
        if other is None:
            self.skipTest("this user is in all groups of the machine")
        daemon, client = self.serve(f'approve_group = "{other}"\n')
        table = self.table(client)  # any user may build a table
        for method, params in (("compensation.activate", {"table": table}), ("compensation.deactivate", {"axis": "X"})):
            with self.assertRaises(RpcError) as refusal:
                client.call(method, **params)
            self.assertEqual(refusal.exception.code, FORBIDDEN)
            self.assertIn(f"reserved for members of the group {other} (approve_group", str(refusal.exception))
        self.assertEqual(client.call("compensation.status")["axes"], {})
        daemon.stop()
        own = grp.getgrgid(os.getgid()).gr_name
        with open(daemon.config) as f:
            config = f.read()
        with open(daemon.config, "w") as f:
            f.write(config.replace(f'"{other}"', f'"{own}"'))
        client = daemon.start()
        client.call("compensation.activate", table=table, despite_warnings=True)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
