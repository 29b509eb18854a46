// Data that all views use: the axes, the newest live value of each axis, the rigs, and the warnings
// that every view shows.
import {age, fixed} from "./dom.js";
import * as live from "./live.js";
import {call} from "./rpc.js";

const kStale_s = 2;          // an axis is stale after this time without a new value
const kFirst_ms = 3000;      // after the start of the page, a stream without messages is no fault before this time
const kRefresh_ms = 10_000;  // server.info is read at this interval, because some members (storage) change without an event

export const state = {
  info: null,         // server.info
  newest: new Map(),  // axis -> {value: live.update, at: performance.now()}
  rigs: new Map(),    // axis -> rig.get
  error: null,        // error of the last call
};
const changed = new Set();

// Calls the listener each time after server.info and the rigs were read.
export function onChange(listener) {
  changed.add(listener);
  return () => changed.delete(listener);
}

export const axes = () => (state.info?.axes ?? []).map((a) => a.axis);
export const axisInfo = (axis) => state.info?.axes.find((a) => a.axis === axis);

// Age of the newest values: their age when mdofd sent them, and the time since then.
export function ageOf(axis) {
  const newest = state.newest.get(axis);
  return newest ? newest.value.age_s + (performance.now() - newest.at) / 1000 : Infinity;
}
export const isStale = (axis) => ageOf(axis) > kStale_s || state.newest.get(axis).value.stale;

export async function refresh() {
  try {
    state.info = await call("server.info");
    state.error = null;
    await Promise.all(axes().map(async (axis) => state.rigs.set(axis, await call("rig.get", {axis}))));
  } catch (error) {
    state.error = error;
  }
  for (const listener of changed) listener();
}

// The place of the axis: "X at 12.5000 mm, at rest". Without a position nothing is known about the motion.
export function placeText({axis, encoder_mm, encoder_quality, still}, digits) {
  if (encoder_mm === null) return `${axis}: position unknown, because the encoder sends no position`;
  const usable = ["good", "simulated", "stale"].includes(encoder_quality);
  return `${axis} at ${fixed(encoder_mm, digits)} mm, ${still ? "at rest" : "moving"}` + (usable ? "" : `, position ${encoder_quality}`);
}

// If one device is silent, mdofd waits some seconds for it, and all values are late.
export function staleReason(axis) {
  const waits = state.newest.get(axis)?.value.waiting_for;
  return waits ? `the values are late, because ${waits === "encoder" ? "the encoder" : `probe ${waits}`} sends no samples` : "no new values arrive";
}

// [{kind, text, age}]. kind: CSS class of the line. age: age of the values in s. Screen readers do
// not read the age, because it changes all the time.
export function warnings() {
  const found = [];
  const all = axes();
  if (!live.isConnected() && performance.now() > kFirst_ms)
    found.push({kind: "invalid", text: "No connection to mdofd: all values shown are stale.",
      age: all.length ? Math.min(...all.map(ageOf)) : Infinity});
  else
    for (const axis of all.filter(isStale))
      found.push({kind: "invalid", text: `Axis ${axis} is stale: ${staleReason(axis)}.`, age: ageOf(axis)});
  for (const axis of all)
    for (const text of state.newest.get(axis)?.value.trouble ?? []) found.push({kind: "doubtful", text: `Axis ${axis}: ${text}`});
  const simulated = (state.info?.axes ?? []).filter((a) => a.simulated).map((a) => a.axis);
  if (simulated.length)
    found.push({kind: "doubtful", text: `SIMULATED: ${simulated.join(", ")}. No machine is measured.`});
  for (const [axis, rig] of state.rigs)
    for (const notice of rig.notices) found.push({kind: "doubtful", text: `Axis ${axis}: ${notice.text}`});
  if (state.info && state.info.storage !== "ok")
    found.push({kind: "invalid", text: `Storage ${state.info.storage}: ${state.info.storage_reason}`});
  return found;
}

export const ageText = (seconds) => Number.isFinite(seconds) ? ` Last value ${age(seconds)} ago.` : "";

export function start() {
  live.on("live.update", (value) => state.newest.set(value.axis, {value, at: performance.now()}));
  live.on("run.event", ({type}) => {
    if (["started", "ended", "compensation", "storage"].includes(type)) refresh();
  });
  live.on("gap", refresh);
  live.on("connected", (is) => { if (is) refresh(); });
  setInterval(() => { if (!document.hidden) refresh(); }, kRefresh_ms);
  return refresh();
}
