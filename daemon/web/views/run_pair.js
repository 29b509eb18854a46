// Shows two runs of an axis in common charts, with the difference of each error; or the squareness
// of two axes.
import {Chart, errorKeys, means, plain} from "../charts.js";
import {covers, h, measured, nameOf, notices, problem, short, table, time, titleOf, unitOf} from "../dom.js";
import {budgetBars, squarenessPicture, squarenessSign} from "../pictures.js";
import {call, pages} from "../rpc.js";
import {isImported} from "./run_detail.js";

const kSame_mm = 0.01;  // if two targets are closer than this, they are the same target

// A map target -> a - b, for the targets that both runs have.
export function difference(a, b) {
  const found = new Map();
  for (const [x, value] of a)
    for (const [other, y] of b) if (Math.abs(x - other) <= kSame_mm) found.set(x, value - y);
  return found;
}

// The difference of two runs at each target: the mean over the approaches that both runs have
// there. An approach that only one run has is not used, because it would add the reversal error.
export function differenceOfRuns(a, b, key) {
  const found = new Map();
  for (const d of [1, -1])
    for (const [x, value] of difference(means(a, key, d), means(b, key, d))) found.set(x, [...found.get(x) ?? [], value]);
  return new Map([...found].map(([x, all]) => [x, all.reduce((sum, v) => sum + v, 0) / all.length]).sort((p, q) => p[0] - q[0]));
}

function seriesOf(name, points, key, colour, wide) {
  return [1, -1].map((d) => ({label: `${name} ${d > 0 ? "forward" : "reverse"}`, colour, wide, dash: d < 0, points: plain(means(points, key, d))}));
}

function pairCharts(key, a, b) {
  const unit = unitOf(key), gap = differenceOfRuns(a.points, b.points, key);
  const over = new Chart(`${nameOf(key)} in ${unit}: both runs`, unit, {height_px: 200});
  const apart = new Chart(`${nameOf(key)} in ${unit}: run ${a.run} − run ${b.run}`, unit, {height_px: 140});
  const largest = Math.max(...[...gap.values()].map(Math.abs));
  const draw = () => {
    over.set([...seriesOf(`run ${a.run}`, a.points, key, "blue", true), ...seriesOf(`run ${b.run}`, b.points, key, "orange")]);
    apart.set([{label: "difference", colour: "text", points: plain(gap)}], `Largest difference ${short(largest)} ${unit}`);
  };
  return {charts: [over, apart], draw, element: h("div", {}, over.element, apart.element,
    h("p", {}, gap.size === 0 ? "The runs have no target in common." : `Largest difference between the means of the runs (only for approaches that were measured in both runs): ${short(largest)} ${unit}`))};
}

const effects = {reduced: "▼ reduced", increased: "▲ increased", "not shown": "● not shown", changed: "◆ changed in sign or shape"};

const figures = (found, first, second) => table(`Results of run ${first} (before) and run ${second} (after). “not shown”: the change is not larger than its U. “changed”: the magnitude is the same within U, but the sign or the shape has changed`,
  [["result"], [`run ${first}`, "w"], [`run ${second}`, "w"], ["change of |value|", "w"], ["effect", "w"]],
  Object.entries(found.figures).map(([key, f]) => [titleOf(key), measured(f.before, unitOf(key), {with_k: false}), measured(f.after, unitOf(key), {with_k: false}),
    measured(f.change, unitOf(key), {with_k: false}), effects[f.effect] ?? f.effect]));

// Two imported runs may have opposite sign conventions. mdofd returns the values of both with the
// same convention.
function inOneSense({points}, after, before) {
  const of = (run, which) => ({run, points: points.flatMap((p) => [[1, "forward"], [-1, "reverse"]].map(([direction, side]) =>
    ({run: 1, direction, target_mm: p.position_mm, ...Object.fromEntries(Object.entries(p[side]).map(([key, of_key]) => [key, of_key[which]]))})))});
  return [of(after, "after"), of(before, "before")];
}

