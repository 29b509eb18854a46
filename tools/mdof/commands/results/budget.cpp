// mdof budget RUN, mdof budget RUN_X RUN_Y: shows the contributions to the uncertainty of figures.
#include <CLI/CLI.hpp>
#include <optional>

#include "algo/uncertainty/conformity/decision.h"
#include "daemon/measure/budgets.h"
#include "daemon/measure/gate/gate.h"
#include "daemon/output/charts/run/run_charts.h"
#include "schema/units.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/commands/results/chosen_run.h"
#include "tools/mdof/csv/csv_text.h"
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

constexpr std::uint64_t kMostTrials = 1'000'000;

struct BudgetCommand {
  std::string database, run, run_b, axis, figure, plots, reference = "fixture";
  std::optional<double> at_mm, tolerance, artefact_urad, u_artefact_urad;
  algo::TrialsRequest trials;
  bool partial = false, csv = false, json = false, all_warnings = false;
};

Status check_options(const BudgetCommand& command) {
  if (command.run_b.empty() &&
      (command.artefact_urad || command.u_artefact_urad || command.partial))
    return fail(ErrorCode::usage,
                "--artefact-urad, --u-artefact-urad and --partial need two runs (squareness); give "
                "RUN_B, or leave out these options");
  if (command.tolerance && command.run_b.empty() && command.figure.empty())
    return fail(ErrorCode::usage, "--tolerance applies to one figure; give --figure NAME");
  if (!command.run_b.empty() && (!command.figure.empty() || command.at_mm))
    return fail(ErrorCode::usage,
                "with two runs, this command shows only the squareness of these runs; leave out "
                "--figure and --at, or leave out RUN_B");
  if (!command.run_b.empty() && command.reference != "fixture")
    return fail(ErrorCode::usage, "squareness always refers to the fixture; leave out --reference");
  if (!command.figure.empty() && command.at_mm)
    return fail(ErrorCode::usage,
                "--at shows the five errors at a target, and --figure shows one figure of the "
                "whole run; leave out --at or --figure");
  return {};
}

// The numbers of the run, or of the two runs of a squareness. "latest" is resolved only once.
Result<std::vector<std::int64_t>> runs_of(store::Store& store, const BudgetCommand& command) {
  if (command.run_b.empty()) {
    MDOF_TRY(const auto id, run_number(store, command.run, axis_from(command.axis)));
    return std::vector{id};
  }
  MDOF_TRY(const auto pair, run_pair(command.database, {command.run, command.run_b}));
  return std::vector{pair[0], pair[1]};
}

Result<daemon::FoundBudgets> of_one_run(store::Store& store, const BudgetCommand& command,
                                        std::int64_t run) {
  daemon::RunBudgetsRequest request;
  request.run = run;
  reference_from(command.reference, request.reference);  // the option accepts only valid names
  request.figure = command.figure;
  if (command.at_mm) request.at_m = from_mm(*command.at_mm);
  request.trials = command.trials;
  return daemon::run_budgets(store, request);
}

Result<daemon::FoundBudgets> of_two_runs(store::Store& store, const BudgetCommand& command,
                                         const std::vector<std::int64_t>& runs) {
  daemon::SquarenessRequest request;
  request.run_a = runs[0];
  request.run_b = runs[1];
  if (command.artefact_urad) request.given.angle_error_rad = from_urad(*command.artefact_urad);
  if (command.u_artefact_urad) request.given.u_rad = from_urad(*command.u_artefact_urad);
  request.partial = command.partial;
  return daemon::squareness_budgets(store, request, command.trials);
}

struct Marked {
  std::string runs;  // "1", "1, 2"
  std::vector<std::string> marks;
};

Result<Marked> marked(store::Store& store, const std::vector<std::int64_t>& ids) {
  Marked all;
  for (const std::int64_t id : ids) {
    MDOF_TRY(const Run run, store.run(id));
    all.runs += (all.runs.empty() ? "" : ", ") + std::to_string(id);
    for (std::string& mark : daemon::warning_marks(run)) all.marks.push_back(std::move(mark));
  }
  return all;
}

Status draw_budgets(const Marked& of, const BudgetCommand& command,
                    const std::vector<Budget>& budgets) {
  if (command.plots.empty()) return {};
  std::vector<charts::NamedChart> drawn;
  for (const Budget& b : budgets)
    if (charts::has_budget(b))
      drawn.push_back(
          {"budget-" + charts::file_name(b.figure) + ".svg",
           charts::budget_svg(b, "run " + of.runs, of.marks, words::Language::english)});
    else
      warn("the budget of " + b.figure + " is not drawn, because u is 0 or unknown");
  return write_plots(drawn, command.plots);
}

