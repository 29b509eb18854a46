// Shows all data of one run: description, errors, straightness with the reference line, angles,
// uncertainty budgets, history.
import {Chart, ErrorCharts, approach, errorKeys, means, plain} from "../charts.js";
import {covers, decimals, field, fixed, h, isNumber, measured, nameOf, notices, problem, select, table, time, titleOf, unitOf} from "../dom.js";
import {budgetBars} from "../pictures.js";
import {call, pages} from "../rpc.js";

export const facts = (list) => h("dl", {}, list.filter(([, x]) => x !== null && x !== undefined && x !== "")
  .map(([name, x]) => [h("dt", {}, name), h("dd", {}, x)]));

export const isImported = (run) => run.recording.kind.startsWith("imported");

function headOfImported(run) {
  const {about, u_um, u_urad} = run.options?.imported ?? {}, u = isNumber(u_um) ? `${u_um} µm` : isNumber(u_urad) ? `${u_urad} µrad` : "not declared";
  return facts([["State", run.state], ["Data", run.simulated ? "SIMULATED: no machine was measured" : "imported: measured by another instrument"],
    ["Imported", time(run.started_utc)], ["Note", run.note], ["Error", run.error], ["Declared standard uncertainty", u],
    ["Stated in the file", about?.join("; ")], ["Positive deviation", run.positioning_sense === "body" ? "the moving body is too far in the + direction of the machine axis"
      : run.positioning_sense === "command" ? "the axis is too far in the + direction of the controller coordinates" : null],
    ["Readings", String(run.points_total)], ["File", run.recording.path], ["SHA-256 of the file", run.recording.sha256]]);
}

function head(run) {
  const t = run.temperature_C;
  return facts([["State", run.state], ["Data", run.simulated ? "SIMULATED: no machine was measured" : "measured"],
    ["Started", time(run.started_utc)], ["Note", run.note], ["Supersedes", run.supersedes && `run ${run.supersedes}`],
    ["Points", String(run.points_total)], ["Reference point", run.reference + (run.reference_mm ? ` (${run.reference_mm.map((x) => fixed(x, 3)).join(", ")}) mm` : "")],
    ["Temperature", isNumber(t?.mean) ? `${fixed(t.mean, 2)} °C` : null],
    ["Moving body, and direction of its motion when the encoder counts up", `${run.moves}, ${run.travel}`],
    ["Lost scans", isNumber(run.scans_lost) ? `${run.scans_lost} of ${run.scans}`
      : isNumber(run.scans) ? `not known (${run.scans} scans recorded)` : "not known (the end of the run was not stored)"], ["Model", run.model],
    ["Recording", run.recording.path], ["SHA-256 of the recording", run.recording.sha256]]);
}

// Values of a reference line from mdofd at encoder positions. The slope refers to the travel of the
// moving body. If the rig has travel "-", this travel is opposite to the encoder.
export function lineAt(line, travel, places_mm) {
  if (!line || !isNumber(line.slope_um_per_m)) return [];
  return places_mm.map((x) => [x, line.intercept_um + line.slope_um_per_m * (travel === "-" ? -x : x) / 1000]);
}

const kLines = [["least_squares", "least-squares line"], ["end_point", "line through both end points"], ["minimum_zone", "minimum-zone line"]];

class Straightness {
  constructor(run, points) {
    this.run = run;
    this.points = points;
    this.charts = Object.keys(run.straightness ?? {}).map((key) => [key, new Chart(`${nameOf(key)} in µm with its reference line`, "µm"), h("p", {})]);
    this.element = h("section", {}, h("h2", {}, "Straightness"),
      field("Reference line", select(kLines, "least_squares", (kind) => this.draw(kind))),
      h("div", {class: "charts"}, this.charts.map(([, chart, text]) => h("div", {}, chart.element, text))));
  }
  draw(kind = "least_squares") {
    const {run} = this;
    for (const [key, chart, text] of this.charts) {
      const places = [...means(this.points, key).keys()], name = nameOf(key), line = run.straightness_lines?.[key]?.mean?.[kind];
      const stated = (figure, value) => measured(kind === "least_squares" && run.uncertainty?.[`${name}_${figure}`] || {value}, figure.endsWith("_um") ? "µm" : "µrad");
      const sides = [1, -1].filter((d) => this.points.some((p) => p.direction === d && isNumber(p[key])));
      text.textContent = `Straightness ${stated("straightness_um", line?.zone_um)}; slope ${stated("slope_urad", line?.slope_um_per_m)} over the travel of the moving body` +
        (run.travel === "-" ? ". The moving body moves in the − direction when the encoder counts up, so the slope over the encoder positions of the chart has the opposite sign" : "") +
        (sides.length === 2 ? ". Mean of both approaches." : ". Only one approach was measured.");
      chart.set([
        ...[1, -1].map((d) => ({label: approach(d).name, ...approach(d), points: plain(means(this.points, key, d))})),
        {label: "reference line", colour: "text", line: true, dash: true, points: lineAt(line, run.travel, [places[0], places.at(-1)]).map(([x, y]) => [x, y, y, y])},
      ], text.textContent);
    }
  }
}

