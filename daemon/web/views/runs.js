// The view Runs: the list of runs, one run, two compared runs, the squareness from two runs,
// control charts.
import {field, h, problem, select, setRows, table, time} from "../dom.js";
import * as live from "../live.js";
import {call} from "../rpc.js";
import {isImported, openRun} from "./run_detail.js";
import {openPair, openSquareness} from "./run_pair.js";
import {openTrend} from "./run_trend.js";

const kPage = 100;
const kStates = ["complete", "partial", "open", "ended", "aborted", "failed"];

const headOf = (run) => h("a", {href: `#runs/${run.run}`}, String(run.run));
const rowOf = (run) => [headOf(run), run.axis, (run.state === "complete" ? "● " : "▲ ") + run.state, time(run.started_utc),
  run.simulated ? "SIMULATED" : isImported(run) ? "imported" : "measured", String(run.notices.length), run.supersedes ? `run ${run.supersedes}` : "", run.note];

export class RunList {
  runs = [];
  total = 0;
  filter = {axis: "", state: "", text: ""};
  constructor() {
    this.table = table("Runs, newest first", [["run"], ["axis"], ["state", "w"], ["started", "w"], ["data"], ["notices", "n"],
      ["supersedes"], ["note"]], []);
    const choose = (key, all, values) => select([["", all], ...values.map((v) => [v, v])], "", (v) => { this.filter[key] = v; this.draw(); });
    this.count = h("p", {class: "quiet", role: "status"});
    this.more = h("button", {type: "button", onclick: () => this.read()}, "Load older runs");
    this.wrong = h("div", {});
    this.element = h("div", {}, h("div", {class: "fields", role: "search", "aria-label": "Filter of runs"},
      field("Axis", choose("axis", "all", ["X", "Y", "Z"])), field("State", choose("state", "all", kStates)),
      field("Note contains", h("input", {type: "search", oninput: (e) => { this.filter.text = e.target.value.toLowerCase(); this.draw(); }}))),
    h("p", {}, h("a", {href: "#runs/trend"}, "Control charts of the stored runs")), this.count, this.table, this.wrong, this.more);
  }
  async read(again = false) {
    try {
      const page = await call("run.list", {offset: again ? 0 : this.runs.length, count: kPage});
      this.runs = again ? page.runs : [...this.runs, ...page.runs];
      this.total = page.total;
      this.draw();
    } catch (error) {
      this.wrong.replaceChildren(problem(error));
    }
  }
  draw() {
    const {axis, state, text} = this.filter;
    const shown = this.runs.filter((r) => (!axis || r.axis === axis) && (!state || r.state === state) &&
      (r.note ?? "").toLowerCase().includes(text));
    setRows(this.table, shown.map(rowOf));
    this.count.textContent = `${shown.length} of ${this.total} runs` +
      (this.runs.length < this.total ? `; only the newest ${this.runs.length} are searched` : "");
    this.more.hidden = this.runs.length >= this.total;
  }
}

export function open(place, [run, how, other]) {
  if (run === "trend") return openTrend(place);
  if (run && how === "with") return openPair(place, Number(run), Number(other));
  if (run && how === "square") return openSquareness(place, Number(run), Number(other));
  if (run) return openRun(place, Number(run));
  const list = new RunList();
  place.append(list.element);
  list.read();
  const off = live.on("run.event", ({type}) => { if (type === "started" || type === "ended") list.read(true); });
  return off;
}