std::string text_of(const daemon::FoundBudgets& found, const std::optional<Decision>& decided) {
  std::string head =
      noise_only_notice(are_noise_only(found.budgets)) + simulated_notice(found.simulated);
  if (found.at_m) head += "errors at " + in_mm(*found.at_m) + " mm\n";
  return head + (found.budgets.size() == 1
                     ? budget_text(found.budgets.front(), decided, terminal_columns())
                     : budgets_text(found.budgets, terminal_columns()) +
                           "To show the full budget of one figure, give --figure " +
                           found.budgets.front().figure + "\n");
}

Status budget(const BudgetCommand& command) {
  MDOF_CHECK(check_options(command));
  MDOF_TRY(store::Store store, open_to_read(command.database));
  MDOF_TRY(const auto runs, runs_of(store, command));
  MDOF_TRY(const auto found, runs.size() == 1 ? of_one_run(store, command, runs.front())
                                              : of_two_runs(store, command, runs));
  show_notices(found.notices, command.all_warnings);
  if (const std::string text = not_declared_text(found.budgets); !text.empty()) warn(text);
  std::string against;
  for (const std::int64_t id : runs) {
    MDOF_TRY(const Run run, store.run(id));
    if (const std::string approach = daemon::only_approach(run); !approach.empty())
      warn("run " + std::to_string(id) + " has only the " + approach +
           " approach: the figures are valid for this approach, and the reversal error is unknown");
    MDOF_CHECK(warn_if_superseded(store, id, command.database));
    if (against.empty()) against = daemon::undecidable_reason(store, run);
  }
  const auto decided = command.tolerance
                           ? std::optional(algo::decision(found.budgets.front(),
                                                          from_um(*command.tolerance), against))
                           : std::nullopt;
  const bool shows_marks = command.csv || !command.plots.empty();
  MDOF_TRY(const Marked of, shows_marks ? marked(store, runs) : Result<Marked>());
  MDOF_CHECK(draw_budgets(of, command, found.budgets));
  MDOF_CHECK(command.csv    ? write_out(noise_only_comment(are_noise_only(found.budgets)) +
                                        csv_marks(of.marks) + budgets_csv(found.budgets))
             : command.json ? write_line(daemon::budgets_json(found, decided))
                            : write_out(text_of(found, decided)));
  if (!decided || decided->conformity == Conformity::conform) return {};
  const std::string& figure = found.budgets.front().figure;
  if (decided->conformity == Conformity::not_conform)
    return fail(ErrorCode::check, figure + " does not conform to the tolerance");
  return fail(ErrorCode::check, "conformity of " + figure + " to the tolerance is undecided" +
                                    (decided->reason.empty() ? "" : ": " + decided->reason));
}

Action declare_budget(CLI::App& command) {
  const auto o = std::make_shared<BudgetCommand>();
  add_run_argument(
      command, "RUN", o->run,
      "Number of the run, or \"latest\"; if RUN_B is given, the run along the first axis");
  command
      .add_option("RUN_B", o->run_b,
                  "Number of a run along a second axis, or \"latest\"; mdof then shows the budget "
                  "of the squareness")
      ->type_name("")
      ->check(run_argument_error);
  add_latest_axis_option(command, o->axis);
  command
      .add_option("--figure", o->figure,
                  "Show the full budget of one figure, such as EYX_straightness_um")
      ->type_name("NAME");
  command
      .add_option("--at", o->at_mm,
                  "Show the budgets of the five errors at the target nearest to this position")
      ->check(finite_number())
      ->type_name("MM");
  command
      .add_option(
          "--tolerance", o->tolerance,
          "Largest permitted value of the figure, in the unit of the figure. mdof prints "
          "\"conform\", \"not conform\" or \"undecided\" (ISO 14253-1:2017). The result is always "
          "\"undecided\" in these cases: the rig does not declare every uncertainty; no target was "
          "approached twice from the same direction; a notice makes the run doubtful")
      ->check(not_negative_number());
  command
      .add_option(
          "--trials", o->trials.trials,
          "Also calculate the uncertainty with this number of Monte Carlo trials (JCGM 101)")
      ->check(CLI::Range(std::uint64_t{2}, kMostTrials));
  command.add_option("--seed", o->trials.seed, "Seed of the Monte Carlo trials")
      ->check(not_negative_number())
      ->capture_default_str();
  add_reference_option(command, o->reference)->capture_default_str();
  add_square_options(command, o->artefact_urad, o->u_artefact_urad);
  command.add_flag("--partial", o->partial, "Also accept partial runs");
  add_database_option(command, o->database);
  add_all_warnings_flag(command, o->all_warnings);
  add_plot_option(command, o->plots);
  add_csv_and_json_flags(command, o->csv, o->json);
  return [o] { return budget(*o); };
}

}  // namespace

Command budget_command() {
  return {.name = "budget",
          .summary = "Show the contributors to the uncertainty of a run's figures",
          .footer =
              "Examples:\n"
              "  mdof budget 3\n"
              "  mdof budget 3 --figure EYX_straightness_um --tolerance 0.5\n"
              "  mdof budget 3 --at 30 --json\n"
              "  mdof budget 1 2 --trials 10000",
          .declare = declare_budget};
}

}  // namespace mdof::tools