// The figure "mean" of a run with one approach contains this approach only.
export function approachesText(points) {
  const directions = [...new Set(points.map((p) => p.direction))].filter((d) => d === 1 || d === -1);
  return directions.length === 1 ? `${approach(directions[0]).name} only` : "mean of both approaches";
}

function angles(run, points) {
  return table(`Angles: range over the travel, ${approachesText(points)}`, [["error"], ["range", "w"], ["at start/µrad", "n"], ["smallest/µrad", "n"], ["largest/µrad", "n"]],
    Object.entries(run.angles ?? {}).map(([key, {mean}]) => [nameOf(key), measured(run.uncertainty?.[key.replace("_urad", "_range_urad")] ?? {value: mean.range_urad}, "µrad"),
      // min_urad and max_urad are relative to start_urad
      fixed(mean.start_urad, 3), fixed(mean.start_urad + mean.min_urad, 3), fixed(mean.start_urad + mean.max_urad, 3)]));
}

class Budget {
  constructor(run) {
    this.place = h("div", {"aria-live": "polite"});
    const figures = Object.keys(run.uncertainty ?? {});
    this.element = h("section", {}, h("h2", {}, "Uncertainty budget"), figures.length === 0 ? h("p", {}, "No result of this run has an uncertainty budget.")
      : field("Result", select(figures.map((key) => [key, `${titleOf(key)}/${unitOf(key)}`]), figures[0], (key) => this.read(run.run, key))), this.place);
    if (figures.length) this.read(run.run, figures[0]);
  }
  async read(run, figure) {
    const turn = this.turn = (this.turn ?? 0) + 1;
    try {
      const reply = await call("run.budget", {run, figure});
      if (turn !== this.turn) return;  // the user has selected another result since
      const budget = reply.figures[figure], unit = unitOf(figure);
      this.place.replaceChildren(h("p", {class: "result"}, `${titleOf(figure)}: ${measured(budget, unit)}; u = ${fixed(budget.u, decimals(budget.u))} ${unit}`),
        budgetBars(budget, unit), covers(budget) ?? "");
    } catch (error) {
      this.place.replaceChildren(problem(error));
    }
  }
}

// A table with all numbers of the charts, for users who cannot see the charts or need the numbers.
export function pointsTable(points) {
  const keys = errorKeys(points.find((p) => errorKeys(p).length));
  return h("details", {}, h("summary", {}, `All ${points.length} points with U`), table("Points in the order of measurement",
    [["target/mm", "n"], ["pass", "n"], ["approach"], ["position/mm", "n"], ...keys.flatMap((key) => [[`${nameOf(key)}/${unitOf(key)}`, "n"], [`U/${unitOf(key)}`, "n"]]), ["flags"]],
    points.map((p) => [fixed(p.target_mm, 3), String(p.run), approach(p.direction).name, fixed(p.position_mm, 4),
      ...keys.flatMap((key) => [fixed(p[key], decimals(p.U?.[key])), fixed(p.U?.[key], decimals(p.U?.[key]))]), [p.reason, ...p.flags ?? []].filter(Boolean).join(", ")])));
}

const actions = (list) => list.length === 0 ? null : h("section", {}, h("h2", {}, "History"), h("ul", {},
  list.map((d) => h("li", {}, `${time(d.utc)}: ${d.deed} by ${d.user || `uid ${d.uid}`}${d.detail ? `: ${d.detail}` : ""}`))));

