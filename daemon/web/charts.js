// Charts with dygraphs: errors against the position, with a band ± U for each approach. dygraphs is
// loaded when the page shows the first chart.
import {fixed, h, isNumber, nameOf, unitOf} from "./dom.js";

const kHeight_px = 240;
let loading = null;
const dark = matchMedia("(prefers-color-scheme: dark)");

function load() {
  return loading ??= new Promise((resolve, reject) => {
    document.head.append(h("link", {rel: "stylesheet", href: "/dygraph.min.css"}),
      h("script", {src: "/dygraph.min.js", onload: () => resolve(withoutLegend()), onerror: () => {
        loading = null;
        reject(new Error("dygraph.min.js cannot be loaded"));
      }}));
  });
}

// The legend of dygraphs is not used, because it sets inline styles, which the security policy of
// the page forbids. The legend here is a line below the chart.
function withoutLegend() {
  Dygraph.PLUGINS = Dygraph.PLUGINS.filter((plugin) => plugin !== Dygraph.Plugins.Legend);
}

const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
const kDash = [6, 3];

// series: a list of {label, name, colour, dash, wide, line, marks, envelope, points}. - name: text
// in the legend - wide: a wide line, visible below another series - line: a line without symbols
// and band - marks: symbols without a line - envelope: the band is a range, and the line is the
// mean - points: [x, low, value, high] in any order of x Returns the rows for dygraphs, with a
// column for each series. If a series has no value at a position, its cell is empty.
export function rowsOf(series) {
  const rows = new Map();
  series.forEach((one, i) => one.points.forEach(([x, low, value, high]) => {
    if (!isNumber(value)) return;
    if (!rows.has(x)) rows.set(x, Array(series.length).fill(null));
    rows.get(x)[i] = [isNumber(low) ? low : value, value, isNumber(high) ? high : value];
  }));
  return [...rows].sort((a, b) => a[0] - b[0])
    .map(([x, values]) => [x, ...values.map((v) => v ?? [null, null, null])]);
}

export class Chart {
  // title: the quantity with its unit. place: a function that returns the text of a position on the
  // x axis. The argument summary of set() describes the chart in words, for users who cannot see
  // it.
  constructor(title, unit, {height_px = kHeight_px, xlabel = "position/mm", place = (x) => `${fixed(x, 3)} mm`} = {}) {
    this.unit = unit;
    this.place = place;
    this.xlabel = xlabel;
    this.canvas = h("div", {class: "canvas", role: "img", "aria-label": title});
    this.canvas.style.height = `${height_px}px`;
    this.legend = h("p", {class: "legend"});
    this.element = h("figure", {class: "chart"}, h("figcaption", {}, title), this.canvas, this.legend);
    this.title = title;
    this.onScheme = () => this.draw();
    dark.addEventListener("change", this.onScheme);
  }
  async set(series, summary = "") {
    this.series = series.filter((one) => one.points.some((p) => isNumber(p[2])));
    this.canvas.setAttribute("aria-label", `${this.title}. ${summary}`);
    await load();
    this.draw();
  }
  draw() {
    if (!this.series || !this.canvas.isConnected || this.closed) return;
    const rows = rowsOf(this.series);
    if (rows.length === 0) {
      this.legend.textContent = "No point has error values yet.";
      return;
    }
    const options = {
      file: rows, labels: ["x", ...this.series.map((one) => one.label)], customBars: true,
      colors: this.series.map((one) => colour(one.colour)),
      series: Object.fromEntries(this.series.map((one) => [one.label, {
        strokePattern: one.dash ? kDash : null, drawPoints: one.points.length < 200,
        pointSize: one.line || one.envelope ? 0 : one.marks ? 6 : 3, strokeWidth: one.marks ? 0 : one.wide ? 4 : one.envelope ? 0.8 : 1.6,
        fillAlpha: one.line || one.marks ? 0 : one.envelope ? 0.1 : 0.2}])),
      axisLineColor: colour("rule"), gridLineColor: colour("grid"), axisLabelFontSize: 12,
      connectSeparatedPoints: true, highlightCircleSize: 5, xlabel: this.xlabel, xLabelHeight: 16, xRangePad: 8, yRangePad: 12,
      strokeWidth: 1.6, axes: {y: {axisLabelWidth: 62}},
      highlightCallback: (_, x, points) => this.say(x, points), unhighlightCallback: () => this.say()};
    if (this.graph) this.graph.updateOptions(options);
    else this.graph = new Dygraph(this.canvas, rows, options);
    this.say();
  }
  say(x, points) {
    const kinds = [...new Map(this.series.map((one) => [one.name ?? one.label, one])).entries()].sort((a, b) => a[1].dash - b[1].dash);
    const text = points?.length
      ? `${this.place(x)}: ` + points.filter((p) => isNumber(p.yval)).map((p) => `${p.name} ${fixed(p.yval, 3)} ${this.unit}`).join(", ")
      : kinds.map(([name, one]) => `${one.dash ? "– –" : "——"} ${name}`).join("   ");
    if (this.legend.textContent !== text) this.legend.textContent = text;
  }
  close() {
    this.closed = true;
    dark.removeEventListener("change", this.onScheme);
    this.graph?.destroy();
  }
}

