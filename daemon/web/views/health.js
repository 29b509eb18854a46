// The view Health: devices, clocks, queues, free disk space, calibrations, connected clients, and
// the reasons why functions are not available.
import {age, fixed, h, isNumber, problem, setRows, table, time} from "../dom.js";
import * as live from "../live.js";
import * as machine from "../machine.js";
import {call} from "../rpc.js";
import {facts} from "./run_detail.js";

const kRead_ms = 3000;
const GB = (bytes) => isNumber(bytes) ? `${fixed(bytes / 1e9, 1)} GB` : "not known";

// The reasons why functions are not available, in the words of mdofd. Each element is [place,
// text].
export function reasons(info, devices, compensation) {
  const found = [];
  if (info.storage !== "ok") found.push(["storage", `${info.storage}: ${info.storage_reason}`]);
  for (const d of devices) {
    if (d.error) found.push([`device ${d.device}`, `${d.state}: ${d.error}`]);
    else if (d.state !== "open") found.push([`device ${d.device}`, d.state]);
    for (const line of d.trouble) found.push([`device ${d.device}`, line]);
    if (d.clock && !d.clock.settled) found.push([`device ${d.device}`, "the drift of the device clock is not known yet"]);
  }
  for (const a of info.axes) {
    if (a.encoder.note) found.push([`encoder of ${a.axis}`, a.encoder.note]);
    for (const text of machine.state.newest.get(a.axis)?.value.trouble ?? [])  // a device has its own rows
      if (!text.startsWith("device ")) found.push([`axis ${a.axis}`, text]);
    const waiting = machine.state.newest.get(a.axis)?.value.waiting_for;
    if (waiting) found.push([`axis ${a.axis}`, `waits for ${waiting}`]);
    if (machine.isStale(a.axis)) found.push([`axis ${a.axis}`, `stale: ${machine.staleReason(a.axis)}`]);
    if (!compensation.axes[a.axis] && !compensation.volume) found.push([`compensation of ${a.axis}`, "no table is active, so mdofd serves no correction"]);
  }
  if (info.axes.length === 0) found.push(["configuration", "mdofd has no axis to measure; add an [[axis]] to mdofd.toml and restart mdofd"]);
  if (info.store_jobs_dropped + info.store_points_dropped > 0)
    found.push(["queues", `the disk was too slow, so mdofd dropped ${info.store_jobs_dropped} blocks of samples and ${info.store_points_dropped} points`]);
  if (info.calls_refused > 0) found.push(["calls", `mdofd refused ${info.calls_refused} calls, because too many calls were waiting`]);
  return found;
}

// Time in hours until the disk is full, if mdofd records without interruption at the data rate of
// the newest run.
export function hoursLeft(health, run) {
  const rate_hz = run?.plausibility?.rate_hz, bytes = health.newest_recording?.bytes;
  if (!isNumber(rate_hz) || !isNumber(bytes) || !isNumber(health.free_bytes) || !(run.scans > 0)) return null;
  return health.free_bytes / (bytes / (run.scans / rate_hz)) / 3600;
}

function daysTo(due) {
  const days = Math.ceil((Date.parse(`${due}T24:00:00Z`) - Date.now()) / 86_400_000);
  return days <= 0 ? "■ overdue" : days < 30 ? `▲ in ${days} days` : `● in ${days} days`;
}

function calibrations() {
  return machine.axes().map((axis) => [axis, machine.state.rigs.get(axis)]).filter(([, rig]) => rig).flatMap(([axis, rig]) => [
    ...rig.probes.map((p) => [`${axis}, probe ${p.id}`, p.certificate ?? "not stated", p.laboratory ?? "–", p.calibrated ?? "–", p.due ?? "–", p.due ? daysTo(p.due) : "▲ no due date"]),
    ...rig.records.map((r) => [`${axis}, ${r.kind} (calibration record)`, r.id, "–", r.date, r.valid_until, daysTo(r.valid_until)])]);
}

