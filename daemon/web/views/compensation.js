// The view Compensation: the active tables, the stored tables, the differences between tables, and
// the activation of a table.
import {change} from "../activation.js";
import {Chart, errorKeys} from "../charts.js";
import {covers, decimals, fixed, h, isNumber, nameOf, notices, problem, setRows, table, time, unitOf} from "../dom.js";
import * as live from "../live.js";
import * as machine from "../machine.js";
import {call, newest, pages} from "../rpc.js";
import {facts} from "./run_detail.js";
import {openVolume} from "./volume.js";

const rows = (id) => pages("compensation.table", {table: id}, "points");

// Converts the values of one approach of a table to points of a series, with the band ± U for k =
// 2.
const kCoverage = 2;
function sideOf(points, side, key) {
  return points.filter((p) => isNumber(p[side]?.[key])).map((p) => {
    const value = p[side][key], U = isNumber(p[side].u?.[key]) ? kCoverage * p[side].u[key] : null;
    return [p.position_mm, U === null ? null : value - U, value, U === null ? null : value + U];
  });
}

// The value at x, interpolated between the points of a table. null if x is outside the table,
// because this function does not extrapolate.
export function valueAt(points, side, key, x) {
  const i = points.findIndex((p) => p.position_mm >= x - 1e-3);
  if (i < 0 || (i === 0 && points[0].position_mm > x + 1e-3)) return null;
  const b = points[i], a = points[Math.max(i - 1, 0)];
  const w = b.position_mm > a.position_mm ? Math.min(Math.max((x - a.position_mm) / (b.position_mm - a.position_mm), 0), 1) : 1;
  const before = a[side][key], after = b[side][key];
  return isNumber(before) && isNumber(after) ? before * (1 - w) + after * w : w === 1 && isNumber(after) ? after : null;
}

const kSides = [["forward", false], ["reverse", true]];
const factorOf = (t, key) => t.correction?.[key]?.factor ?? null;

// The difference of the corrections of two tables at the points of the first table: [x,
// difference]. A correction is factor * error. null: one of the tables does not correct this error.
export function changeOfCorrection(shown, other, side, key) {
  const [a, b] = [shown, other].map((t) => factorOf(t, key));
  if (a === null || b === null || shown.correction[key].command !== other.correction[key].command) return null;
  return shown.points.map((p) => [p.position_mm, p[side][key], valueAt(other.points, side, key, p.position_mm)])
    .filter(([, mine, theirs]) => isNumber(mine) && isNumber(theirs)).map(([x, mine, theirs]) => [x, a * mine - b * theirs]);
}

// The facts, other than values, in which two tables differ.
export function statedDifferently(t, other) {
  const text = (x) => typeof x === "object" && x !== null ? JSON.stringify(x) : String(x ?? "not stated");
  const found = [["reference", "reference point"], ["reference_mm", "reference point in mm"], ["straightness_reference", "straightness"], ["moves", "moving body"], ["travel", "travel"], ["chain", "chain"], ["chain_travel", "travel of each axis of the chain"]]
    .filter(([key]) => text(t[key]) !== text(other[key])).map(([key, name]) => `${name}: ${text(t[key])} (table ${other.table}: ${text(other[key])})`);
  for (const key of Object.keys(t.correction ?? {}))
    if (factorOf(t, key) !== factorOf(other, key) || t.correction[key].command !== other.correction?.[key]?.command)
      found.push(`correction of ${nameOf(key)}: ${correctionText(key, t.correction[key])} (table ${other.table}: ${other.correction?.[key] ? correctionText(key, other.correction[key]) : "none"})`);
  return found;
}
const differences = (t, other) => other && other.table !== t.table ? notices(statedDifferently(t, other), `Differences between table ${t.table} and table ${other.table}`) ?? "" : "";

