// mdof parallelism RUN_A RUN_B: calculates the angle between two motions along one axis with its
// uncertainty.
#include <CLI/CLI.hpp>

#include "daemon/measure/budgets.h"
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

struct ParallelismCommand {
  std::string database, word_a, word_b;
  bool partial = false, json = false, all_warnings = false;
};

std::vector<std::string> slope_row(const std::string& label, const ParallelismOfPlane& plane,
                                   double ParallelismLine::*value) {
  return {label, in_urad(plane.least_squares.*value), in_urad(plane.end_point.*value),
          in_urad(plane.minimum_zone.*value)};
}

std::string plane_sentence(const Parallelism& found, const ParallelismOfPlane& plane) {
  const double length_m = found.to_m - found.from_m;
  return wrapped(plane.error + ": motion B is inclined to motion A by " +
                     with_u(urad_to_place(plane.budget.value, plane.budget.u),
                            urad_to_place(plane.budget.u, plane.budget.u)) +
                     " µrad towards +" + plane.error[1] +
                     ", expanded U = " + urad_to_place(plane.budget.U, plane.budget.U) +
                     " (k = " + fixed(plane.budget.coverage_factor, 2) + ", 95 %); " +
                     um_to_place(plane.budget.value * length_m, plane.budget.U * length_m) +
                     " µm over the " + in_mm(length_m) + " mm that both runs cover",
                 terminal_columns()) +
         "\n";
}

std::string parallelism_text(const Parallelism& found) {
  TextTable table({"slope/µrad", "least squares", "end points", "minimum zone"});
  std::string sentences;
  for (const ParallelismOfPlane& plane : found.planes) {
    table.add(slope_row(plane.error + ", A: run " + std::to_string(found.run_a), plane,
                        &ParallelismLine::slope_a_rad));
    table.add(slope_row(plane.error + ", B: run " + std::to_string(found.run_b), plane,
                        &ParallelismLine::slope_b_rad));
    table.add(slope_row("parallelism, B - A", plane, &ParallelismLine::angle_rad));
    sentences += plane_sentence(found, plane);
  }
  return noise_only_notice(found.planes.front().budget.noise_only &&
                           found.planes.back().budget.noise_only) +
         simulated_notice(found.simulated) + table.text() + "\n" + sentences +
         wrapped(
             "The result is valid only if neither the target nor the fixture was moved relative to "
             "the machine between the runs. ± is the standard uncertainty u. It contains " +
                 covers_text(found.planes.front().budget) +
                 ". The following uncertainties are common to both runs if both rigs declare them: "
                 "scale, linearity and tilt factor of a probe (with the same calibration "
                 "certificate), and flatness of a plane. For these, u contains only the difference "
                 "between the effects on the two runs. mdof treats all other declared "
                 "uncertainties as independent, so u may be too large if the set-up stayed the "
                 "same. The result uses the least-squares slopes. All slopes refer to the "
                 "fixture.",
             terminal_columns()) +
         "\n";
}

Status parallelism(const ParallelismCommand& command) {
  MDOF_TRY(store::Store store, open_to_read(command.database));
  daemon::ParallelismRequest request;
  MDOF_TRY(request.run_a, run_number(store, command.word_a));
  MDOF_TRY(request.run_b, run_number(store, command.word_b));
  request.partial = command.partial;
  MDOF_TRY(const auto found, daemon::find_parallelism(store, request));
  show_notices(found.notices, command.all_warnings);
  std::vector<Budget> budgets;
  for (const auto& plane : found.parallelism.planes) budgets.push_back(plane.budget);
  if (const std::string text = not_declared_text(budgets); !text.empty()) warn(text);
  return command.json ? write_line(daemon::parallelism_json(found))
                      : write_out(parallelism_text(found.parallelism));
}

Action declare_parallelism(CLI::App& command) {
  const auto o = std::make_shared<ParallelismCommand>();
  add_run_argument(command, "RUN_A", o->word_a,
                   "Number of the reference run (datum), or \"latest\"");
  add_run_argument(command, "RUN_B", o->word_b,
                   "Number of the run that is compared with RUN_A (same axis), or \"latest\"");
  command.add_flag("--partial", o->partial, "Also accept partial runs");
  add_database_option(command, o->database);
  add_json_flag(command, o->json);
  add_all_warnings_flag(command, o->all_warnings);
  return [o] { return parallelism(*o); };
}

}  // namespace

Command parallelism_command() {
  return {.name = "parallelism",
          .summary = "Find the angle between two motions along one axis (two guides, two heights)",
          .footer = "Example:\n  mdof parallelism 1 3",
          .declare = declare_parallelism};
}

}  // namespace mdof::tools
