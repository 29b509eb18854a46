// Elements, numbers with units and tables for all views.

// Makes an element: h("button", {class: "main", onclick: f}, "Start"). Properties that begin with
// "on" are listeners. Properties with null, undefined or false are omitted; true makes an attribute
// without a value.
export function h(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (name === "value") element.value = value;
    else element.setAttribute(name, value === true ? "" : value);
  }
  element.append(...children.flat(Infinity).filter((c) => c !== null && c !== undefined && c !== false));
  return element;
}

const kSvg = "http://www.w3.org/2000/svg";
export function s(tag, attributes = {}, ...children) {
  const element = document.createElementNS(kSvg, tag);
  for (const [name, value] of Object.entries(attributes))
    if (value !== null && value !== undefined) element.setAttribute(name, value);
  element.append(...children.flat(Infinity));
  return element;
}

// Sets the text of an element, but only if it differs from the present text.
export function setText(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

// False for null: the page shows null from mdofd as a missing number, not as 0.
export const isNumber = (x) => typeof x === "number" && Number.isFinite(x);

// A number with fixed decimals and a true minus sign, which is as wide as a digit.
export function fixed(x, digits) {
  if (!isNumber(x)) return "–";
  const text = x.toFixed(digits);
  return Number(text) === 0 ? text.replace("-", "") : text.replace("-", "−");
}

// The number of decimals of a value: U then has two significant digits (GUM 7.2.6).
export function decimals(U, otherwise = 3) {
  if (!isNumber(U) || U <= 0) return otherwise;
  return Math.min(Math.max(1 - Math.floor(Math.log10(U)), 0), 6);
}

// The text of a value without U: three significant digits.
export const short = (x) => fixed(x, isNumber(x) && x !== 0 ? Math.min(Math.max(2 - Math.floor(Math.log10(Math.abs(x))), 0), 6) : 3);

export const unitOf = (key) => key.endsWith("_urad") ? "µrad" : key.endsWith("_um") ? "µm" : "";
export const nameOf = (key) => key.replace(/_(urad|um)$/, "");

// Converts "EYX_straightness_um" to "EYX straightness".
export const titleOf = (key) => nameOf(key).replaceAll("_", " ");

// "1.830 µm, U = 0.089 µm (k = 2.0)". If U is unknown, the text states this.
export function measured(figure, unit, {with_k = true} = {}) {
  const U = isNumber(figure?.U) ? figure.U : null;
  const digits = decimals(U);
  const value = `${fixed(figure?.value, digits)} ${unit}`;
  if (U === null) return `${value}, U not known`;
  return `${value}, U = ${fixed(U, digits)} ${unit}` + (with_k && isNumber(figure.k) ? ` (k = ${fixed(figure.k, 2)})` : "");
}

// A text with the sources that U contains. The page shows it with every U.
export function covers(of) {
  const missing = of.not_declared ?? [];
  if (!of.u_covers && missing.length === 0) return null;
  const incomplete = missing.length > 0;
  return h("div", {class: incomplete ? "notice doubtful" : "quiet"},
    h("p", {}, incomplete ? h("strong", {}, "U is incomplete: ") : null, "U contains ", of.u_covers ?? "", "."),
    incomplete ? h("details", {}, h("summary", {}, `${missing.length} contributors are not declared`),
      h("p", {}, missing.join(", "))) : null);
}

// Columns: [head, className]; rows of strings or nodes. The first cell of a row is its header.
export function table(caption, columns, rows, attributes = {}) {
  const element = h("div", {class: "scroll", tabindex: "0", role: "region", "aria-label": caption},
    h("table", attributes,
      h("caption", {}, caption),
      h("thead", {}, h("tr", {}, columns.map(([head, kind]) => h("th", {scope: "col", class: kind}, head)))),
      h("tbody", {})));
  element.columns = columns;
  return setRows(element, rows);
}

// Replaces the rows of a table without moving the focus.
export function setRows(element, rows) {
  const cell = (content, i) => i === 0
    ? h("th", {scope: "row", class: element.columns[i][1]}, content ?? "–") : h("td", {class: element.columns[i][1]}, content ?? "–");
  element.querySelector("tbody").replaceChildren(...rows.map((row) => row instanceof Node ? row : h("tr", {}, row.map(cell))));
  return element;
}

const kShapes = {invalid: "■", doubtful: "▲", information: "●"};

// Notices from mdofd, each with a shape and a word for its severity.
export function notices(list, title = "Notices") {
  if (!list || list.length === 0) return null;
  return h("section", {class: "notices"}, h("h3", {}, `${title} (${list.length})`),
    h("ul", {}, list.map((n) => typeof n === "string"
      ? h("li", {class: "notice"}, n)
      : h("li", {class: `notice ${n.severity}`}, h("span", {class: "shape", "aria-hidden": "true"},
        kShapes[n.severity] ?? "●"), ` ${n.severity}: ${n.text}`))));
}

export function field(label, input, hint) {
  return h("label", {class: "field"}, h("span", {}, label), input, hint ? h("small", {}, hint) : null);
}

export function select(options, value, onchange, attributes = {}) {
  return h("select", {...attributes, onchange: (e) => onchange?.(e.target.value)},
    options.map(([key, text]) => h("option", {value: key, selected: String(key) === String(value)}, text)));
}

export const time = (utc) => utc ? utc.replace("T", " ").slice(0, 19) + " UTC" : "–";

export function age(seconds) {
  if (seconds < 10) return `${seconds.toFixed(1)} s`;
  if (seconds < 120) return `${Math.round(seconds)} s`;
  return seconds < 7200 ? `${Math.round(seconds / 60)} min` : `${Math.round(seconds / 3600)} h`;
}

// Shows the result of a promise in the element, or the error if it fails.
export function fill(element, promise) {
  element.replaceChildren(h("p", {class: "quiet"}, "Loading …"));
  return promise.then((content) => element.replaceChildren(...[content].flat().filter(Boolean)),
    (error) => element.replaceChildren(problem(error)));
}

export const problem = (error) => h("p", {class: "notice invalid", role: "alert"},
  h("span", {class: "shape", "aria-hidden": "true"}, "■"), ` ${error.message}`);

// Shows a modal dialog with a form. The promise resolves to the FormData, or to null if the user
// cancelled.
export function ask(title, content, action) {
  const dialog = document.getElementById("dialog");
  const form = h("form", {method: "dialog"}, h("h2", {id: "dialog-title"}, title), content,
    h("p", {class: "buttons"}, h("button", {value: "ok", class: "main"}, action),
      h("button", {value: "", formnovalidate: true}, "Cancel")));
  dialog.replaceChildren(form);
  dialog.returnValue = "";
  dialog.showModal();
  return new Promise((resolve) => dialog.addEventListener("close",
    () => resolve(dialog.returnValue === "ok" ? new FormData(form) : null), {once: true}));
}
