// The dialog before a table is activated or deactivated. The user states the reason and, if
// necessary, accepts simulated data or warnings.
import {ask, field, h} from "./dom.js";
import {call} from "./rpc.js";

const consent = (name, text, required) => h("label", {class: "check"}, h("input", {type: "checkbox", name, required}), text);

// Shows the dialog and calls `method`. marks: {simulated, doubtful} of the table; doubtful null:
// unknown. Returns true if the method was called, false if the user cancelled. Throws the errors of
// call().
export async function change(method, params, {title, text, action, marks = {}}) {
  const form = await ask(title, [text, field("Reason", h("input", {name: "reason", required: true, maxlength: 500}), "stored in the history"),
    marks.simulated ? consent("simulated", "Activate the table although its data are SIMULATED", true) : null,
    marks.doubtful || marks.doubtful === null ? consent("despite_warnings", "Activate the table despite the warnings of its runs", marks.doubtful === true) : null], action);
  if (!form) return false;
  await call(method, {...params, reason: form.get("reason"), simulated: form.has("simulated") || undefined,
    despite_warnings: form.has("despite_warnings") || undefined});
  return true;
}