function back(run) {
  return h("p", {}, h("a", {href: `#runs/${run}`}, `← Run ${run}`));
}

export function openPair(place, first, second) {
  const body = h("div", {}, h("p", {class: "quiet"}, "Loading …"));
  const opened = [];
  place.append(back(first), body);
  async function read() {
    const [after, before] = [first, second];
    const heads = await Promise.all([after, before].map((run) => call("run.get", {run})));
    const [a, b] = heads.every(isImported) ? inOneSense(await call("run.compare", {before, after}), after, before)
      : await Promise.all([after, before].map((run) => pages("run.points", {run}, "points")));
    const pairs = errorKeys(a.points.find((p) => errorKeys(p).length)).map((key) => pairCharts(key, a, b));
    const table = h("div", {});
    opened.push(...pairs.flatMap((pair) => pair.charts));
    body.replaceChildren(h("h2", {}, `Run ${after} compared with run ${before}`),
      h("p", {}, `Run ${before} counts as the run before the compensation, and run ${after} as the run after the compensation. `, h("a", {href: `#runs/${before}/with/${after}`}, "Exchange the two runs")),
      h("p", {class: "quiet"}, `Means over all passes. Blue: run ${after}, orange: run ${before}; solid: forward, dashed: reverse. U is calculated for the results below, not for single differences.`),
      h("div", {class: "charts"}, pairs.map((pair) => pair.element)), h("h2", {}, "Results"), table);
    pairs.forEach((pair) => pair.draw());
    try {
      const found = await call("run.compare", {before, after});
      table.replaceChildren(figures(found, before, after), covers(found) ?? "", notices(found.notices) ?? "");
    } catch (error) {
      table.replaceChildren(problem(error));
    }
  }
  read().catch((error) => body.replaceChildren(problem(error)));
  return () => opened.forEach((chart) => chart.close());
}

export function openSquareness(place, first, second) {
  const body = h("div", {}, h("p", {class: "quiet"}, "Loading …"));
  place.append(back(first), body);
  async function read() {
    const heads = await Promise.all([first, second].map((run) => call("run.get", {run})));
    heads.sort((a, b) => a.axis < b.axis ? -1 : 1);
    const params = Object.fromEntries(heads.map((run) => [`run_${run.axis.toLowerCase()}`, run.run]));
    const found = await call("squareness.budget", params);
    const [key, budget] = Object.entries(found.figures)[0];
    const [a, b] = heads.map((run) => run.axis);
    const stored = h("div", {});
    const store = async () => {
      try {
        const fit = await call("squareness.fit", params);
        stored.replaceChildren(h("p", {class: "notice", role: "status"}, `● Stored as squareness ${fit.squareness}.`));
      } catch (error) {
        stored.replaceChildren(problem(error));
      }
    };
    body.replaceChildren(h("h2", {}, `Squareness of ${a} and ${b}: runs ${heads.map((run) => run.run).join(" and ")}`),
      h("div", {class: "columns"}, squarenessPicture(a, b, budget.value),
        h("div", {}, h("p", {class: "result"}, `${nameOf(key)} = ${measured(budget, "µrad")}`),
          h("p", {}, `The angle from +${a} to +${b} is 90° ${squarenessSign(a, b) > 0 ? "+" : "−"} ${nameOf(key)}. The picture exaggerates the deviation from 90°.`),
          heads.map((run) => h("p", {class: "quiet"}, `${run.axis}: run ${run.run}, ${time(run.started_utc)}, ${run.state}${run.simulated ? ", SIMULATED" : ""}`)),
          h("p", {}, h("button", {onclick: store}, "Store this squareness")), stored)),
      notices(found.notices) ?? "", h("h2", {}, "Uncertainty budget"), budgetBars(budget, "µrad"),
      covers(budget) ?? "");
  }
  read().catch((error) => body.replaceChildren(problem(error)));
}