class TablePicture {
  constructor(shown, active) {
    const keys = errorKeys(shown.points[0]?.forward).filter((key) => shown.points.some((p) => kSides.some(([side]) => isNumber(p[side][key]))));
    const other = active && active.table !== shown.table ? active : null;
    this.charts = [];
    this.element = h("div", {class: "charts"}, keys.map((key) => this.pair(key, shown, other)));
  }
  pair(key, shown, other) {
    const unit = unitOf(key);
    const chart = new Chart(`${nameOf(key)} in ${unit}`, unit, {height_px: 200});
    const series = (of, colour) => kSides.map(([side, dash]) => ({label: `table ${of.table} ${side}`, colour, dash, points: sideOf(of.points, side, key)}));
    const draws = [[chart, [...series(shown, "blue"), ...(other ? series(other, "orange") : [])]]];
    const parts = [chart.element];
    const changes = other ? kSides.map(([side]) => changeOfCorrection(shown, other, side, key)) : [];
    if (changes.some((change) => change?.length)) {
      const gap = new Chart(`Correction of the command of ${shown.correction[key].command} for ${nameOf(key)} in ${unit}: table ${shown.table} − active table ${other.table}`, unit, {height_px: 140});
      draws.push([gap, kSides.map(([side, dash], i) => ({label: side, colour: "text", dash, points: changes[i].map(([x, v]) => [x, v, v, v])}))]);
      parts.push(gap.element);
    } else if (other) {
      parts.push(h("p", {class: "quiet"}, "The change of the correction is not drawn, because one of the tables does not correct this error or has no values for it."));
    }
    this.draws = [...this.draws ?? [], ...draws];
    this.charts.push(...draws.map(([c]) => c));
    return h("div", {}, parts);
  }
  draw() { for (const [chart, series] of this.draws ?? []) chart.set(series); }
  close() { this.charts.forEach((chart) => chart.close()); }
}

function numbers({points}) {
  const keys = errorKeys(points[0]?.forward);
  return h("details", {}, h("summary", {}, "All values with u"), table("Values of the table; u: standard uncertainty",
    [["position/mm", "n"], ["approach"], ...keys.flatMap((key) => [[`${nameOf(key)}/${unitOf(key)}`, "n"], [`u/${unitOf(key)}`, "n"]])],
    points.flatMap((p) => kSides.map(([side]) => [fixed(p.position_mm, 3), side,
      ...keys.flatMap((key) => { const u = p[side].u[key]; return [fixed(p[side][key], decimals(u)), fixed(u, decimals(u))]; })]))));
}

function correctionText(key, c) {
  return c.factor === null ? `${nameOf(key)}: none (${c.reason})` : `${c.factor > 0 ? "+" : "−"}${nameOf(key)} is added to the command of ${c.command}`;
}
const signs = (t) => Object.entries(t.correction).map(([key, c]) => correctionText(key, c)).join("; ");

function card(t) {
  return facts([["Axis", t.axis], ["Data", t.simulated ? "SIMULATED: no machine was measured" : "measured"], ["Runs", t.runs.join(", ")],
    ["Range", `${fixed(t.first_mm, 3)} … ${fixed(t.last_mm, 3)} mm, ${t.points_total} points`], ["Reference point", t.reference],
    ["Straightness relative to", t.straightness_reference], ["Values", t.sense], ["Correction", signs(t)], ["Built", time(t.created_utc)],
    ["Warnings", t.doubtful ? "▲ notices of the runs make this table doubtful" : null], ["Active since", t.activated_utc && `${time(t.activated_utc)}, by ${t.activated_by}`]]);
}

const kMostRuns = 20, kMostActions = 200;

