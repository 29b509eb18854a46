// Shows the corrections of a volumetric table over a plane or a volume as arrows and as a heat map,
// seen from the front of the machine.
import {change} from "../activation.js";
import {covers, decimals, field, fixed, h, isNumber, problem, s, select, table, time} from "../dom.js";
import * as live from "../live.js";
import {call, pages} from "../rpc.js";
import {facts} from "./run_detail.js";

const kAxes = "XYZ";
// For each plane: index of the axis to the right, index of the upward axis, description of the
// view.
const kPlanes = {XY: [0, 1, "from above: X to the right, Y to the back"], XZ: [0, 2, "from the front: X to the right, Z up"],
  YZ: [1, 2, "from the right side: Y to the right, Z up"]};
const kWidth = 760, kEdge = 60;
const kMostRows = 1000;  // largest number of rows in the table of nodes

const size = ([, , , x, y, z]) => Math.hypot(x, y, z);

// The nodes of one layer: those whose third axis is at `at_mm`.
export function layer(nodes, plane, at_mm) {
  const third = [0, 1, 2].find((k) => k !== kPlanes[plane][0] && k !== kPlanes[plane][1]);
  return nodes.filter((n) => Math.abs(n[third] - at_mm) < 1e-6);
}

function arrow(x, y, dx, dy) {
  const length = Math.hypot(dx, dy);
  if (length < 1) return s("circle", {class: "ink-dot", cx: x, cy: y, r: 1.5});
  const [ux, uy] = [dx / length, dy / length], head = Math.min(6, length);
  const [tx, ty] = [x + dx, y + dy], [bx, by] = [tx - head * ux, ty - head * uy];
  return s("path", {class: "ink", d: `M${x} ${y}L${tx} ${ty}M${bx - head / 2 * uy} ${by + head / 2 * ux}L${tx} ${ty}L${bx + head / 2 * uy} ${by - head / 2 * ux}`});
}

// The picture of one layer. A millimetre has the same length along both axes. The largest arrow is
// as long as one step of the grid.
export function planePicture(nodes, plane, largest_um) {
  const [a, b, view] = kPlanes[plane];
  const values = (k) => [...new Set(nodes.map((n) => n[k]))].sort((x, y) => x - y);
  const xs = values(a), ys = values(b);
  const step = Math.min(...[xs, ys].flatMap((list) => list.slice(1).map((x, i) => x - list[i])), 1e9);
  const span = Math.max(xs.at(-1) - xs[0], 1e-9), tall = Math.max(ys.at(-1) - ys[0], 1e-9);
  const scale = Math.min((kWidth - 2 * kEdge) / (span + step), 600 / (tall + step)), cell = step * scale;
  const edge = kEdge + cell / 2, height = tall * scale + 2 * edge;
  const place = (n) => [edge + (n[a] - xs[0]) * scale, height - edge - (n[b] - ys[0]) * scale];
  const largestInPlane = Math.max(...nodes.map((n) => Math.hypot(n[3 + a], n[3 + b])), 1e-12);
  const long = 0.9 * cell / largestInPlane;
  const text = (x, y, content, anchor = "middle") => s("text", {x, y, "text-anchor": anchor}, content);
  return [s("svg", {class: "picture wide", viewBox: `0 0 ${span * scale + 2 * edge} ${height}`, role: "img",
    "aria-label": `Corrections in the plane ${plane}, seen ${view}; the largest is ${fixed(largest_um, 3)} µm`},
  nodes.map((n) => { const [x, y] = place(n); return s("rect", {class: "heat", x: x - cell / 2, y: y - cell / 2, width: cell, height: cell,
    "fill-opacity": 0.75 * size(n) / largest_um}); }),
  nodes.map((n) => arrow(...place(n), n[3 + a] * long, -n[3 + b] * long)),
  [xs[0], xs.at(-1)].map((x) => text(edge + (x - xs[0]) * scale, height - kEdge + 22, fixed(x, 1))), text(edge + span * scale / 2, height - kEdge + 22, `${kAxes[a]}/mm`),
  [ys[0], ys.at(-1)].map((y) => text(kEdge - 26, height - edge - (y - ys[0]) * scale + 4, fixed(y, 1))), text(kEdge - 26, kEdge - 14, `${kAxes[b]}/mm`)),
  h("p", {class: "quiet"}, `Seen ${view}. Longest arrow: ${fixed(largestInPlane, 3)} µm in the plane. A stronger blue shows a longer correction vector X, Y, Z (0 to ${fixed(largest_um, 3)} µm).`)];
}

// Reads the grid in pages. All pages must have the same generation; if the generation changes,
// mdofd rejects the call.
async function grid(generation) {
  const nodes = [];
  for (;;) {
    const page = await call("compensation.grid", {axis: "volume", offset: nodes.length, generation});
    nodes.push(...page.points);
    if (page.points.length === 0 || nodes.length >= page.nodes) return nodes;
  }
}

function largestText(nodes) {
  const n = nodes.reduce((a, b) => size(b) > size(a) ? b : a);
  return "Largest correction at " + [0, 1, 2].map((k) => `${kAxes[k]} ${fixed(n[k], 2)}`).join(", ") + " mm: " +
    [0, 1, 2].map((k) => `${kAxes[k]} ${fixed(n[3 + k], decimals(n[6 + k]))} µm (u ${isNumber(n[6 + k]) ? `${fixed(n[6 + k], decimals(n[6 + k]))} µm` : "not known"})`).join(", ");
}