// The runs that can be compared with this run, or from which a squareness can be calculated with
// it.
const kMostPartners = 500;
function partners(run, runs) {
  const of = (test) => runs.filter((r) => r.run !== run.run && test(r)).map((r) => [r.run, `run ${r.run}, ${r.axis}, ${time(r.started_utc)} ${r.note ?? ""}`]);
  const pick = (label, options, how) => options.length === 0 ? null
    : field(label, select([["", "choose …"], ...options], "", (other) => {
      const [later, earlier] = [Math.max(run.run, Number(other)), Math.min(run.run, Number(other))];
      if (other) location.hash = `runs/${later}/${how}/${earlier}`;
    }));
  const alike = (r) => isImported(r) === isImported(run) && (!isImported(run) || r.model === run.model);
  return h("div", {class: "fields"}, pick("Compare with", of((r) => r.axis === run.axis && alike(r)), "with"),
    isImported(run) ? null : pick("Squareness with", of((r) => r.axis !== run.axis && r.simulated === run.simulated && alike(r)), "square"));
}

export const kResumable = ["partial", "aborted", "failed"];

async function resume(run, place) {
  try {
    await call("run.resume", {run});
    location.hash = "capture";
  } catch (error) {
    place.replaceChildren(problem(error));
  }
}

function readings(points) {
  const key = errorKeys(points[0])[0];
  return h("details", {}, h("summary", {}, `All ${points.length} readings`), table("Readings in the order of the file; u: declared standard uncertainty",
    [["target", "n"], ["pass", "n"], ["approach"], ["position/mm", "n"], [`${nameOf(key)}/${unitOf(key)}`, "n"], [`u/${unitOf(key)}`, "n"]],
    points.map((p) => [String(p.target), String(p.run), approach(p.direction).name, fixed(p.position_mm, 4), fixed(p[key], decimals(p.u[key], 4)), fixed(p.u[key], decimals(p.u[key]))])));
}

// Shows an imported run: one error at each reading, and the positioning figures.
function showImported(body, run, points, runs, opened) {
  const keys = errorKeys(points[0]), charts = new ErrorCharts(keys), figures = Object.entries(run.uncertainty ?? {});
  opened.push(charts);
  body.replaceChildren(h("h2", {}, `Run ${run.run}, axis ${run.axis}: imported`),
    h("div", {class: "columns"}, headOfImported(run), h("div", {}, partners(run, runs), covers(run))), notices(run.notices) ?? "",
    h("h2", {}, "Readings"), charts.element,
    h("p", {class: "quiet"}, "Deviations are actual − nominal, as in the file. Blue solid line: forward; orange dashed line: reverse; marks without a line: approach unknown."), readings(points),
    h("h2", {}, "Results according to ISO 230-2"), run.uncertainty_reason ? h("p", {}, `Not calculated: ${run.uncertainty_reason}.`) : "", figures.length === 0 ? ""
      : facts(figures.map(([key, figure]) => [titleOf(key), measured(figure, unitOf(key))])), actions(run.history) ?? "");
  charts.set(points);
}

export function openRun(place, id) {
  const body = h("div", {}, h("p", {class: "quiet"}, "Loading …"));
  const opened = [];
  place.append(h("p", {}, h("a", {href: "#runs"}, "← All runs")), body);
  async function read() {
    const [run, {points}, {runs}] = await Promise.all([call("run.get", {run: id}), pages("run.points", {run: id}, "points"), pages("run.list", {}, "runs", kMostPartners)]);
    if (run.imported) return showImported(body, run, points, runs, opened);
    const charts = new ErrorCharts(errorKeys(points.find((p) => errorKeys(p).length)));
    const straightness = new Straightness(run, points);
    opened.push(charts, ...straightness.charts.map(([, chart]) => chart));
    const wrong = h("div", {});
    body.replaceChildren(h("h2", {}, `Run ${run.run}, axis ${run.axis}`),
      h("div", {class: "columns"}, head(run), h("div", {}, partners(run, runs),
        kResumable.includes(run.state) ? h("p", {}, h("button", {onclick: () => resume(id, wrong)}, "Resume (continue as a new run)")) : null, wrong,
        covers(run))), notices(run.notices) ?? "",
      h("h2", {}, "Five errors"), charts.element,
      h("p", {class: "quiet"}, "Errors are actual − nominal. Blue solid line: forward; orange dashed line: reverse. Bands of the newest four passes: U (95 %) about each point. Bands of all older passes: from the smallest to the largest error, with the mean as a thin line."), pointsTable(points),
      straightness.element, h("h2", {}, "Angles"), angles(run, points), new Budget(run).element, actions(run.history) ?? "");
    charts.set(points);
    straightness.draw();
  }
  read().catch((error) => body.replaceChildren(problem(error)));
  return () => opened.forEach((chart) => chart.close());
}
