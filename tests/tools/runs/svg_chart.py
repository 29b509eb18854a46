"""Reads a chart as a person does: scales from the labels of the ticks, and places of the marks from the drawing.
Uses no code of the program that draws the chart."""
import re
import xml.etree.ElementTree as ET

SVG = "{http://www.w3.org/2000/svg}"
POWERS = {c: str(i) for i, c in enumerate("⁰¹²³⁴⁵⁶⁷⁸⁹")} | {"⁻": "-"}


def number(label):
    return float(label.replace("−", "-"))


def power(title):
    """The power of ten (10^n) in the title of an axis."""
    found = re.search(r"10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)", title)
    return 10.0 ** int("".join(POWERS[c] for c in found[1])) if found else 1.0


def scale(places):
    """The straight line through (px, value) of the first and the last tick."""
    (p0, v0), (p1, v1) = min(places), max(places)
    return lambda px: v0 + (px - p0) * (v1 - v0) / (p1 - p0)


def centre(shape):
    """Centre of a disc, a square or a diamond, in px."""
    at = lambda name: float(shape.get(name))
    if shape.tag == SVG + "circle":
        return at("cx"), at("cy")
    if shape.tag == SVG + "rect":
        return at("x") + at("width") / 2, at("y") + at("height") / 2
    corners = [tuple(map(float, pair.split(","))) for pair in shape.get("points").split()]
    return tuple(sum(c[i] for c in corners) / len(corners) for i in (0, 1))


class Panel:
    def __init__(self, group):
        self.group, self.data = group, {k[5:]: v for k, v in group.attrib.items() if k.startswith("data-")}
        lines = [e for e in group if e.tag == SVG + "line" and e.get("class") in ("grid", "rule")]
        texts = [e for e in group if e.tag == SVG + "text"]
        ticks = [e for e in texts if e.get("class") == "quiet tick"]
        self.titles = [e.text for e in texts if e.get("class") in ("quiet", "text head")]
        x, y = [], []
        for line in lines:
            x1, y1, x2, y2 = (float(line.get(k)) for k in ("x1", "y1", "x2", "y2"))
            for tick in ticks:
                at = float(tick.get("x")), float(tick.get("y"))
                if x1 == x2 and tick.get("text-anchor") == "middle" and at[0] == x1:
                    x.append((x1, number(tick.text)))
                if y1 == y2 and tick.get("text-anchor") == "end" and abs(at[1] - y1 - 4) < .011 and at[0] < x1:
                    y.append((y1, number(tick.text)))
        x_title = next((t for t in self.titles if t != self.titles[-1]), "")
        self.x = scale([(px, v * power(x_title)) for px, v in x]) if len(set(x)) > 1 else None
        self.y = scale([(px, v * power(self.titles[-1])) for px, v in y]) if len(set(y)) > 1 else None

    def marks(self):
        """For each mark: its data, and its place in the units of the axes. A cross at the edge has the place
        (None, None)."""
        for g in self.group:
            if g.tag != SVG + "g" or g.get("data-row") is None:
                continue
            shapes = [e for e in g if e.tag not in (SVG + "line", SVG + "title")]
            data = {k[5:]: v for k, v in g.attrib.items()}
            if not shapes:
                yield data, None, None
                continue
            px, py = centre(shapes[0])
            yield data | {"shape": shapes[0].tag[len(SVG):]}, self.x(px), self.y(py)

    def per_px(self):
        """Units of the axes per pixel."""
        return abs(self.x(1) - self.x(0)), abs(self.y(1) - self.y(0))


def panels(path):
    return [Panel(g) for g in ET.parse(path).getroot().iter(SVG + "g") if g.get("data-panel")]


def texts(path):
    return [e.text for e in ET.parse(path).getroot().iter() if e.text and e.text.strip()]
