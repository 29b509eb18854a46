// The view Capture: a form that starts a run, then the five errors at each point during the run.
import {ErrorCharts, errorKeys} from "../charts.js";
import {ask, covers, field, fixed, h, isNumber, notices, problem, select, setText} from "../dom.js";
import * as live from "../live.js";
import * as machine from "../machine.js";
import {call, pages} from "../rpc.js";
import {kResumable} from "./run_detail.js";

const number = (form, key) => form.get(key) === "" || form.get(key) === null ? undefined : Number(form.get(key));

// Reads a list of targets. A comma between digits is an error, because it can be a decimal sign or
// a separator.
export function targetsFrom(text) {
  return text.split(/[\s;]+/).map((word) => word.replace(/,$/, "")).filter(Boolean).map((word) => {
    if (word.includes(",")) throw new Error(`target "${word}" is ambiguous; write a point for decimals (12.5) and a space between targets`);
    if (!Number.isFinite(Number(word))) throw new Error(`target "${word}" is not a number; write targets in mm, such as 0 12.5 25`);
    return Number(word);
  });
}

// The parameters of run.start from the form; empty fields are omitted. Throws an error if the
// targets are ambiguous.
export function request(form) {
  const params = {axis: form.get("axis"), note: form.get("note") || undefined, repeats: number(form, "repeats"),
    scale_period_um: number(form, "scale_period_um")};
  if (form.get("kind") === "even")
    for (const key of ["from_mm", "to_mm", "interval_mm", "jitter_mm", "seed"]) params[key] = number(form, key);
  if (form.get("kind") === "list")
    params.targets_mm = targetsFrom(form.get("targets_mm"));
  if (form.get("kind") === "free") params.repeats = undefined;
  return params;
}

// The fields that the user must fill in for each kind of targets. Without them the run would have
// no targets.
const kNeeded = {even: [["from_mm", "From/mm"], ["to_mm", "To/mm"], ["interval_mm", "Interval/mm"]], list: [["targets_mm", "Targets/mm"]], free: []};
export const emptyFields = (form) => kNeeded[form.get("kind")].filter(([key]) => !form.get(key)?.trim()).map(([, label]) => label);

// The number of stops of the axis that a run needs; null: unknown.
export function expected({from_mm, to_mm, interval_mm, targets_mm, repeats}) {
  const targets = targets_mm ? targets_mm.length
    : interval_mm > 0 && to_mm >= from_mm ? Math.floor((to_mm - from_mm) / interval_mm + 1e-9) + 1 : null;
  return targets === null ? null : {targets, points: repeats > 0 ? 2 * targets * repeats : null};
}

const kKinds = [["even", "at even intervals"], ["list", "listed"], ["free", "found from the stops of the axis (free run)"]];

