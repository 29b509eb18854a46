// The view Set-up: the reading of each probe in its range, the necessary shims, the check of the
// signs, and the devices.
import {age, field, fixed, h, isNumber, problem, select, setRows, setText, table} from "../dom.js";
import * as live from "../live.js";
import * as machine from "../machine.js";
import {call} from "../rpc.js";

const kText_ms = 120;      // interval of new numbers, ms; a user must be able to read them
const kNoise = 60;         // number of values at rest from which the noise is calculated
const kLeastFreedom = 9;   // with fewer degrees of freedom the noise is not shown
const kOffCentre = 0.5, kNearEnd = 0.8;  // limits as shares of half the range
const kCentred = 0.1;      // a probe within this share of half the range needs no shim
const kUsable = ["good", "simulated"];

// A direction as text: "+Z", or the vector if it is not along an axis.
export function along(direction) {
  const k = direction.findIndex((x) => Math.abs(Math.abs(x) - 1) < 1e-6);
  return k < 0 ? `(${direction.map((x) => fixed(x, 3)).join(", ")})` : (direction[k] < 0 ? "−" : "+") + "XYZ"[k];
}
const opposite = (direction) => along(direction.map((x) => -x));

// The noise: the standard deviation from the mean of each stop, pooled over the last stops. This
// way the motion between stops does not count as noise.
export class Noise {
  values = [];  // values of the present stop
  stops = [];   // earlier stops: [degrees of freedom, sum of squares]
  add(x, still) {
    if (still && isNumber(x)) {
      this.values.push(x);
      if (this.values.length > kNoise) this.values.shift();
    } else if (!still && this.values.length > 0) {
      this.stops.push(this.now());
      this.values = [];
      while (this.stops.length > 1 && this.stops.slice(1).reduce((n, [freedom]) => n + freedom, 0) >= kNoise) this.stops.shift();
    }
  }
  get mean() { return this.values.reduce((a, x) => a + x, 0) / this.values.length; }
  now() {
    const {values, mean} = this;
    return [Math.max(values.length - 1, 0), values.reduce((a, x) => a + (x - mean) ** 2, 0)];
  }
  // [standard deviation, degrees of freedom]; null: too few values.
  get pooled() {
    const parts = [...this.stops, this.now()];
    const freedom = parts.reduce((n, [f]) => n + f, 0);
    return freedom < kLeastFreedom ? null : [Math.sqrt(parts.reduce((sum, [, ss]) => sum + ss, 0) / freedom), freedom];
  }
}

// The state of a probe: CSS class, shape, word.
export function stateOf(um, quality, low, high, stale) {
  if (stale) return ["invalid", "✕", "stale"];
  if (!kUsable.includes(quality)) return ["invalid", "■", quality.replaceAll("_", " ")];
  if (!isNumber(um)) return ["invalid", "✕", "no reading"];
  const share = Math.abs(um - (low + high) / 2) / ((high - low) / 2);
  if (share > kNearEnd) return ["doubtful", "▲", "near the end of the range"];
  return share > kOffCentre ? ["doubtful", "◆", "off centre"] : ["good", "●", "in range"];
}

// A text with the necessary shim. If the target is outside the range of the probe, the reading is
// the end of the range; the necessary shim is then larger than the text states by an unknown
// amount, and the text says "at least".
export function shimText(um, probe, quality = "good") {
  if (!isNumber(um) || !(kUsable.includes(quality) || quality === "over_range")) return "Shim: not known, because the probe has no usable reading";
  const off = um - (probe.low_um + probe.high_um) / 2, least = quality === "over_range" ? "at least " : "";
  if (Math.abs(off) < kCentred * (probe.high_um - probe.low_um) / 2) return "Centred: no shim needed";
  const probeTowards = off > 0 ? along(probe.direction) : opposite(probe.direction);
  const targetTowards = off > 0 ? opposite(probe.direction) : along(probe.direction);
  return `Shim ${least}${fixed(Math.abs(off), 1)} µm: move the probe towards ${probeTowards}, or the target towards ${targetTowards}`;
}

// A text with the minimum and maximum reading of the last second. They are useful because there are
// many readings between two updates.
export function rangeText(low_um, high_um) {
  return isNumber(low_um) && isNumber(high_um) ? `Last second: ${fixed(low_um, 2)} to ${fixed(high_um, 2)} µm` : "Last second: no reading";
}