const kMostPasses = 4;  // passes with their own line and band; all older passes have one common band

export const approach = (direction) => direction > 0 ? {name: "forward", colour: "blue", dash: false}
  : direction < 0 ? {name: "reverse", colour: "orange", dash: true} : {name: "approach unknown", colour: "text", dash: false};
const sign = (direction) => direction > 0 ? "+" : direction < 0 ? "−" : "?";
// Converts a map x -> value to points of a series without U.
export const plain = (map) => [...map].map(([x, y]) => [x, y, y, y]);

// Converts points from run.points to series. The newest passes have one series for each pass and
// approach, with ± U. Before them there is one series for all older passes of an approach: their
// mean, and the range from the smallest to the largest value, so that outliers stay visible.
export function passes(points, key, most = kMostPasses) {
  const last = points.reduce((most_so_far, p) => Math.max(most_so_far, p.run), 0);
  const older = new Map(), newest = new Map(), times = new Map();
  for (const p of points) {
    const is_new = p.run > last - most, found = is_new ? newest : older, U = p.U?.[key] ?? 0, x = p.target_mm ?? p.position_mm;
    let id = `${is_new ? p.run : "older "}${sign(p.direction)}`;
    if (is_new) {  // a series can have only one value at a position; a second value is in another series
      const here = `${id} ${x}`;
      times.set(here, (times.get(here) ?? 0) + 1);
      if (times.get(here) > 1) id += ` (${times.get(here)})`;
    }
    if (!found.has(id)) found.set(id, {label: id, ...approach(p.direction), marks: !p.direction, points: [], values: new Map()});
    const one = found.get(id);
    if (is_new) one.points.push([x, p[key] - U, p[key], p[key] + U]);
    else if (isNumber(p[key])) one.values.set(x, [...one.values.get(x) ?? [], p[key]]);
  }
  for (const one of older.values()) {
    one.name = `older passes, ${one.name}: mean, smallest to largest`;
    one.envelope = true;
    one.points = [...one.values].map(([x, all]) => [x, Math.min(...all), all.reduce((a, b) => a + b, 0) / all.length, Math.max(...all)]);
  }
  return [...older.values(), ...newest.values()];
}

// The mean of all passes of one approach at each target, as a map target_mm -> value. direction 0:
// the mean of both approaches. A reading without an approach counts for both approaches.
export function means(points, key, direction = 0) {
  const sums = new Map();
  for (const p of points) {
    if (direction && p.direction && p.direction !== direction || !isNumber(p[key])) continue;
    const x = p.target_mm ?? p.position_mm;
    const side = sums.get(x) ?? {1: [], "-1": []};
    for (const d of p.direction ? [p.direction] : direction ? [direction] : [1, -1]) side[d].push(p[key]);
    sums.set(x, side);
  }
  const mean = (list) => list.reduce((a, b) => a + b, 0) / list.length;
  return new Map([...sums].map(([x, side]) =>
    [x, mean([side[1], side[-1]].filter((list) => list.length).map(mean))]).sort((a, b) => a[0] - b[0]));
}

export const errorKeys = (point) => Object.keys(point ?? {}).filter((key) => /^E[XYZABC][XYZ]_u(m|rad)$/.test(key));

// Five charts, one for each error.
export class ErrorCharts {
  constructor(keys, options) {
    this.charts = new Map(keys.map((key) => [key, new Chart(`${nameOf(key)} in ${unitOf(key)}`, unitOf(key), options)]));
    this.element = h("div", {class: "charts"}, [...this.charts.values()].map((chart) => chart.element));
  }
  set(points) {
    return Promise.all([...this.charts].map(([key, chart]) => {
      const values = points.map((p) => p[key]).filter(isNumber);
      const range = values.length ? `${values.length} points from ${fixed(Math.min(...values), 3)} to ` +
        `${fixed(Math.max(...values), 3)} ${unitOf(key)}` : "No points yet";
      return chart.set(passes(points, key), range);
    }));
  }
  close() { for (const chart of this.charts.values()) chart.close(); }
}