class Wizard {
  constructor(started) {
    this.preview = h("p", {class: "quiet"});
    this.wrong = h("div", {});
    const input = (name, value, extra = {}) => h("input", {name, type: "number", step: "any", value, ...extra});
    this.even = h("div", {class: "fields"},
      field("From/mm", input("from_mm", 0)), field("To/mm", input("to_mm", 30)), field("Interval/mm", input("interval_mm", 10)),
      field("Jitter/mm", input("jitter_mm", 0, {min: 0}), "largest random shift of a target; random shifts reveal periodic errors"),
      field("Seed of the jitter", input("seed", 1, {min: 0, step: 1})));
    this.list = field("Targets/mm", h("textarea", {name: "targets_mm", rows: 2}), "in ascending order, separated by spaces; decimals with a point");
    this.repeats = field("Repeats", input("repeats", 5, {min: 0, max: 10000, step: 1}),
      "passes over the targets in each direction; the axis must move beyond the first and the last target. 0: the run ends when you stop it");
    this.kind = select(kKinds, "even", () => this.show(), {name: "kind"});
    this.element = h("form", {class: "panel", oninput: () => this.show(), onsubmit: (e) => { e.preventDefault(); this.start(started); }},
      h("h2", {}, "New run"),
      h("fieldset", {}, h("legend", {}, "1 Axis and note"), h("div", {class: "fields"},
        field("Axis", select(machine.state.info.axes.map((a) => [a.axis, `${a.axis}: ${a.rig}`]), null, null, {name: "axis"})),
        field("Note", h("input", {name: "note", maxlength: 1000}), "free text, stored with the run"))),
      h("fieldset", {}, h("legend", {}, "2 Targets"), field("Targets are", this.kind), this.even, this.list),
      h("fieldset", {}, h("legend", {}, "3 Repeats"), h("div", {class: "fields"}, this.repeats,
        field("Signal period of the scale/µm", input("scale_period_um", "", {min: 0}),
          "optional; mdofd then warns if the intervals between targets hide the periodic error of the scale"))),
      this.preview, this.wrong, h("p", {class: "buttons"}, h("button", {class: "main"}, "Start the run")));
    this.show();
  }
  show() {
    const kind = this.kind.value;
    this.even.hidden = kind !== "even";
    this.list.hidden = kind !== "list";
    this.repeats.hidden = kind === "free";
    const form = new FormData(this.element), missing = emptyFields(form);
    let count;
    try {
      count = expected(request(form));
    } catch (error) {
      setText(this.preview, error.message);
      return;
    }
    setText(this.preview, kind === "free" ? "mdofd finds the targets from the stops; the run ends when you stop it."
      : missing.length ? `Enter a value for ${missing.join(", ")}.` : count === null ? "Enter values for From, To and Interval; Interval must be above 0."
      : `${count.targets} targets` + (count.points ? `, ${count.points} points expected: each target forward and in reverse.` : "; the run ends when you stop it."));
  }
  async start(started) {
    const missing = emptyFields(new FormData(this.element));
    if (missing.length)
      return this.wrong.replaceChildren(problem(new Error(`Not started, because these fields are empty: ${missing.join(", ")}. Enter values, or choose "${kKinds[2][1]}" as the targets.`)));
    try {
      started(await call("run.start", request(new FormData(this.element))));
      this.wrong.replaceChildren();
    } catch (error) {
      this.wrong.replaceChildren(problem(error));
    }
  }
}

const kMostProblems = 100;

// The progress of a run whose events were not received. Only solved points count, and at most `repeats` points for each
// target and approach. The next target is known from the next event.
export function progressOf(points, {targets_mm, repeats}) {
  const ways = new Map();
  for (const p of points.filter((p) => errorKeys(p).some((key) => isNumber(p[key])))) ways.set(`${p.target} ${p.direction}`, (ways.get(`${p.target} ${p.direction}`) ?? 0) + 1);
  return {points: points.length, of: 2 * (targets_mm ?? []).length * (repeats ?? 0) || null, awaited_mm: null,
    done: [...ways.values()].reduce((n, k) => n + Math.min(k, repeats), 0)};
}

