// Compensation: the active tables, what is stored, the difference, and the change from one to another.
import {change} from "../activation.js";
import {Chart, errorKeys} from "../charts.js";
import {covers, decimals, fixed, h, nameOf, notices, problem, setRows, table, time, unitOf} from "../dom.js";
import * as live from "../live.js";
import * as machine from "../machine.js";
import {call, pages} from "../rpc.js";
import {facts} from "./run_detail.js";
import {openVolume} from "./volume.js";

const rows = (id) => pages("compensation.table", {table: id}, "points");

// The values of one approach of a table as points of a series, band ± U by k = 2.
const kCoverage = 2;
function sideOf(points, side, key) {
  return points.map((p) => [p.position_mm, p[side]?.[key] - kCoverage * (p[side]?.u?.[key] ?? 0), p[side]?.[key],
    p[side]?.[key] + kCoverage * (p[side]?.u?.[key] ?? 0)]);
}

// At the place x between the points of a table; null outside: nothing is extrapolated here.
export function valueAt(points, side, key, x) {
  const i = points.findIndex((p) => p.position_mm >= x - 1e-3);
  if (i < 0 || (i === 0 && points[0].position_mm > x + 1e-3)) return null;
  const b = points[i], a = points[Math.max(i - 1, 0)];
  const w = b.position_mm > a.position_mm ? Math.min(Math.max((x - a.position_mm) / (b.position_mm - a.position_mm), 0), 1) : 1;
  return a[side][key] * (1 - w) + b[side][key] * w;
}

const kSides = [["forward", false], ["reverse", true]];

