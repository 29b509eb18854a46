#!/usr/bin/python3
"""The HTTP server of the web page, tested with other clients: http.client and urllib of Python, and curl if it is
installed. Tests:
- the files of the page
- the same replies as on the Unix socket
- writing only with the token
- events by the rules of EventSource, also after the stream has ended
- `mdof token`
- the accepted values of the configuration and of --http

usage: http_test.py MDOFD MDOF"""
import gzip
import http.client
import json
import os
import pathlib
import re
import shutil
import stat
import subprocess
import sys
import tempfile
import unittest
import urllib.error
import urllib.request

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from mdofd import Daemon, simulator  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[3]
PAGE = ROOT / "daemon" / "web"


class Events:
    """A stream of events, read by the rules of EventSource (HTML, 9.2.6)."""

    def __init__(self, port, query, last_id=None):
        self.connection = http.client.HTTPConnection("127.0.0.1", port, timeout=30)
        self.connection.request("GET", "/events?" + query, headers={"Last-Event-ID": last_id} if last_id else {})
        self.reply = self.connection.getresponse()
        assert self.reply.status == 200, self.reply.read()
        self.last_id, self.retry_ms = last_id, None

    def next(self):
        event, data = "message", []
        for line in iter(self.reply.readline, b""):
            field, _, value = line.decode().rstrip("\n").partition(":")
            value = value.removeprefix(" ")
            if field == "id":
                self.last_id = value
            elif field == "retry":
                self.retry_ms = int(value)
            elif field == "event":
                event = value
            elif field == "data":
                data.append(value)
            elif line == b"\n" and data:
                return event, json.loads("\n".join(data))
            elif line == b"\n":
                event, data = "message", []
        raise ConnectionError("the stream ended")

    def await_event(self, fits):
        while True:
            event, data = self.next()
            if fits(event, data):
                return event, data

    def close(self):
        self.reply.close()
        self.connection.close()