class AxisPanel {
  opened = null;
  constructor(axis) {
    this.axis = axis;
    this.active = h("div", {});
    this.shown = h("div", {});
    this.wrong = h("div", {role: "alert"});
    this.builder = h("div", {});
    this.table = table(`Stored tables of ${axis}, newest first`, [["table"], ["state", "w"], ["runs"], ["range/mm", "w"], ["points", "n"], ["data"], ["built", "w"], ["actions"]], []);
    this.history = h("div", {});
    this.element = h("div", {}, h("section", {class: "panel"}, h("h2", {}, `Active on axis ${axis}`), this.active), this.wrong, this.shown,
      h("section", {}, h("h2", {}, "Stored tables"), this.table), this.builder, h("section", {}, h("h2", {}, "History"), this.history));
  }
  // Reads the state again. Resolves after the newest reading, also if a newer one starts meanwhile.
  read() { return this.reading = this.readOnce(); }
  async readOnce() {
    const {axis} = this, mine = this.readings = (this.readings ?? 0) + 1;
    try {
      const [status, list, runs, actions] = await Promise.all([call("compensation.status"), pages("compensation.list", {axis}, "tables"),
        newest("run.list", {axis}, "runs", (r) => ["complete", "partial"].includes(r.state), kMostRuns),
        newest("history.list", {}, "history", (d) => d.deed.startsWith("compensation."), kMostActions)]);
      if (mine !== this.readings) return this.reading;
      this.now = status.axes[axis] ?? null;
      this.generation = status.generation;
      this.active.replaceChildren(...this.now ? [h("p", {class: "result"}, `Table ${this.now.table}, generation ${this.now.generation}`), card(this.now), covers(this.now) ?? "",
        h("p", {class: "buttons"}, h("button", {onclick: () => this.show(this.now.table)}, "Show this table"), h("button", {class: "danger", onclick: () => this.deactivate()}, "Deactivate …"))]
        : [h("p", {}, status.volume ? `No table of this axis is active. Table ${status.volume.table} of the volume (${status.volume.machine}) corrects the axes.`
          : "No table is active, so mdofd serves no correction for this axis.")]);
      setRows(this.table, list.tables.map((t) => this.row(t)));
      if (this.openId) this.show(this.openId);
      this.build(runs);
      this.history.replaceChildren(actions.items.length === 0 ? h("p", {}, actions.isAll ? "No table was built or activated yet." : `None of the newest ${actions.searched} actions changed a table.`)
        : table(`Actions on the tables of all axes, newest first${actions.isAll ? "" : `; only the newest ${actions.items.length}`}`,
        [["when", "w"], ["action"], ["object"], ["by"], ["table and reason"]], actions.items.map((d) => [time(d.utc), d.deed.replace("compensation.", ""),
          `${d.of === "compensation_table" || d.of === "volumetric_table" ? "table" : "generation"} ${d.id}`, d.user || `uid ${d.uid}`, d.detail ?? "–"])));
    } catch (error) {
      this.wrong.replaceChildren(problem(error));
    }
  }
  row(t) {
    const newest = t.table > (this.now?.table ?? 0);
    return [String(t.table), t.active ? `● active` : "stored", t.runs.join(", "), `${fixed(t.first_mm, 2)} … ${fixed(t.last_mm, 2)}`, String(t.points_total),
      t.simulated ? "SIMULATED" : "measured", time(t.created_utc), h("span", {class: "buttons"},
        h("button", {"aria-label": `Show table ${t.table}`, onclick: () => this.show(t.table)}, "Show"),
        t.active ? "" : h("button", {"aria-label": `${newest ? "Activate" : "Roll back to"} table ${t.table}`, onclick: () => this.activate(t.table)}, newest ? "Activate …" : "Roll back …"))];
  }
  // Builds the lists again. Selected runs stay selected.
  build({items: runs, searched, isAll}) {
    const chosen = new Set([...this.builder.querySelectorAll("input:checked")].map((box) => Number(box.value)));
    const result = this.result ??= h("div", {role: "status"});
    this.builder.replaceChildren(h("form", {class: "panel", onsubmit: (e) => { e.preventDefault(); this.make(new FormData(e.target)); }},
      h("h2", {}, "Build a table"), runs.length === 0 ? h("p", {}, isAll ? `There is no complete or partial run of ${this.axis} yet; measure one in Capture.` : `None of the newest ${searched} runs of ${this.axis} is complete or partial.`)
        : h("fieldset", {}, h("legend", {}, `New table from one or more runs with the same targets${isAll ? "" : ` (only the newest ${runs.length} runs)`}`), runs.map((r) => h("label", {class: "check"},
          h("input", {type: "checkbox", name: "run", value: r.run, checked: chosen.has(r.run)}), `run ${r.run}, ${time(r.started_utc)}, ${r.state}${r.simulated ? ", SIMULATED" : ""} ${r.note ?? ""}`))),
      h("label", {class: "check"}, h("input", {type: "checkbox", name: "keep_slope"}), "Keep the slope in the straightness (by default mdofd removes the slope, because it is part of the squareness)"),
      h("label", {class: "check"}, h("input", {type: "checkbox", name: "partial"}), "Also accept partial runs"),
      h("p", {class: "buttons"}, h("button", {class: "main", disabled: runs.length === 0}, "Build the table")), result));
  }
  async make(form) {
    try {
      const built = await call("compensation.build", {runs: form.getAll("run").map(Number), keep_slope: form.has("keep_slope"), partial: form.has("partial")});
      this.result.replaceChildren(h("p", {class: "notice"}, `● Table ${built.table} is stored; it is not active yet.`), notices(built.notices) ?? "");
      await this.read();
      this.show(built.table);
    } catch (error) {
      this.result.replaceChildren(problem(error));
    }
  }
  async show(id) {
    const mine = this.shows = (this.shows ?? 0) + 1;
    this.openId = id;
    try {
      const [shown, active] = await Promise.all([rows(id), this.now ? rows(this.now.table) : null]);
      if (mine !== this.shows) return;  // the user has selected another table since
      this.opened?.close();
      this.opened = new TablePicture(shown, active);
      this.shown.replaceChildren(h("section", {class: "panel", "aria-label": `Table ${id}`}, h("h2", {}, `Table ${id}${shown.active ? ", active" : active ? `, compared with the active table ${active.table}` : ", not active"}`),
        h("p", {class: "quiet"}, `Blue: table ${id}${active && !shown.active ? `, orange: active table ${active.table}` : ""}; solid: forward, dashed: reverse. Bands: U = ${kCoverage} u about each point, where u is known.`),
        active ? differences(shown, active) : "", this.opened.element, numbers(shown), card(shown), covers(shown) ?? ""));
      this.opened.draw();
    } catch (error) {
      this.wrong.replaceChildren(problem(error));
    }
  }
  async change(method, params, question) {
    try {
      if (!await change(method, params, question)) return;
      this.wrong.replaceChildren();
      await this.read();
    } catch (error) {
      await this.read();  // before the message: who tries again then decides on the new state
      this.wrong.replaceChildren(problem(error));
    }
  }
  async activate(id) {
    const t = await call("compensation.table", {table: id, count: 1}).catch((error) => this.wrong.replaceChildren(problem(error)));
    if (t) this.change("compensation.activate", {table: id, expected_generation: this.generation}, {title: `Activate table ${id} on axis ${t.axis}?`, action: "Activate", marks: t,
      text: [card(t), this.now ? differences(t, this.now) : null, this.now ? h("p", {}, `Table ${id} replaces table ${this.now.table} at once, for all clients.`) : null]});
  }
  deactivate() {
    this.change("compensation.deactivate", {axis: this.axis, expected_generation: this.generation}, {title: `Deactivate the table of axis ${this.axis}?`, action: "Deactivate",
      text: h("p", {}, `mdofd no longer serves table ${this.now.table} or any other correction for this axis.`)});
  }
  close() { this.opened?.close(); }
}

export function open(place, [asked]) {
  const axes = machine.axes().length ? machine.axes() : ["X", "Y", "Z"];
  const axis = [...axes, "volume"].includes(asked) ? asked : axes[0];
  place.append(h("div", {class: "buttons"}, [...axes, "volume"].map((a) => h("a", {class: "button", href: `#compensation/${a}`,
    "aria-current": a === axis ? "true" : null}, a === "volume" ? "Volume" : `Axis ${a}`))));
  if (axis === "volume") return openVolume(place);
  const panel = new AxisPanel(axis);
  place.append(panel.element);
  panel.read();
  const offs = [live.on("run.event", ({type}) => { if (["compensation", "ended"].includes(type)) panel.read(); }), live.on("gap", () => panel.read())];
  return () => { offs.forEach((off) => off()); panel.close(); };
}
