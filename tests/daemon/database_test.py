#!/usr/bin/python3
"""The database while mdofd uses it: links to the file, other databases, removal of the file, and lists in the
database.

usage: database_test.py MDOFD MDOF"""
import contextlib
import os
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from mdofd import RIG, Client, Daemon, RpcError, notice_lines, simulator, write_log  # noqa: E402

MDOFD, MDOF = sys.argv[1:3]
CONFLICT = 4


def mdof(*words):
    done = subprocess.run([MDOF, *map(str, words)], capture_output=True, text=True)
    return done.returncode, done.stdout, done.stderr


class Database(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.daemon = Daemon(MDOFD, os.path.join(self.folder.name, "d"), simulator("X"))
        self.client = self.daemon.start()
        self.log = os.path.join(self.folder.name, "log.csv")
        write_log(self.log)

    def tearDown(self):
        if self.daemon.process.poll() is None:
            self.daemon.stop()
        self.folder.cleanup()

    def replayed(self, **params):
        with open(RIG["X"]) as rig:
            return self.client.call("run.replay", path=self.log, rig=rig.read(), **params)["run"]

    def table_in_force(self):
        table = self.client.call("compensation.build", runs=[self.replayed()])["table"]
        self.client.call("compensation.activate", despite_warnings=True, table=table)
        return table

    def test_a_run_that_mdofd_stored_has_the_u_of_its_points_for_sql(self):
        data = os.path.join(os.path.dirname(RIG["X"]), "log_X.csv.gz")
        with open(RIG["X"]) as rig:
            run = self.client.call("run.replay", path=os.path.realpath(data), rig=rig.read())["run"]
        page = self.client.call("run.points", run=run)  # the first page
        points = page["points"]
        with contextlib.closing(sqlite3.connect(f"file:{self.daemon.database}?mode=ro", uri=True)) as sql:
            stored = sql.execute("SELECT error, u_um, u_urad, k FROM v_errors WHERE run = ? ORDER BY row", (run,)).fetchall()
        self.assertEqual(len(stored), 5 * page["total"])
        expected = [(key.split("_")[0], u, point["k"][key]) for point in points for key, u in point["u"].items()]
        for (error, u_um, u_urad, k), (name, u, factor) in zip(stored, expected):
            self.assertEqual(error, name)
            self.assertAlmostEqual(u_um if u_urad is None else u_urad, u, delta=1e-12)
            self.assertAlmostEqual(k, factor, delta=1e-12)
        self.assertTrue(points)

    def test_a_command_acts_on_the_database_that_it_names_by_any_link_or_not_at_all(self):
        table = self.table_in_force()
        other = Daemon(MDOFD, os.path.join(self.folder.name, "other"), simulator("X"))
        client = other.start()
        try:
            links = {"symbolic": os.symlink, "hard": os.link}
            for kind, make in links.items():
                link = os.path.join(self.folder.name, kind + ".db")
                make(self.daemon.database, link)
                before = client.call("compensation.status")
                code, _, err = mdof("compensation", "activate", table, "--despite-warnings", "--db", link, "--socket", other.socket)
                self.assertEqual(code, CONFLICT, err)
                self.assertIn("mdofd (process", err)
                self.assertEqual(client.call("compensation.status"), before)
                code, _, err = mdof("replay", self.log, "--rig", RIG["X"], "--db", link, "--socket", other.socket)
                self.assertEqual(code, CONFLICT, err)
            code, out, err = mdof("compensation", "activate", table, "--despite-warnings", "--db",
                                  os.path.join(self.folder.name, "symbolic.db"), "--socket", self.daemon.socket)
            self.assertEqual(code, 0, err)
            self.assertIn("already active", out)
        finally:
            other.stop()

    def lost(self):
        end = time.monotonic() + 1
        while time.monotonic() < end:
            info = self.client.call("server.info")
            if info["storage"] == "lost":
                return info["storage_reason"]
            time.sleep(0.02)
        self.fail("not noticed within a second")

    def refused(self, reason, method, **params):
        with self.assertRaises(RpcError) as refusal:
            self.client.call(method, **params)
        self.assertIn(reason, str(refusal.exception))

    def test_a_database_that_is_deleted_or_replaced_is_noticed_and_nothing_is_stored(self):
        table = self.table_in_force()
        before = self.client.call("compensation.status")
        watcher = Client(self.daemon.socket)
        watcher.call("live.subscribe", interval_ms=60_000)
        aside = self.daemon.database + ".aside"
        for spoil, reason in ((lambda: os.rename(self.daemon.database, aside), "was deleted"),
                              (lambda: shutil.copy(aside, self.daemon.database), "was replaced")):
            spoil()
            self.wait_for_event(watcher, reason)
            self.assertIn(reason, self.lost())
            self.refused(reason, "run.start", axis="X")
            self.refused(reason, "compensation.activate", despite_warnings=True, table=table)
            self.refused(reason, "compensation.deactivate", axis="X")
            self.refused(reason, "compensation.build", runs=[1])
            self.assertEqual(self.client.call("compensation.status"), before)  # the same tables are active
        code, out, _ = mdof("status", "--socket", self.daemon.socket)
        self.assertIn("storage lost", out)
        os.rename(aside, self.daemon.database)  # restores the same file
        self.wait_for_event(watcher, "")
        self.client.call("compensation.deactivate", axis="X")

    def wait_for_event(self, watcher, reason):
        while True:
            event = watcher.next_note()["params"]["value"]
            if event.get("type") == "storage" and reason in event["text"]:
                return

    def acknowledged(self):
        """Makes a run and an active table whose data are only in the -wal file. Returns the rows and the active
        table."""
        run = self.replayed()
        self.client.call("compensation.activate", despite_warnings=True,
                         table=self.client.call("compensation.build", runs=[run])["table"])
        return self.client.points(run), self.client.call("compensation.status")

    def after_a_kill(self):
        self.daemon.kill()
        self.client = self.daemon.start()
        run = self.client.call("run.list")["runs"][0]["run"]
        return self.client.points(run), self.client.call("compensation.status")

    # If mdofd opened a file of its own a second time, closing the second descriptor would release the locks of
    # SQLite. The next program that closes the database would then delete the -wal.
    def test_the_own_files_are_never_opened_a_second_time(self):
        before = self.acknowledged()
        hard, soft = (os.path.join(self.folder.name, name) for name in ("hard", "soft"))
        os.link(self.daemon.database, hard)
        os.symlink(self.daemon.database + "-shm", soft)
        run = self.client.call("run.start", axis="X")["run"]
        recording = self.client.call("run.get", run=run)["recording"]["path"]
        for path in (*(self.daemon.database + end for end in ("", "-wal", "-shm")), hard, soft, recording, recording + "-shm"):
            with open(RIG["X"]) as rig:
                # A link may be rejected because it is a link.
                reason = "" if path == soft else "mdofd is writing this file"
                self.refused(reason, "run.replay", path=path, rig=rig.read())
        os.remove(hard)
        self.client.call("run.stop", run=run, abort=True)
        subprocess.run([sys.executable, "-c", "import sqlite3, sys; c = sqlite3.connect(sys.argv[1]); "
                        "c.execute('SELECT count(*) FROM run').fetchone(); c.close()", self.daemon.database], check=True)
        self.assertEqual(self.client.call("server.info")["storage"], "ok")
        self.daemon.kill()
        self.client = self.daemon.start()
        self.assertEqual(self.client.points(1), before[0])
        self.assertEqual(self.client.call("compensation.status"), before[1])

    def test_a_wal_or_shm_that_is_gone_is_noticed_and_nothing_acknowledged_is_lost(self):
        def replace(path):
            shutil.copy(path, path + ".other")
            os.rename(path + ".other", path)
        spoils = {"-wal was deleted": lambda db: os.remove(db + "-wal"), "-wal was replaced": lambda db: replace(db + "-wal"),
                  "-shm was deleted": lambda db: os.remove(db + "-shm"), "-shm was replaced": lambda db: replace(db + "-shm"),
                  "-shm was truncated": lambda db: os.truncate(db + "-shm", 0)}
        for reason, spoil in spoils.items():
            with self.subTest(reason):
                before = self.acknowledged()
                spoil(self.daemon.database)
                told = self.lost()
                self.assertIn(reason, told)
                self.assertIn("are in the database file", told)
                self.refused(reason, "run.start", axis="X")
                self.refused(reason, "compensation.deactivate", axis="X")
                self.assertEqual(self.client.call("compensation.status"), before[1])
                self.client.call("run.list")
                self.assertEqual(self.after_a_kill(), before)
                self.assertEqual(self.client.call("server.info")["storage"], "ok")

    # Lost data cannot be recovered. But mdofd must report that they are lost.
    def test_what_is_lost_with_a_wal_is_told_and_no_older_table_is_served(self):
        self.acknowledged()
        self.daemon.stop()  # after this, the data are in the database file
        self.client = self.daemon.start()
        status = self.acknowledged()[1]
        self.head_told()
        os.truncate(self.daemon.database + "-wal", 0)
        told = self.lost()
        self.assertIn("-wal was truncated", told)
        self.assertIn("may be missing", told)
        self.daemon.kill()
        self.client = self.daemon.start()
        told = self.lost()
        self.assertIn("mdofd last reported link", told)
        now = self.client.call("compensation.status")
        self.assertEqual(now["axes"], {})
        self.assertEqual(now["generation"], status["generation"])
        code, _, err = mdof("compensation", "show", "--db", self.daemon.database)
        self.assertEqual(code, 3)
        self.assertIn("mdofd last reported link", err)
        self.daemon.stop()
        os.remove(self.daemon.database + ".head")  # the message recommends this
        self.client = self.daemon.start()
        self.assertEqual(self.client.call("server.info")["storage"], "ok")
        self.assertIn("X", self.client.call("compensation.status")["axes"])

    def head_told(self):
        with contextlib.closing(sqlite3.connect(self.daemon.database)) as database:
            last, = database.execute("SELECT max(id) FROM ledger").fetchone()
        while (chain := self.client.call("server.info")["chain"])["link"] < last:
            pass
        return chain

    def test_a_chain_that_is_cut_or_calculated_anew_is_noticed(self):
        def cut(database):
            database.execute("DELETE FROM activation WHERE generation = (SELECT max(generation) FROM activation)")
            database.execute("DELETE FROM deed WHERE id = (SELECT max(id) FROM deed)")
            database.execute("DELETE FROM ledger WHERE id > (SELECT max(id) - 2 FROM ledger)")

        def calculate_anew(database):  # recalculates only the last hash, so the chain differs from the announced head
            database.execute("UPDATE ledger SET sha256 = ? WHERE id = (SELECT max(id) FROM ledger)", ("0" * 64,))
        for spoil in (cut, calculate_anew):
            for under_mdofd in (False, True):
                with self.subTest(spoil.__name__, under_mdofd=under_mdofd):
                    self.acknowledged()
                    chain = self.head_told()
                    with open(self.daemon.log.name) as journal:
                        self.assertIn(f"the newest link of the chain of hashes is {chain['link']} (SHA-256 {chain['sha256']})", journal.read())
                    if not under_mdofd:
                        self.daemon.stop()
                    self.assertEqual(mdof("verify", "--db", self.daemon.database, "--head", chain["sha256"])[0], 0)
                    with contextlib.closing(sqlite3.connect(self.daemon.database)) as database, database:
                        for table in ("activation", "deed", "ledger"):
                            for what in ("update", "delete"):
                                database.execute(f"DROP TRIGGER IF EXISTS {table}_no_{what}")
                        spoil(database)
                    if not under_mdofd:
                        self.client = self.daemon.start()
                        self.assertEqual(self.client.call("compensation.status")["axes"], {})
                    self.assertIn(f"link {chain['link']} of the chain of hashes with hash {chain['sha256']}", self.lost())
                    self.refused("mdofd last reported link", "run.start", axis="X")
                    code, _, err = mdof("verify", "--db", self.daemon.database, "--head", chain["sha256"])
                    self.assertEqual(code, 1)
                    self.assertIn("(--head)", err)
                    self.daemon.stop()
                    for name in os.listdir(self.daemon.folder):
                        if name.startswith("mdof.db"):
                            os.remove(os.path.join(self.daemon.folder, name))
                    self.client = self.daemon.start()

    def test_changed_rows_are_not_served_page_by_page(self):
        run = self.replayed()
        self.client.call("run.points", run=run, offset=0, count=2)
        with sqlite3.connect(self.daemon.database) as database:
            database.execute("DROP TRIGGER point_no_update")
            database.execute("UPDATE point SET dy_m = dy_m + 1e-6 WHERE run = ? AND row = 3", (run,))
        self.client.call("run.points", run=run, offset=0, count=2)
        self.refused("were changed after they were stored", "run.points", run=run, offset=2, count=2)
        # Mdofd has now found that the run was changed.
        self.refused("were changed after they were stored", "run.points", run=run, offset=0, count=2)

    def test_a_run_under_way_fails_with_that_reason(self):
        watcher = Client(self.daemon.socket)
        watcher.call("live.subscribe", interval_ms=60_000)
        run = self.client.call("run.start", axis="X")["run"]
        folder = os.path.join(os.path.dirname(self.daemon.database), "recordings")
        os.remove(os.path.join(folder, [name for name in os.listdir(folder) if name.endswith(".mdofrec")][0]))
        while (event := watcher.next_note()["params"]["value"]).get("type") != "ended":
            pass
        self.assertEqual((event["run"], event["state"]), (run, "failed"))
        self.assertTrue(any("was deleted while the run was being recorded" in w
                            for w in notice_lines(self.client.call("run.get", run=run))))

    def listed(self, **params):
        runs, offset, pages = [], 0, 0
        while True:
            page = self.client.call("run.list", offset=offset, **params)
            runs += page["runs"]
            offset += len(page["runs"])
            pages += 1
            if offset >= page["total"]:
                return runs, pages
            self.assertGreater(len(page["runs"]), 0)

    def test_lists_are_weighed(self):
        targets = [round(0.1 * i + 0.01234567890123, 14) for i in range(32)]
        for _ in range(40):
            self.replayed(targets_mm=targets, note="n" * 1000)
        runs, pages = self.listed()
        self.assertEqual([run["run"] for run in runs], list(range(40, 0, -1)))
        self.assertGreater(pages, 1)
        self.assertEqual(len(self.listed(count=7)[0]), 40)
        self.assertEqual(runs[0]["note"], "n" * 1000)

    def test_a_run_that_no_line_holds_is_listed_shortened(self):
        self.replayed()
        self.daemon.stop()
        with sqlite3.connect(self.daemon.database) as database:  # the database as an older mdof wrote it
            database.execute("DROP TRIGGER run_no_update")
            database.execute("UPDATE run SET note = ?", ("n" * 100_000,))
        self.client = self.daemon.start()
        runs, _ = self.listed()
        self.assertTrue(runs[0]["shortened"])
        self.assertTrue(runs[0]["note"].endswith("... (cut)"))

    def test_a_note_is_at_most_a_kilobyte(self):
        self.refused("1024", "run.replay", path=self.log, note="n" * 1025)
        code, _, err = mdof("replay", self.log, "--rig", RIG["X"], "--note", "n" * 1025, "--db",
                            os.path.join(self.folder.name, "own.db"))
        self.assertEqual(code, 2, err)
        self.assertIn("1024", err)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