export function open(place) {
  const t = {
    why: table("Reasons", [["place", "w"], ["reason"]], []),
    devices: table("Devices", [["device", "w"], ["axis"], ["driver"], ["state", "w"], ["rate/Hz", "n"], ["scans", "n"], ["lost", "n"], ["dropped blocks", "n"], ["reopened", "n"], ["last error", "t"]], []),
    clocks: table("Clocks of the devices, compared with the clock of the mdofd computer", [["device", "w"], ["drift/ppm", "n"], ["jitter/ms", "n"], ["settled"], ["steps", "n"]], []),
    calibrations: table("Calibrations", [["calibrated item", "w"], ["certificate"], ["laboratory"], ["calibrated", "w"], ["due", "w"], ["state", "w"]], []),
  };
  const fine = h("p", {}), server = h("div", {}), storage = h("div", {}), clients = h("div", {}), wrong = h("div", {role: "alert"});
  place.append(wrong, h("section", {class: "panel"}, h("h2", {}, "Problems and reasons"), fine, t.why),
    h("div", {class: "columns"}, h("section", {class: "panel"}, h("h2", {}, "mdofd"), server), h("section", {class: "panel"}, h("h2", {}, "Storage"), storage),
      h("section", {class: "panel"}, h("h2", {}, "Connected clients"), clients)),
    h("section", {}, h("h2", {}, "Devices"), t.devices), h("section", {}, h("h2", {}, "Clocks"), t.clocks), h("section", {}, h("h2", {}, "Calibrations"), t.calibrations));
  let sized = null;  // the newest run with a recording; its data rate is known
  async function read() {
    if (document.hidden) return;
    try {
      const [info, {devices}, compensation, health] = await Promise.all([call("server.info"), call("device.list"), call("compensation.status"), call("server.health")]);
      const newest = health.newest_recording?.run;
      if (newest && (sized?.run !== newest || ["open", "ended"].includes(sized.state))) sized = await call("run.get", {run: newest});
      const why = reasons(info, devices, compensation), hours = hoursLeft(health, sized);
      setRows(t.why, why);
      t.why.hidden = why.length === 0;
      fine.textContent = why.length === 0 ? "● Everything works." : `▲ ${why.length} ${why.length === 1 ? "entry needs" : "entries need"} attention.`;
      server.replaceChildren(facts([["Version", info.version], ["Started", time(info.started_utc)], ["Running for", age(info.uptime_s)], ["Generation of the active tables", String(info.generation)],
        ["Blocks dropped (disk too slow)", String(info.store_jobs_dropped)], ["Points dropped (disk too slow)", String(info.store_points_dropped)], ["Calls refused", String(info.calls_refused)],
        ["Chain of hashes", info.chain.link ? `link ${info.chain.link}, ${info.chain.sha256.slice(0, 16)} …` : "empty"]]));
      storage.replaceChildren(facts([["State", info.storage === "ok" ? "● ok" : `■ ${info.storage}: ${info.storage_reason}`], ["Free disk space", GB(health.free_bytes)],
        ["Time until the disk is full", hours === null ? "not known, because no run was recorded yet" : `${fixed(hours, 0)} h at the rate of run ${newest}`],
        ["Database", `${info.database}, ${isNumber(health.database_bytes) ? fixed(health.database_bytes / 1e6, 1) : "–"} MB`]]));
      clients.replaceChildren(h("ul", {}, health.clients.map((c) => h("li", {}, c))));
      setRows(t.devices, devices.map((d) => [d.device, d.axis, d.driver, (d.state === "open" ? "● " : "■ ") + d.state, fixed(d.rate_hz, 0), String(d.scans), String(d.scans_lost), String(d.blocks_dropped),
        String(d.reopened), d.error ?? d.last_error ?? "none"]));
      setRows(t.clocks, devices.map((d) => d.clock ? [d.device, fixed(d.clock.drift_ppm, 2), fixed(d.clock.jitter_ms, 3), d.clock.settled ? "● yes" : "▲ not yet", String(d.clock.steps)]
        : [d.device, "–", "–", "uses the clock of the mdofd computer", "–"]));
      setRows(t.calibrations, calibrations());
      wrong.replaceChildren();
    } catch (error) {
      wrong.replaceChildren(problem(error));
    }
  }
  read();
  const timer = setInterval(read, kRead_ms), off = live.on("gap", read);
  return () => { clearInterval(timer); off(); };
}
