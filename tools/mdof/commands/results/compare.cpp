// mdof compare RUN_BEFORE RUN_AFTER: shows the effect of a compensation or a repair on an axis.
#include <CLI/CLI.hpp>
#include <cmath>

#include "daemon/measure/several_runs/comparison.h"
#include "daemon/output/charts/analysis/analysis_charts.h"
#include "daemon/output/charts/plot_files.h"
#include "daemon/words/words.h"
#include "schema/units.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/stored/run_choice.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/analyses/budget_text.h"
#include "tools/mdof/text/notice_lines.h"
#include "tools/mdof/text/run_tables.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

struct CompareCommand {
  std::string database, before, after, reference = "fixture", plots;
  bool json = false, all_warnings = false;
};

// "0.123 ± 0.045": value and u in the unit of the figure. U_cell() uses the same unit.
std::string value_cell(const Budget& budget) {
  if (!(budget.u >= 0)) return fixed(to_key_unit(budget.value), 3);
  return with_u(to_key_unit(budget.value), to_key_unit(budget.u), 3);
}

std::string U_cell(double U) {
  return std::isnan(U) ? "unknown" : to_place(to_key_unit(U), to_key_unit(U), 3);
}

// "reduced by factor 9.8". The factor is stated only if the remaining value exceeds its U.
std::string effect_text(const daemon::ComparedFigure& figure) {
  std::string text = daemon::to_string(figure.effect);
  if (figure.effect == daemon::Effect::changed)
    return text + " by " +
           (figure.before.figure.ends_with("_um")
                ? um_to_place(figure.at_targets, figure.change.U) + " µm"
                : urad_to_place(figure.at_targets, figure.change.U) + " µrad");
  if (figure.effect != daemon::Effect::reduced) return text;
  const double left = std::abs(figure.after.value), before = std::abs(figure.before.value);
  return left > figure.after.U ? text + " by factor " + fixed(before / left, 1)
                               : text + " to a value that is not larger than its U";
}

std::string um_cell(double value, double U) {
  return std::isnan(value) ? "-" : um_to_place(value, U);
}

// The table of the targets, with both approaches and the reversal error.
std::string positioning_points_text(const daemon::Comparison& c) {
  if (!c.no_points_reason.empty()) return wrapped(c.no_points_reason, terminal_columns()) + "\n";
  TextTable table({"position/mm", "", "before/µm", "U/µm", "after/µm", "U/µm"}, 2);
  for (const daemon::ComparedPoint& point : c.points.points)
    for (std::size_t side = 0; side < point.side.size(); ++side) {
      const daemon::ComparedValue& value = point.side[side].front();
      table.add({side == 0 ? in_mm(point.position_m) : "", daemon::kComparedSides[side],
                 um_cell(value.before, value.U_before), um_cell(value.U_before, value.U_before),
                 um_cell(value.after, value.U_after), um_cell(value.U_after, value.U_after)});
    }
  return "E: range of the means of both approaches (ISO 230-2); B: largest reversal error\n" +
         table.text(terminal_columns()) + "\n";
}

std::string comparison_text(const daemon::Comparison& c) {
  TextTable table({"figure", "before, run " + std::to_string(c.before), "U before",
                   "after, run " + std::to_string(c.after), "U after", "change", "U of change",
                   "effect"});
  std::vector<Budget> changes;
  for (const auto& figure : c.figures) {
    table.add({figure.change.figure, value_cell(figure.before), U_cell(figure.before.U),
               value_cell(figure.after), U_cell(figure.after.U), value_cell(figure.change),
               U_cell(figure.change.U), effect_text(figure)});
    changes.push_back(figure.change);
  }
  std::string text = noise_only_notice(are_noise_only(changes)) + simulated_notice(c.simulated) +
                     (c.is_imported ? positioning_points_text(c) : stated_text(c.stated)) +
                     table.text(terminal_columns());
  for (const Notice& each : c.differences)
    text += wrapped("note: " + words::text(each), terminal_columns()) + "\n";
  return text +
         wrapped("± is the standard uncertainty u, U the expanded uncertainty (95 %). u contains " +
                     covers_text(c) +
                     ". The change is |after| - |before|. For U of the change, mdof treats the "
                     "runs as independent. Uncertainties that both runs have in common cancel, so "
                     "this U is more likely too large than too small. If the sign of a figure has "
                     "changed, the common uncertainties add; u of the change is then the sum of "
                     "both u. Effect \"changed\": the magnitude is the same within U, but the "
                     "sign or the shape has changed.",
                 terminal_columns()) +
         "\n";
}

Status draw_change(const daemon::Comparison& found, const std::string& folder) {
  if (folder.empty()) return {};
  if (!charts::has_comparison(found)) {
    warn("no chart is drawn: " + (found.no_points_reason.empty()
                                      ? "no target has a value in both runs"
                                      : found.no_points_reason));
    return {};
  }
  const std::string name =
      "compare-" + std::to_string(found.before) + "-" + std::to_string(found.after) + ".svg";
  return write_plots({{name, charts::comparison_svg(found, words::Language::english)}}, folder);
}

Status compare(const CompareCommand& command) {
  MDOF_TRY(store::Store store, open_to_read(command.database));
  daemon::ComparisonRequest request;
  MDOF_TRY(request.before, run_number(store, command.before));
  MDOF_TRY(request.after, run_number(store, command.after));
  reference_from(command.reference, request.reference);  // the option accepts only valid names
  MDOF_TRY(const auto found, daemon::compare_runs(store, request));
  show_notices(found.notices, command.all_warnings);
  std::vector<Budget> changes;
  for (const auto& figure : found.figures) changes.push_back(figure.change);
  if (const std::string text = not_declared_text(changes); !text.empty())
    warn(found.is_imported
             ? "an imported run has no declared uncertainty (mdof import --u-um), so U "
               "of this run contains the repeatability only"
             : text);
  MDOF_CHECK(draw_change(found, command.plots));
  return command.json ? write_line(daemon::comparison_json(found))
                      : write_out(comparison_text(found));
}

Action declare_compare(CLI::App& command) {
  const auto o = std::make_shared<CompareCommand>();
  add_run_argument(command, "RUN_BEFORE", o->before,
                   "Number of the run before the change, or \"latest\"");
  add_run_argument(command, "RUN_AFTER", o->after,
                   "Number of the run after the change (same axis), or \"latest\"");
  add_reference_option(command, o->reference)->capture_default_str();
  add_database_option(command, o->database);
  add_plot_option(command, o->plots);
  add_json_flag(command, o->json);
  add_all_warnings_flag(command, o->all_warnings);
  return [o] { return compare(*o); };
}

}  // namespace

Command compare_command() {
  return {.name = "compare",
          .summary = "Compare two runs of an axis, such as before and after a compensation",
          .footer = "Example:\n  mdof compare 1 7",
          .declare = declare_compare};
}

}  // namespace mdof::tools
