// Pictures of figures: a budget as bars, the angle between two axes.
import {fixed, h, isNumber, s, short, table} from "./dom.js";

// budget: a figure of run.budget or squareness.budget.
export function budgetBars(budget, unit) {
  const largest = Math.max(...budget.contributors.map((c) => c.share ?? 0), 1e-9);
  const bar = (share) => {
    const fill = h("span", {class: "fill"});
    fill.style.width = `${100 * share / largest}%`;
    return h("span", {class: "share", "aria-hidden": "true"}, fill);
  };
  return table(`Contributors to u in ${unit}, the largest first`,
    [["contributor"], [`u/${unit}`, "n"], ["share of u²", "n"], ["bar"], ["declared", "n"]],
    budget.contributors.map((c) => [c.contributor, short(Math.abs(c.contribution)),
      isNumber(c.share) ? `${fixed(100 * c.share, 1)} %` : "–", isNumber(c.share) ? bar(c.share) : "",
      isNumber(c.value) ? `${c.key ?? ""} ${c.value} ${c.unit ?? ""}` : "–"]));
}

const kShown_deg = 8;  // the picture always shows the error with this size

// The angle from the first axis to the second axis is 90° + sign * error. The sign is -1 for X and
// Z, because a positive EB0Z turns X towards -Z (ISO 230-1).
export const squarenessSign = (first, second) => first === "X" && second === "Z" ? -1 : 1;

// first, second: axes in the order X, Y, Z. error_urad: EC0Y, EB0Z or EA0Z.
export function squarenessPicture(first, second, error_urad) {
  const beyond_urad = squarenessSign(first, second) * error_urad, sign = Math.sign(beyond_urad);
  const angle = (90 + kShown_deg * sign) * Math.PI / 180, length = 130;
  const end = [60 + length * Math.cos(angle), 160 - length * Math.sin(angle)];
  const line = (kind, x1, y1, x2, y2) => s("line", {class: kind, x1, y1, x2, y2});
  const text = (x, y, content) => s("text", {x, y}, content);
  return s("svg", {class: "picture", viewBox: "0 0 260 190", role: "img", "aria-label":
    `The angle from +${first} to +${second} is ${fixed(Math.abs(error_urad), 2)} µrad ${beyond_urad > 0 ? "larger" : "smaller"} than 90 degrees. The picture exaggerates the deviation.`},
  line("rule dash", 60, 160, 60, 20), line("blue", 60, 160, 230, 160), line("orange", 60, 160, ...end),
  text(235, 165, `+${first}`), text(end[0] - 8, end[1] - 6, `+${second}`), text(22, 95, "90°"));
}
