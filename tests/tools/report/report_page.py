"""Reads a report with Python's parser, and reads numbers in the form in which the report shows them."""
import html.parser
import unittest

from mdof_runner import run

VOID = {"meta", "br", "img", "input", "link", "hr", "base"}


class Page(html.parser.HTMLParser):
    """The content of a page: tags with their attributes, tables as lists of rows, the texts of pre, and facts.
    Every tag must be closed at the correct place."""

    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.tags, self.open, self.tables, self.pre, self.facts, self.alarms, self.text = [], [], [], {}, {}, [], []
        self.feed(text)
        self.close()
        assert self.open == [], self.open

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append((tag, dict(attrs)))
        if tag == "table":
            self.tables.append([])
        if tag == "tr":
            self.tables[-1].append([])
        if tag in ("td", "th"):
            self.tables[-1][-1].append("")

    def handle_startendtag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))

    def handle_endtag(self, tag):
        assert self.open and self.open[-1][0] == tag, (tag, self.open)
        self.open.pop()

    def handle_data(self, data):
        self.text.append(data)
        tag, attrs = self.open[-1] if self.open else ("", {})
        if tag in ("td", "th"):
            self.tables[-1][-1][-1] += data
        if tag == "pre":
            self.pre[attrs["class"]] = self.pre.get(attrs["class"], "") + data
        if tag == "dt":
            self.name = data
        if tag == "dd":
            self.facts.setdefault(self.name, []).append(data)
        if tag == "p" and attrs.get("class") == "alarm":
            self.alarms.append(data)

    def table(self, *head):
        return next(t[1:] for t in self.tables if t and t[0][:len(head)] == list(head))


def places(text):
    """Half of the last digit of a number in the report."""
    digits = text.replace("−", "-").split(".")
    return .5 * 10.0 ** -(len(digits[1]) if len(digits) > 1 else 0)


def number(text):
    return float(text.replace("−", "-"))


class ReportCase(unittest.TestCase):
    """Has `path` (a folder) and `db` (a database in this folder)."""

    def report(self, *words, db=None):
        out = self.path / "report.html"
        code, told, err = run("report", *words, "--out", out, "--db", db or self.db)
        self.assertEqual((code, told.strip()), (0, str(out)), err)
        return out.read_bytes().decode()

    def equal(self, shown, value, where):
        self.assertLessEqual(abs(number(shown) - value), places(shown) * 1.0001, f"{where}: {shown}, is {value}")