class ProbeCard {
  noise = new Noise();
  constructor(probe) {
    this.probe = probe;
    this.value = h("span", {class: "value"}, "–");
    this.needle = h("span", {class: "needle"});
    this.swing = h("span", {class: "swing"});
    this.bar = h("div", {class: "bar", role: "meter", "aria-label": `Probe ${probe.id} within its range`,
      "aria-valuemin": probe.low_um, "aria-valuemax": probe.high_um, "aria-valuenow": 0}, h("span", {class: "middle"}), this.swing, this.needle);
    this.shape = h("span", {class: "shape", "aria-hidden": "true"});
    this.word = h("span", {});
    this.state = h("p", {class: "state"}, this.shape, " ", this.word);
    this.shim = h("p", {class: "shim"});
    this.range = h("p", {class: "quiet"});
    this.quiet = h("p", {class: "quiet"});
    this.element = h("section", {class: "probe", "aria-label": `Probe ${probe.id}`},
      h("div", {class: "head"}, h("h2", {}, probe.id, h("small", {}, ` ${along(probe.direction)}`)), this.state),
      h("p", {class: "number"}, this.value, h("span", {class: "unit"}, " µm")), this.bar,
      h("p", {class: "ends"}, h("span", {}, `${fixed(probe.low_um, 0)} µm`), h("span", {}, `${fixed(probe.high_um, 0)} µm`)),
      this.range, this.shim, this.quiet);
  }
  draw({um, quality, low_um: lowest, high_um: highest}, stale) {
    const {low_um: low, high_um: high} = this.probe;
    const place = (x) => Math.min(Math.max((x - low) / (high - low), 0), 1) * 100;
    const [kind, shape, word] = stateOf(um, quality, low, high, stale);
    if (this.element.dataset.state !== kind) this.element.dataset.state = kind;
    setText(this.shape, shape);
    setText(this.word, word);
    setText(this.value, fixed(um, 2));
    this.bar.setAttribute("aria-valuenow", isNumber(um) ? um.toFixed(2) : low);
    this.needle.hidden = !isNumber(um);
    this.needle.style.left = `${place(um)}%`;
    this.swing.hidden = !isNumber(lowest) || stale;
    this.swing.style.left = `${place(lowest)}%`;
    this.swing.style.width = `${place(highest) - place(lowest)}%`;
    setText(this.range, stale ? "" : rangeText(lowest, highest));
    setText(this.shim, stale ? "Shim: not known, because the values are stale" : shimText(um, this.probe, quality));
    const {pooled} = this.noise;
    setText(this.quiet, pooled === null ? "Noise: shown when the axis is at rest" : `Noise s = ${fixed(pooled[0], 4)} µm (${pooled[1]} degrees of freedom, at rest)`);
  }
}

// The check of the signs: the user pushes the target, and the page checks that each reading changes
// with the sign that the rig declares.
class SignCheck {
  base = null;
  constructor(cards) {
    this.cards = cards;
    this.push = select([["", "choose …"], ...["+X", "−X", "+Y", "−Y", "+Z", "−Z"].map((d) => [d, d])], "", () => this.draw());
    this.rows = cards.map((card) => [h("td", {class: "n"}, "–"), h("td", {}, "–")]);
    this.start = h("button", {type: "button", onclick: () => this.begin()}, "Start: use these readings as zero");
    this.element = h("section", {class: "panel"}, h("h2", {}, "Sign check"),
      h("p", {}, "Stop the axis and press Start. Then push the target lightly along one direction of the machine. The reading " +
        "of each probe along this direction must rise if you push in the direction of the probe (column “measures”), and fall if you push in the opposite direction. If a sign is reversed, a compensation doubles the error."),
      h("div", {class: "buttons"}, field("I push the target towards", this.push), this.start),
      table("Change since the start", [["probe"], ["measures"], ["change/µm", "n"], ["verdict"]],
        cards.map((card, i) => h("tr", {}, h("th", {scope: "row"}, card.probe.id), h("td", {}, along(card.probe.direction)), ...this.rows[i]))));
  }
  begin() {
    this.base = this.cards.map((card) => !isNumber(card.last) ? null : card.noise.values.length ? card.noise.mean : card.last);
    this.start.textContent = "Start again";
    this.draw();
  }
  draw() {
    if (!this.base) return;
    const push = this.push.value && [0, 1, 2].map((k) => "XYZ"[k] !== this.push.value[1] ? 0 : this.push.value[0] === "+" ? 1 : -1);
    this.cards.forEach((card, i) => {
      const change = isNumber(card.last) && isNumber(this.base[i]) ? card.last - this.base[i] : null;
      setText(this.rows[i][0], fixed(change, 2));
      setText(this.rows[i][1], verdict(change, card, push));
    });
  }
}

export function verdict(change, card, push) {
  const least = Math.max(0.5, 6 * (card.noise.pooled?.[0] ?? 0));
  if (!isNumber(change)) return "✕ no reading";
  if (Math.abs(change) < least) return "no change yet";
  if (!push) return change > 0 ? "rises" : "falls";
  const expected = push.reduce((a, x, k) => a + x * card.probe.direction[k], 0);
  if (Math.abs(expected) < 0.2) return "◆ changes, although the probe measures at right angles to the push";
  return expected * change > 0 ? "● as the rig states"
    : `■ REVERSED: check "measures" and "reads" of probe ${card.probe.id} in the rig`;
}