class TablePicture {
  constructor(shown, active) {
    const keys = errorKeys(shown.points[0]?.forward);
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
    if (other) {
      const gap = new Chart(`${nameOf(key)} in ${unit}: table ${shown.table} − active table ${other.table}`, unit, {height_px: 140});
      const of = (side) => shown.points.map((p) => [p, valueAt(other.points, side, key, p.position_mm)]).filter(([, v]) => v !== null)
        .map(([p, v]) => [p.position_mm, p[side][key] - v, p[side][key] - v, p[side][key] - v]);
      draws.push([gap, kSides.map(([side, dash]) => ({label: side, colour: "text", dash, points: of(side)}))]);
      parts.push(gap.element);
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
  return h("details", {}, h("summary", {}, "All numbers with u"), table("Errors of the table, actual − nominal; u: standard uncertainty",
    [["position/mm", "n"], ["approach"], ...keys.flatMap((key) => [[`${nameOf(key)}/${unitOf(key)}`, "n"], [`u/${unitOf(key)}`, "n"]])],
    points.flatMap((p) => kSides.map(([side]) => [fixed(p.position_mm, 3), side,
      ...keys.flatMap((key) => { const u = p[side].u[key]; return [fixed(p[side][key], decimals(u)), fixed(u, decimals(u))]; })]))));
}

const signs = (t) => Object.entries(t.correction).map(([key, c]) => c.factor === null ? `${nameOf(key)}: none (${c.reason})`
  : `${c.factor > 0 ? "+" : "−"}${nameOf(key)} is added to the command of ${c.command}`).join("; ");

function card(t) {
  return facts([["Axis", t.axis], ["Data", t.simulated ? "SIMULATED: no machine was measured" : "measured"], ["Runs", t.runs.join(", ")],
    ["Range", `${fixed(t.first_mm, 3)} … ${fixed(t.last_mm, 3)} mm, ${t.points_total} points`], ["Reference point", t.reference],
    ["Straightness relative to", t.straightness_reference], ["Correction", signs(t)], ["Built", time(t.created_utc)],
    ["Warnings", t.doubtful ? "▲ notices of its runs make this table doubtful" : null], ["Active since", t.activated_utc && `${time(t.activated_utc)}, by ${t.activated_by}`]]);
}

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
  async read() {
    const {axis} = this;
    try {
      const [status, list, {runs}, {history}] = await Promise.all([call("compensation.status"), call("compensation.list", {axis}),
        call("run.list", {axis, count: 100}), call("history.list", {count: 200})]);
      this.now = status.axes[axis] ?? null;
      this.active.replaceChildren(...this.now ? [h("p", {class: "result"}, `Table ${this.now.table}, generation ${this.now.generation}`), card(this.now), covers(this.now) ?? "",
        h("p", {class: "buttons"}, h("button", {onclick: () => this.show(this.now.table)}, "Show this table"), h("button", {class: "danger", onclick: () => this.deactivate()}, "Deactivate …"))]
        : [h("p", {}, "No table is active: nothing is corrected on this axis.")]);
      setRows(this.table, list.tables.map((t) => this.row(t)));
      this.build(runs.filter((r) => ["complete", "partial"].includes(r.state)));
      const deeds = history.filter((d) => d.deed.startsWith("compensation."));
      this.history.replaceChildren(deeds.length === 0 ? h("p", {}, "No table was built or activated yet.") : table("Tables of all axes: who did what, newest first",
        [["when", "w"], ["action"], ["object"], ["by"], ["reason"]], deeds.map((d) => [time(d.utc), d.deed.replace("compensation.", ""),
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
  // The runs stay chosen while the lists are read again.
  build(runs) {
    const chosen = new Set([...this.builder.querySelectorAll("input:checked")].map((box) => Number(box.value)));
    const result = this.result ??= h("div", {role: "status"});
    this.builder.replaceChildren(h("form", {class: "panel", onsubmit: (e) => { e.preventDefault(); this.make(new FormData(e.target)); }},
      h("h2", {}, "Build a table"), runs.length === 0 ? h("p", {}, `There is no run of ${this.axis} yet; measure one in Capture.`)
        : h("fieldset", {}, h("legend", {}, "From runs with the same targets"), runs.slice(0, 20).map((r) => h("label", {class: "check"},
          h("input", {type: "checkbox", name: "run", value: r.run, checked: chosen.has(r.run)}), `run ${r.run}, ${time(r.started_utc)}, ${r.state}${r.simulated ? ", SIMULATED" : ""} ${r.note ?? ""}`))),
      h("label", {class: "check"}, h("input", {type: "checkbox", name: "keep_slope"}), "Keep the slope in the straightness (by default the slope belongs to squareness)"),
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
    try {
      const [shown, active] = await Promise.all([rows(id), this.now ? rows(this.now.table) : null]);
      this.opened?.close();
      this.opened = new TablePicture(shown, active);
      this.shown.replaceChildren(h("section", {class: "panel", "aria-label": `Table ${id}`}, h("h2", {}, `Table ${id}${shown.active ? ", active" : active ? `, compared with the active table ${active.table}` : ", not active"}`),
        h("p", {class: "quiet"}, `Blue: table ${id}${active && !shown.active ? `, orange: active table ${active.table}` : ""}; solid: forward, dashed: reverse. Bands: ± U = ${kCoverage} u.`),
        this.opened.element, numbers(shown), card(shown), covers(shown) ?? ""));
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
      this.wrong.replaceChildren(problem(error));
    }
  }
  async activate(id) {
    const t = await call("compensation.table", {table: id, count: 1}).catch((error) => this.wrong.replaceChildren(problem(error)));
    if (t) this.change("compensation.activate", {table: id}, {title: `Activate table ${id} on axis ${t.axis}?`, action: "Activate", marks: t,
      text: [card(t), this.now ? h("p", {}, `Table ${id} replaces table ${this.now.table} at once, for all clients.`) : null]});
  }
  deactivate() {
    this.change("compensation.deactivate", {axis: this.axis}, {title: `Deactivate the table of axis ${this.axis}?`, action: "Deactivate",
      text: h("p", {}, `mdofd no longer serves table ${this.now.table}; nothing is corrected on this axis.`)});
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
  const off = live.on("run.event", ({type}) => { if (["compensation", "ended"].includes(type)) panel.read(); });
  return () => { off(); panel.close(); };
}
