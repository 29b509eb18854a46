"""The texts of a C++ source with their lines: string literals as the compiler joins them, and comments."""
import re

LITERAL = r'(?:u8|[uUL])?"(?:[^"\\\n]|\\.)*"'
TOKEN = re.compile(rf"""(?P<comment>//[^\n]*(?:\n[ \t]*//[^\n]*)*|/\*.*?\*/)
                      | (?P<include>^[ \t]*\#[ \t]*include[^\n]*)
                      | R"(?P<mark>[^(\s]*)\((?P<raw>.*?)\)(?P=mark)"
                      | (?P<text>{LITERAL}(?:(?:\s|//[^\n]*\n)*{LITERAL})*)
                      | '(?:[^'\\\n]|\\.)+'""", re.DOTALL | re.VERBOSE | re.MULTILINE)


def texts(source):
    """("string" or "comment", line, its text)."""
    for match in TOKEN.finditer(source):
        line = source.count("\n", 0, match.start()) + 1
        if match["comment"]:
            yield "comment", line, re.sub(r"\s*\n\s*//\s*|^//\s*|^/\*|\*/$", " ", match["comment"]).strip()
        elif match["text"]:
            joined = "".join(part[part.index('"') + 1:-1] for part in re.findall(LITERAL, match["text"]))
            yield "string", line, joined.replace('\\"', '"').replace("\\n", " ")
        elif match["raw"]:
            yield "string", line, match["raw"]


def strings(source):
    return [(line, text) for kind, line, text in texts(source) if kind == "string"]


def comments(source):
    return [(line, text) for kind, line, text in texts(source) if kind == "comment"]