class Devices {
  before = new Map();  // device -> {scans, at}
  constructor() {
    this.table = table("Devices of this axis",
      [["device", "w"], ["state", "w"], ["problem", "t"], ["driver"], ["rate/Hz", "n"], ["nominal/Hz", "n"], ["lost scans", "n"]], []);
    this.wrong = h("div", {});
    this.element = h("section", {class: "panel"}, h("h2", {}, "Devices"), this.table, this.wrong);
  }
  async read(axis) {
    if (document.hidden) return;
    try {
      const {devices} = await call("device.list");
      setRows(this.table, devices.filter((d) => d.axis === axis).map((d) => this.row(d)));
      this.wrong.replaceChildren();
    } catch (error) {
      this.wrong.replaceChildren(problem(error));
    }
  }
  row(d) {
    const now = performance.now(), last = this.before.get(d.device);
    this.before.set(d.device, {scans: d.scans, at: now});
    const rate = last && now > last.at ? (d.scans - last.scans) / (now - last.at) * 1000 : null;
    return [d.device, (d.state === "open" ? "● " : "■ ") + d.state, [d.error, ...d.trouble].filter(Boolean).join("; ") || "none",
      d.driver, rate === null ? "–" : fixed(rate, 0), fixed(d.rate_hz, 0), String(d.scans_lost)];
  }
}

function errorsText(errors) {
  return errors ? Object.entries(errors).map(([key, x]) => key.endsWith("_urad")
    ? [key.slice(0, 3), fixed(x, 2), "µrad"] : [key.slice(0, 3), fixed(x, 3), "µm"]) : [];
}

export function open(place, [asked]) {
  const axes = machine.axes();
  const axis = axes.includes(asked) ? asked : axes[0];
  if (!axis) {
    place.append(machine.state.error ? problem(machine.state.error)
      : h("p", {class: "notice"}, "mdofd has no axis to measure; add an [[axis]] to mdofd.toml and restart mdofd."));
    return machine.onChange(() => { if (machine.axes().length) location.reload(); });
  }
  const rig = machine.state.rigs.get(axis), drawn_of = JSON.stringify(rig);
  const cards = rig.probes.map((probe) => new ProbeCard(probe));
  const cardOf = new Map(cards.map((card) => [card.probe.id, card]));
  const check = new SignCheck(cards), devices = new Devices();
  const where = h("p", {class: "where"}), stale = h("p", {class: "quiet"}), errors = h("dl", {class: "errors"});
  place.append(
    h("div", {class: "buttons"}, axes.map((a) => h("a", {class: "button", href: `#setup/${a}`, "aria-current": a === axis ? "true" : null}, `Axis ${a}`)),
      h("span", {class: "quiet"}, rig.rig)),
    where, stale, h("div", {class: "probes"}, cards.map((card) => card.element)),
    h("div", {class: "columns"},
      h("section", {class: "panel"}, h("h2", {}, "Errors now"), h("p", {class: "quiet"},
        "Present errors at the fixture (actual − nominal). U is calculated only for the points of a run."), errors),
      devices.element),
    check.element);

  const keys = new Map();  // error -> its element <dd>
  function drawErrors(value) {
    for (const [name, x, unit] of errorsText(value)) {
      if (!keys.has(name)) {
        keys.set(name, h("dd", {}));
        errors.append(h("dt", {}, name), keys.get(name));
      }
      setText(keys.get(name), `${x} ${unit}`);
    }
    if (!value) for (const dd of keys.values()) setText(dd, "no value");
  }

  let drawn = 0;
  function draw(value) {
    if (document.hidden) return;
    const now = performance.now();
    if (now - drawn < kText_ms) return;
    drawn = now;
    const old = machine.isStale(axis);
    for (const p of value.probes) cardOf.get(p.id)?.draw(p, old);
    setText(where, machine.placeText(value, 4) +
      (value.run ? `, run ${value.run}` : "") + (value.waiting_for ? `, waiting for ${value.waiting_for}` : ""));
    drawErrors(old ? null : value.errors);
    check.draw();
  }
  function take(value) {
    if (value.axis !== axis) return;
    for (const p of value.probes) {
      const card = cardOf.get(p.id);
      if (!card) continue;
      card.last = kUsable.includes(p.quality) ? p.um : null;
      card.noise.add(p.um, value.still && kUsable.includes(p.quality));
    }
    draw(value);
  }
  const newest = machine.state.newest.get(axis);
  if (newest) draw(newest.value);
  devices.read(axis);
  const timers = [
    setInterval(() => devices.read(axis), 2000),
    setInterval(() => {
      const last = machine.state.newest.get(axis);
      setText(stale, last ? `Age of the values: ${age(machine.ageOf(axis))}` : "No values yet");
      place.classList.toggle("stale", machine.isStale(axis));
      if (!last || !machine.isStale(axis)) return;
      for (const card of cards) card.last = null;
      draw(last.value);
    }, 300)];
  const off = live.on("live.update", take);
  // After a restart, mdofd can have another rig, with other directions, ranges or probes.
  const offRig = machine.onChange(() => {
    const now = machine.state.rigs.get(axis);
    if (now && JSON.stringify(now) !== drawn_of) window.dispatchEvent(new HashChangeEvent("hashchange"));
  });
  return () => { off(); offRig(); timers.forEach(clearInterval); };
}