class Http(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.daemon = Daemon(MDOFD, self.folder.name, '[http]\nlisten = "127.0.0.1:0"\nhosts = ["mill.local:80"]\n'
                             + simulator(rate_hz=500, dwell_s=0.05, repeats=1))
        self.addCleanup(lambda: self.daemon.process.poll() is None and self.daemon.kill())
        self.start()

    def start(self):
        self.socket = self.daemon.start()
        self.served = self.socket.call("server.info")["http"]
        self.url = self.served["url"]
        self.port = int(re.fullmatch(r"http://127\.0\.0\.1:(\d+)/", self.url)[1])

    def tearDown(self):
        self.daemon.stop()
        self.folder.cleanup()

    def get(self, name, **headers):
        with urllib.request.urlopen(urllib.request.Request(self.url + name, headers=headers), timeout=30) as reply:
            return reply.status, reply.headers, reply.read()

    def call(self, method, token=None, **params):
        body = json.dumps({"jsonrpc": "2.0", "id": 1, "method": method, "params": params}).encode()
        headers = {"Content-Type": "application/json", **({"Authorization": "Bearer " + token} if token else {})}
        with urllib.request.urlopen(urllib.request.Request(self.url + "rpc", body, headers), timeout=30) as reply:
            return json.loads(reply.read())

    def token(self):
        made = subprocess.run([MDOF, "token", "--socket", self.daemon.socket], capture_output=True, text=True)
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertIn(self.url, made.stderr)
        return made.stdout.strip()

    def test_files_of_the_page(self):
        files = {str(p.relative_to(PAGE)): p for p in (*PAGE.glob("*.*"), *PAGE.glob("views/*.*"))}
        files |= {n: pathlib.Path("/usr/share/javascript/dygraphs", n) for n in ("dygraph.min.js", "dygraph.min.css")}
        sent = 0
        for name, path in files.items():
            status, headers, text = self.get(name)
            self.assertEqual(text, path.read_bytes(), name)
            _, packed, small = self.get(name, **{"Accept-Encoding": "gzip"})
            if packed["Content-Encoding"] == "gzip":
                self.assertEqual(gzip.decompress(small), text)
            sent += len(small)
            with self.assertRaises(urllib.error.HTTPError) as same:
                self.get(name, **{"If-None-Match": headers["ETag"]})
            self.assertEqual(same.exception.code, 304)
            same.exception.close()
        self.assertEqual(self.get("")[2], files["index.html"].read_bytes())
        self.assertLess(sent, 200_000)  # size of the complete page

    def test_answers_are_those_of_the_socket(self):
        for method, params in (("run.list", {}), ("device.list", {}), ("compensation.status", {}),
                               ("compensation.at", {"axis": "X", "position_mm": 1})):
            with self.subTest(method):
                answer = self.call(method, **params)
                try:
                    expected = {"result": self.socket.call(method, **params)}
                except Exception as error:
                    expected = {"error": {"code": error.code}}
                if method == "device.list":  # the counters of the devices change
                    self.assertEqual(answer["result"].keys(), expected["result"].keys())
                elif "error" in expected:
                    self.assertEqual(answer["error"]["code"], expected["error"]["code"])
                else:
                    self.assertEqual(answer["result"], expected["result"])

    def test_who_has_the_token_writes(self):
        refused = self.call("run.start", axis="X", targets_mm=[0, 2])["error"]
        self.assertEqual(refused["code"], -32003)
        self.assertIn("mdof token", refused["message"])
        self.assertEqual(self.call("run.start", "0" * 64, axis="X", targets_mm=[0, 2])["error"]["code"], -32003)
        self.assertEqual(self.socket.call("run.list")["total"], 0)
        file = self.served["token_file"]
        self.assertEqual(stat.S_IMODE(os.stat(file).st_mode), 0o600)
        token = self.token()
        self.assertEqual(token, pathlib.Path(file).read_text().strip())
        run = self.call("run.start", token, axis="X", targets_mm=[0, 2])["result"]["run"]
        self.assertEqual(self.socket.call("run.list")["runs"][0]["run"], run)
        self.call("run.stop", token, run=run)
        by = self.socket.call("history.list")["history"][0]
        self.assertEqual((by["uid"], by["user"]), (-1, "web"))
        self.assertEqual(self.call("live.subscribe")["error"]["code"], -32003)
        with open(self.daemon.log.name) as log:
            self.assertNotIn(token, log.read())

    def test_events_go_on_where_they_ended(self):
        token = self.token()
        stream = Events(self.port, "topics=live.update,run.event&interval_ms=50")
        event, live = stream.await_event(lambda event, _: event == "live.update")
        self.assertEqual(live["value"]["axis"], "X")
        self.assertEqual(stream.retry_ms, 2000)
        run = self.call("run.start", token, axis="X", targets_mm=[0, 2])["result"]["run"]
        stream.await_event(lambda event, data: event == "run.event" and data["value"].get("run") == run)
        seen = stream.last_id
        stream.close()
        self.call("run.stop", token, run=run)
        again = Events(self.port, "topics=run.event", last_id=seen)
        event, _ = again.await_event(
            lambda event, data: event == "lost" or data["value"]["type"] == "ended")
        self.assertEqual(event, "run.event")
        self.assertGreater(int(again.last_id), int(seen))
        again.close()
        self.daemon.stop()
        self.start()
        after = Events(self.port, "topics=run.event", last_id=seen)
        self.assertEqual(after.next(), ("lost", {"count": None}))
        self.assertGreater(int(after.last_id), int(seen))
        after.close()
        self.assertEqual(self.token(), token)  # the token in the file is the same

    def test_pages_of_others_are_refused(self):
        for headers, code in (({"Host": "evil.example"}, 421), ({"Origin": "http://evil.example"}, 403),
                              ({"Host": "mill.local:80"}, 200), ({"Origin": self.url[:-1]}, 200)):
            with self.subTest(headers):
                connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=30)
                connection.request("GET", "/", headers=headers)
                reply = connection.getresponse()
                text = reply.read().decode()
                self.assertEqual(reply.status, code)
                if code != 200:
                    self.assertIn("hosts" if code == 421 else "the web page of mdofd", text)
                connection.close()

    @unittest.skipUnless(shutil.which("curl"), "curl is not there")
    def test_curl(self):
        def curl(*words):
            done = subprocess.run(["curl", "-sS", "-m", "30", *words], capture_output=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            return done.stdout

        self.assertEqual(curl("--compressed", self.url), (PAGE / "index.html").read_bytes())
        body = json.dumps([{"jsonrpc": "2.0", "id": n, "method": "run.list"} for n in range(60)])
        answers = json.loads(curl("-H", "Content-Type: application/json", "-H", "Expect: 100-continue", "-d", body,
                                  self.url + "rpc"))
        self.assertEqual(sorted(a["id"] for a in answers), list(range(60)))
        status = curl("-o", "/dev/null", "-w", "%{http_code}", "--path-as-is", self.url + "../../etc/passwd")
        self.assertEqual(status, b"404")
        status = curl("-o", "/dev/null", "-w", "%{http_code}", "-d", "{}", self.url + "rpc")
        self.assertEqual(status, b"415")

    def test_only_one_has_the_port(self):
        with tempfile.TemporaryDirectory() as folder:
            other = Daemon(MDOFD, folder, f'[http]\nlisten = "127.0.0.1:{self.port}"\n' + simulator())
            with self.assertRaisesRegex(RuntimeError, r"mdofd.toml:\d+: http.listen: .*Address already in use; .*choose another port"):
                other.start()
            self.assertIsNotNone(other.process.poll())


class Configuration(unittest.TestCase):
    def started(self, http, *arguments):
        """Starts mdofd. Returns the member http of server.info, or the error of mdofd."""
        with tempfile.TemporaryDirectory() as folder:
            daemon = Daemon(MDOFD, folder, http.replace("FOLDER", folder) + simulator())
            daemon.arguments = list(arguments)
            try:
                served = daemon.start().call("server.info")["http"]
                if served:
                    self.assertIn(served["url"], pathlib.Path(daemon.log.name).read_text())
                    self.assertTrue(os.path.isabs(served["token_file"]))
                daemon.stop()
                return served
            except RuntimeError as error:
                return str(error)
            finally:
                if daemon.process.poll() is None:
                    daemon.kill()

    def test_it_is_off_unless_asked_for(self):
        self.assertIsNone(self.started(""))
        self.assertTrue(self.started("", "--http", "127.0.0.1:0")["url"].startswith("http://127.0.0.1:"))
        self.assertTrue(self.started('[http]\nlisten = "[::1]:0"\n')["url"].startswith("http://[::1]:"))
        named = self.started('[http]\nlisten = "localhost:0"\ntoken_file = "FOLDER/secret"\n', "--http")
        self.assertTrue(named["token_file"].endswith("/secret"))

    def test_what_is_wrong_is_named(self):
        for http, arguments, said in (
                ('[http]\nlisten = "0.0.0.0:8080"\n', (), r"mdofd.toml:\d+: http.listen: .*not a local address with a port"),
                ('[http]\nlisten = "127.0.0.1"\n', (), "http.listen"),
                ('[http]\nlisten = "127.0.0.1:70000"\n', (), "http.listen"),
                ('[http]\nhosts = ["http://mill.local/"]\n', (), "http.hosts"),
                ('[http]\nport = 8080\n', (), "port"),
                ("", ("--http", "192.168.0.1:80"), "not a local address with a port"),
                ('[http]\ntoken_file = "/proc/none"\n', (), r"http.token_file: .*/proc/none")):
            with self.subTest(http, arguments=arguments):
                self.assertRegex(self.started(http, *arguments), said)


if __name__ == "__main__":
    MDOFD, MDOF = sys.argv[1:3]
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
