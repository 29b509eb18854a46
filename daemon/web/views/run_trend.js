// Shows figures of the stored runs against time, with control limits, from run.trend.
import {Chart} from "../charts.js";
import {covers, fixed, h, isNumber, field, notices, problem, select, short, table, time, titleOf, unitOf} from "../dom.js";
import {call} from "../rpc.js";

const kAxes = [["", "all, and squareness"], ["X", "X"], ["Y", "Y"], ["Z", "Z"]];
const named = (runs) => `run${runs.length > 1 ? "s" : ""} ${runs.join(" and ")}`;

// The series of a control chart. The value with the index i is at x = i + 1. If there are too few
// values, the limits are null.
export function controlSeries({values, centre}) {
  const line = (label, colour, dash, of) => ({label, colour, dash, line: true,
    points: values.map((v, i) => [i + 1, of(v), of(v), of(v)]).filter((p) => isNumber(p[2]))});
  const value = (v, i) => [i + 1, v.value - (v.u ?? 0), v.value, v.value + (v.u ?? 0)];
  return [{label: "value", name: "value ± u", colour: "blue", dash: false, points: values.map(value)},
    {label: "beyond", name: "beyond the limits, or at least the eighth value in a row on one side of the centre line", colour: "orange", dash: false, marks: true,
      points: values.map((v, i) => v.signal ? value(v, i) : null).filter(Boolean)},
    line("centre", "text", false, () => centre), line("lower limit", "orange", true, (v) => v.low), line("upper limit", "orange", true, (v) => v.high)];
}

// A text with the result of the control chart.
export function verdict(key, {moved, baseline, values}) {
  if (values.length === 0) return "No stored run has this result.";
  if (baseline === 0) return `● ${values.length} ${values.length === 1 ? "value is" : "values are"} too few for control limits.`;
  if (!moved) return `● ${titleOf(key)} has not moved.`;
  return `▲ ${titleOf(key)} has moved by ${short(moved.by)} ${unitOf(key)} (u = ${short(moved.u_by)} ${unitOf(key)}) since ${named(moved.since_runs)}.`;
}

const rowOf = (v) => [named(v.runs), time(v.started_utc), short(v.value), short(v.u), short(v.low), short(v.high), v.signal ? `▲ ${v.signal}` : ""];

class Trend {
  constructor() {
    this.axis = "X";
    this.without = [];
    this.body = h("div", {});
    this.figure = h("div", {});
    this.element = h("div", {}, h("p", {}, h("a", {href: "#runs"}, "← All runs")), h("h2", {}, "Control charts"),
      h("div", {class: "fields"}, field("Axis", select(kAxes, this.axis, (axis) => { this.axis = axis; this.read(); })), this.figure,
        field("Runs to leave out", h("input", {name: "without", placeholder: "7, 9", onchange: (e) => {
          this.without = e.target.value.split(/[\s,]+/).filter(Boolean).map(Number);
          this.read();
        }}), "for example a run with a known fault of the set-up")), this.body);
  }
  async read() {
    this.body.replaceChildren(h("p", {class: "quiet"}, "Reading …"));
    const {axis, without} = this;
    try {
      const {figures} = await call("run.trend", {...(axis && {axis}), ...(without.length > 0 && {without})});
      if (axis !== this.axis || without !== this.without) return;
      this.figures = Object.fromEntries(Object.entries(figures).filter(([, of]) => of.values.length > 0));
      const keys = Object.keys(this.figures);
      this.figure.replaceChildren(keys.length ? field("Figure", select(keys.map((key) => [key, titleOf(key)]), keys[0], (key) => this.show(key))) : "");
      if (keys.length) this.show(keys[0]);
      else this.body.replaceChildren(h("p", {role: "status"}, "No stored run has a value for a control chart."),
        notices([...new Set(Object.values(figures).flatMap((of) => of.left_out))].map((text) => `left out: ${text}`)) ?? "");
    } catch (error) {
      this.figure.replaceChildren();
      this.body.replaceChildren(problem(error));
    }
  }
  show(key) {
    this.close();
    const of = this.figures[key], unit = unitOf(key);
    this.chart = new Chart(`${titleOf(key)} in ${unit} over the stored runs`, unit,
      {xlabel: "runs in the order of time", place: (x) => of.values[x - 1] ? named(of.values[x - 1].runs) : ""});
    this.body.replaceChildren(h("p", {class: of.moved ? "notice doubtful" : "result", role: "status"}, verdict(key, of)), this.chart.element,
      table(`Values in ${unit}, in the order of time`, [["runs"], ["started", "w"], ["value", "n"], ["u", "n"], ["lower limit", "n"], ["upper limit", "n"], ["signal", "w"]],
        of.values.map(rowOf)),
      h("p", {class: "quiet"}, isNumber(of.centre) ? `Centre ${short(of.centre)} ${unit}, sigma ${fixed(of.sigma, 4)} ${unit} of the first ${of.baseline} values (Shewhart, 3 sigma). The limits include noise and repeatability only.` : ""),
      covers(of) ?? "", notices([...of.notices, ...of.left_out.map((text) => `left out: ${text}`)]) ?? "");
    this.chart.set(controlSeries(of), verdict(key, of));
  }
  close() { this.chart?.close(); }
}

export function openTrend(place) {
  const trend = new Trend();
  place.append(trend.element);
  trend.read();
  return () => trend.close();
}