class Progress {
  points = [];
  constructor(axis, run, reply) {
    this.axis = axis;
    this.run = run;
    this.bar = h("progress", {"aria-label": `Progress of run ${run}`});
    this.where = h("p", {class: "where"}, "Waiting for the first stop");
    this.now = h("p", {});
    this.trouble = h("div", {role: "log", "aria-label": "Problems of devices and stops"});
    this.covers = h("div", {});
    this.charts = null;
    this.place = h("div", {});
    this.end = h("div", {});
    this.buttons = h("p", {class: "buttons"},
      h("button", {class: "main", onclick: () => this.stop(false)}, "Stop and evaluate"),
      h("button", {class: "danger", onclick: () => this.stop(true)}, "Abort …"));
    this.element = h("section", {class: "panel", "aria-label": `Run ${run}`},
      h("h2", {}, `Run ${run}, axis ${axis}`), this.where, this.now, this.bar, this.buttons, this.end,
      notices(reply?.notices), this.trouble, this.place,
      h("p", {class: "quiet"}, "Blue solid line: forward. Orange dashed line: reverse. Bands: U (95 %) about the errors at a single stop."), this.covers);
    this.offs = [live.on("run.event", (e) => this.event(e)), live.on("live.update", (v) => this.live(v)), live.on("gap", () => this.read())];
    this.read();
  }
  async read() {
    try {
      const page = await pages("run.points", {run: this.run}, "points");
      this.points = page.points;
      this.draw(page);
      // If mdofd restarts, it sends no event for the end of the run.
      const {state, options} = await call("run.get", {run: this.run});
      if (state === "open" && !this.over) this.progress(progressOf(this.points, options));
      if (state === "ended") setText(this.where, `Run ${this.run} has ended; mdofd has not stored the end of the run yet, because the storage is not available`);
      else if (state !== "open" && !this.over) this.ended({state, run: this.run});
    } catch (error) {
      if (this.points.length === 0) this.end.replaceChildren(problem(error));
    }
  }
  draw(of) {
    if (!this.charts && this.points.length) {
      const solved = this.points.find((p) => errorKeys(p).length);
      if (!solved) return;
      this.charts = new ErrorCharts(errorKeys(solved));
      this.place.append(this.charts.element);
    }
    if (of.u_covers !== this.said) {
      this.said = of.u_covers;
      this.covers.replaceChildren(...[covers(of)].filter(Boolean));
    }
    this.charts?.set(this.points);
  }
  event(e) {
    if (e.type === "trouble" && e.axis === this.axis) this.tell(`${e.device ? `${e.device}: ` : ""}${e.kind}: ${e.text}`);
    // e.run can be another run: the one that supersedes this run.
    if (e.type === "ended" && e.axis === this.axis && !this.over) return this.ended(e);
    if (e.type === "storage" && !this.over) this.read();
    if (e.run !== this.run) return;
    if (e.type === "left_out") this.tell(e.text);
    if (e.type === "points") {
      if (e.offset > this.points.length) return this.read();
      this.points.splice(e.offset, e.points.length, ...e.points);
      this.draw(e);
    }
    if (e.type === "progress") this.progress(e);
  }
  // Shows only the newest problems. The notices of the run contain all problems.
  tell(problem) {
    this.trouble.append(h("p", {class: "notice doubtful"}, `▲ ${problem}`));
    while (this.trouble.childElementCount > kMostProblems) this.trouble.firstElementChild.remove();
  }
  progress({points, of, done, awaited_mm}) {
    if (points === 0) return;
    if (of) {
      this.bar.max = of;
      this.bar.value = done;
    }
    setText(this.where, (of ? `${done} of ${of} points` : `${points} points`) +
      (awaited_mm !== null ? `; next target ${fixed(awaited_mm, 3)} mm` : ""));
  }
  live(v) {
    if (v.axis !== this.axis || document.hidden || this.over) return;
    setText(this.now, `Now: ${machine.placeText(v, 3)}`);
  }
  ended({state, run}) {
    this.over = true;
    this.buttons.hidden = this.bar.hidden = this.now.hidden = true;
    setText(this.where, `Run ${run} has ended: ${state}`);
    this.end.replaceChildren(h("p", {}, h("a", {class: "button", href: `#runs/${run}`}, `Show run ${run}`),
      kResumable.includes(state) ? " On that page you can resume the run." : null));
  }
  async stop(abort) {
    if (abort && !await ask(`Abort run ${this.run}?`, h("p", {},
      "The points stay stored, and the run is marked as aborted. No table can be built from an aborted run."), "Abort the run")) return;
    try {
      const {run, state} = await call("run.stop", {run: this.run, abort});
      if (!this.over) this.ended({state: state ?? (abort ? "aborted" : "stopped"), run});
    } catch (error) {
      this.end.replaceChildren(problem(error));
    }
  }
  close() {
    this.offs.forEach((off) => off());
    this.charts?.close();
  }
}

export function open(place) {
  const shown = new Map();  // run -> Progress
  const runs = h("div", {});
  const empty = h("div", {});
  place.append(runs, empty);
  const add = (axis, run, reply) => {
    if (shown.has(run)) return;
    shown.set(run, new Progress(axis, run, reply));
    runs.prepend(shown.get(run).element);
  };
  let wizard = null;
  function look() {
    if (!machine.state.info) return empty.replaceChildren(problem(machine.state.error ?? new Error("mdofd does not answer")));
    for (const a of machine.state.info.axes) if (a.run) add(a.axis, a.run);
    if (wizard) return;
    if (machine.axes().length === 0) {
      empty.replaceChildren(h("p", {class: "notice"}, "mdofd has no axis to measure; add an [[axis]] to mdofd.toml and restart mdofd."));
      return;
    }
    wizard = new Wizard((reply) => {
      add(reply.axis, reply.run, reply);
      shown.get(reply.run).element.scrollIntoView();
    });
    empty.replaceChildren(wizard.element);
  }
  look();
  const off = machine.onChange(look);
  return () => {
    off();
    for (const one of shown.values()) one.close();
  };
}