function pictures(volume, nodes) {
  const several = [0, 1, 2].filter((k) => volume.command_mm[kAxes[k]].length > 1);
  const planes = Object.keys(kPlanes).filter((p) => several.includes(kPlanes[p][0]) && several.includes(kPlanes[p][1]));
  if (planes.length === 0) return h("p", {}, "No plane can be drawn, because fewer than two axes of this table have more than one node.");
  let plane = planes[0], at = null;
  const place = h("div", {}), layers = h("div", {});
  const largest = Math.max(...nodes.map(size), 1e-12);
  const draw = () => place.replaceChildren(...planePicture(layer(nodes, plane, at), plane, largest));
  const choose = (name) => {
    plane = name;
    const third = kAxes[[0, 1, 2].find((k) => !plane.includes(kAxes[k]))], places = volume.command_mm[third];
    at = places[0];
    layers.replaceChildren(field(`Layer at ${third}/mm`, select(places.map((x) => [x, fixed(x, 3)]), at, (x) => { at = Number(x); draw(); })));
    draw();
  };
  choose(plane);
  return h("div", {}, h("div", {class: "fields"}, field("Plane", select(planes.map((p) => [p, `${p}, ${kPlanes[p][2]}`]), plane, choose)), layers), place);
}

const rotaryText = ({rotary}) => Object.entries(rotary ?? {}).map(([name, deg]) => `${name.replace("_deg", "")} ${fixed(deg, 3)}°`).join(", ");
const placeText = (place) => place?.some((x) => x !== 0) ? `(${place.map((x) => fixed(x, 3)).join(", ")}) mm` : "";

function activeOf(volume, nodes) {
  return [h("h2", {}, `Table ${volume.table} of ${volume.machine}, generation ${volume.generation}`),
    h("p", {class: "result"}, largestText(nodes)),
    volume.simulated ? h("p", {class: "notice doubtful"}, "▲ SIMULATED: no machine was measured") : "",
    volume.not_measured.length ? h("p", {class: "notice doubtful"}, `▲ Not measured, so not corrected: ${volume.not_measured.join(", ")}`) : "",
    covers(volume) ?? "", pictures(volume, nodes),
    facts([["Rotary axes at", rotaryText(volume)], ["Tool point", placeText(volume.tool_point_mm)], ["Approach", volume.approach], ["Errors whose table does not cover the grid", volume.beyond_tables.join(", ")],
      ["Interpolation error", Object.entries(volume.interpolation).map(([k, x]) => `${k[0]} ${isNumber(x) ? fixed(x, 4) : "–"} µm`).join(", ")],
      ["Active since", `${time(volume.activated_utc)}, by ${volume.activated_by}`], ["Sense", volume.sense]]),
    h("details", {}, h("summary", {}, "All nodes with u"), table("Corrections at the nodes; u: standard uncertainty",
      [...["X/mm", "Y/mm", "Z/mm", "correction X/µm", "correction Y/µm", "correction Z/µm", "u X/µm", "u Y/µm", "u Z/µm"].map((c) => [c, "n"])],
      nodes.slice(0, kMostRows).map((n) => n.slice(0, 9).map((x, i) => fixed(x, i < 3 ? 3 : 4)))))];
}

// The stored tables, with buttons to activate them. While a table of an axis is active, mdofd
// rejects the activation of a volumetric table, because both together would correct an error twice.
function stored(tables, active, generation, done) {
  const act = async (method, params, question) => {
    try {
      await change(method, {...params, expected_generation: generation}, question);
      done();
    } catch (error) {
      done(error);
    }
  };
  const on = (t) => h("button", {"aria-label": `Activate table ${t.table} of the volume`, onclick: () => act("compensation.activate", {table: t.table},
    {title: `Activate table ${t.table} of the volume?`, action: "Activate", marks: {simulated: t.simulated, doubtful: null},
      text: h("p", {}, `${t.machine}, ${t.nodes} nodes, built ${time(t.created_utc)}.${active ? ` This table replaces table ${active.table}.` : ""}`)})}, "Activate …");
  const off = (t) => h("button", {class: "danger", "aria-label": `Deactivate table ${t.table} of the volume`, onclick: () => act("compensation.deactivate", {axis: "volume"},
    {title: "Deactivate the table of the volume?", action: "Deactivate", text: h("p", {}, `mdofd no longer serves table ${t.table} or any other correction for the volume.`)})}, "Deactivate …");
  return table("Stored tables of the volume, newest first", [["table"], ["state", "w"], ["machine"], ["nodes", "n"], ["data"], ["built", "w"], ["actions"]],
    tables.map((t) => [String(t.table), t.active ? "● active" : "stored", t.machine, String(t.nodes), t.simulated ? "SIMULATED" : "measured", time(t.created_utc), t.active ? off(t) : on(t)]));
}

export function openVolume(place) {
  const wrong = h("div", {}), unread = h("div", {}), body = h("div", {});
  place.append(wrong, unread, body);
  let turn = 0;
  async function read() {
    const mine = ++turn;
    const [{volume, generation}, {tables}] = await Promise.all([call("compensation.status"), pages("compensation.list", {axis: "volume"}, "tables")]);
    const now = volume ? activeOf(volume, await grid(volume.generation))
      : [h("p", {class: "notice"}, "No table of the volume is active. To build a table, use: ", h("code", {}, "mdof compensation build --machine"), ". Then activate the table on this page.")];
    if (mine !== turn) return;  // a newer reading is in progress
    unread.replaceChildren();
    body.replaceChildren(...now, tables.length ? stored(tables, volume, generation, done) : "");
  }
  const again = () => read().catch((error) => unread.replaceChildren(problem(error)));
  async function done(error) {
    await again();
    wrong.replaceChildren(...error ? [problem(error)] : []);
  }
  again();
  const offs = [live.on("run.event", ({type}) => { if (type === "compensation") again(); }), live.on("gap", again)];
  return () => offs.forEach((off) => off());
}
