// Writes the result of the check of an export as JSON and as text.
#include "schema/base/json_writer.h"
#include "schema/base/number/number_text.h"
#include "schema/run_json.h"
#include "tools/mdof/commands/compensation/exported.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

using controllers::CheckedError;
using controllers::Control;

constexpr double kShown = 5e-11;  // m or rad; the table shows smaller values as 0.0000

void write_control(JsonWriter& json, const CheckedError& e, const Control& control) {
  json.begin_object().field("mistake", control.name);
  json.field(e.angle ? "residual_urad" : "residual_um", control.residual * 1e6);
  json.field("detected", control.detected);
  if (!control.detected && control.too_small)
    json.field("reason",
               "the effect of the simulated mistake is smaller than the permitted residual");
  json.end_object();
}

// A text that states the parts of the residual that no file of this format can correct.
std::string causes_text(const CheckedError& e) {
  const std::string unit = e.angle ? " µrad" : " µm";
  std::string text;
  if (e.nothing && e.before > 0)
    text +=
        e.error +
        ": nothing to correct, because all errors are smaller than the last digit of the format\n";
  if (e.by_reversal > kShown)
    text += e.error + ": " + fixed(e.by_reversal * 1e6, 4) + unit +
            (e.approach.empty() ? " remain in each approach"
                                : " remain if the approach is not " + e.approach) +
            ", because the file has one value for both approaches, but the errors of the "
            "approaches differ" +
            (e.one_way ? " (not included in \"after\")\n"
             : e.approach.empty()
                 ? "\n"
                 : "; if the approach is always " + e.approach + ", give --one-approach\n");
  if (e.outside > kShown)
    text += e.error + ": " + fixed(e.outside * 1e6, 4) + unit +
            " remain at measured positions beyond the ends of the file. There, the controller uses "
            "the value at the nearest end (not included in \"before\" and \"after\")\n";
  if (e.error_by_ramp > kShown)
    text +=
        e.error + ": " + fixed(e.error_by_ramp * 1e6, 4) + unit +
        " remain after a reversal, because LinuxCNC does not start a motion for a step of this "
        "size; change MAX_ACCELERATION, use the live compensation, or permit this residual with "
        "--residual-um\n";
  if (e.between_nodes > kShown)
    text += e.error + ": " + fixed(e.between_nodes * 1e6, 4) + unit +
            " remain between the nodes of the table\n";
  return text;
}

}  // namespace

std::string check_json(const ExportedTables& exported) {
  const controllers::Check& check = exported.check;
  JsonWriter json;
  json.begin_object().field("passed", check.passed());
  json.field("most_residual_um", check.most_residual_m * 1e6);
  json.field("most_residual_percent", check.share * 100).key("errors").begin_array();
  for (const CheckedError& e : check.errors) {
    const std::string unit = e.angle ? "_urad" : "_um";
    json.begin_object().field("error", e.error).field("cancels", e.cancels);
    json.field("before" + unit, e.before * 1e6).field("residual" + unit, e.residual * 1e6);
    json.field("bound" + unit, e.bound * 1e6);
    json.field("judged", !e.one_way           ? "each approach"
                         : e.approach.empty() ? "mean of both approaches"
                                              : "approach " + e.approach);
    json.field("left_by_reversal" + unit, e.by_reversal * 1e6)
        .field("left_between_nodes" + unit, e.between_nodes * 1e6)
        .field("left_by_ramp" + unit, e.error_by_ramp * 1e6)
        .field("outside" + unit, e.outside * 1e6)
        .field("nothing_to_correct", e.nothing);
    json.key("controls").begin_array();
    for (const Control& control : e.controls) write_control(json, e, control);
    json.end_array().end_object();
  }
  json.end_array();
  write_strings(json, "not_judged", check.not_judged);
  write_strings(json, "left_out", exported.files.left_out);
  write_strings(json, "notes", exported.files.notes);
  write_strings(json, "marks", exported.options.marks);
  json.end_object();
  return json.take();
}

std::string check_text(const controllers::Check& check) {
  TextTable table({"error", "before", "after", "limit", "cancels", "self-test: mistake detected"});
  for (const CheckedError& e : check.errors) {
    std::string seen;
    for (const Control& control : e.controls)
      seen += (seen.empty() ? "" : ", ") + control.name + ": " +
              (control.detected    ? "yes"
               : control.too_small ? "too small to detect"
                                   : "NO");
    table.add({e.error + (e.angle ? "/µrad" : "/µm") + (e.one_way ? ", mean" : ""),
               fixed(e.before * 1e6, 4), fixed(e.residual * 1e6, 4), fixed(e.bound * 1e6, 4),
               e.cancels ? "yes" : "NO", seen});
  }
  const std::size_t columns = terminal_columns();
  const std::string most = plain_number(check.most_residual_m * 1e6);
  std::string text =
      "limit: largest permitted value of \"after\". The limit of a table of one axis is the "
      "residual that the rounding of the format, --tolerance-um and the causes below can cause. "
      "The limit is never above " +
      most + " µm (angles: " + most + " µrad), and never above " + plain_number(check.share * 100) +
      " % of \"before\" (or the last digit of the format, if this digit is larger); see "
      "--residual-um and --residual-percent\n";
  for (const CheckedError& e : check.errors) text += causes_text(e);
  if (check.nothing_to_correct())
    text +=
        "nothing to correct, because all errors are smaller than the last digit of the format\n";
  for (const std::string& error : check.not_judged)
    text += error + ": not checked, because the correction sign is unknown\n";
  return table.text(columns) + fitted(text, columns);
}

}  // namespace mdof::tools
