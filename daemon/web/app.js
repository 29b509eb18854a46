// The page. The text after "#" in the address selects the view. The page also has a banner with
// warnings, and a button for the token.
import {h, setText} from "./dom.js";
import * as live from "./live.js";
import * as machine from "./machine.js";
import {askToken} from "./rpc.js";

const kViews = [
  ["setup", "Set up"], ["capture", "Capture"], ["runs", "Runs"], ["compensation", "Compensation"], ["health", "Health"],
];
const main = document.getElementById("main");
let close = null;  // closes the present view
let shown = 0;     // number of the present view; a view that loads slowly must not replace a newer view

const links = kViews.map(([name, title]) => h("a", {href: `#${name}`}, title));
document.getElementById("tabs").append(...links.map((link) => h("li", {}, link)));
document.getElementById("token").addEventListener("click", () => askToken());

// Shows the view that the address names: "#runs/2/with/1" is the view "runs" with rest = ["2",
// "with", "1"].
async function show() {
  const [name, ...rest] = location.hash.slice(1).split("/");
  if (name === "main") return;  // "#main" is the target of the link for keyboard users, not a view
  const number = ++shown;
  const [view, title] = kViews.find(([known]) => known === name) ?? kViews[0];
  links.forEach((link, i) => kViews[i][0] === view
    ? link.setAttribute("aria-current", "page") : link.removeAttribute("aria-current"));
  document.title = `${title} – mdof`;
  const module = await import(`./views/${view}.js`);
  if (number !== shown) return;
  close?.();
  const place = h("div", {class: `view ${view}`}, h("h1", {}, title));
  main.replaceChildren(place);
  close = module.open(place, rest) ?? null;
}

const banner = document.getElementById("banner");
let lines = [];  // [element with the age, warning]

function drawBanner() {
  const now = machine.warnings();
  const same = now.length === lines.length && now.every((w, i) => w.text === lines[i].text && w.kind === lines[i].kind);
  if (!same) {
    lines = now.map((w) => ({...w, place: h("span", {"aria-hidden": "true"})}));
    banner.replaceChildren(...lines.map((line) => h("p", {class: line.kind}, line.text, line.place)));
  }
  lines.forEach((line, i) => setText(line.place, now[i].age === undefined ? "" : machine.ageText(now[i].age)));
}

window.addEventListener("hashchange", show);
live.start();
setInterval(drawBanner, 250);
machine.onChange(drawBanner);
machine.start().then(show);
