// mdof show RUN: a stored run, whole.
#include <CLI/CLI.hpp>

#include "daemon/measure/budgets.h"
#include "daemon/measure/evaluation.h"
#include "daemon/measure/imported/imported_run.h"
#include "daemon/measure/imported/positioning_figures.h"
#include "schema/base/output/output_files.h"
#include "schema/imported/series.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/commands/results/chosen_run.h"
#include "tools/mdof/csv/run_csv.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/analyses/drift_text.h"
#include "tools/mdof/text/history_text.h"
#include "tools/mdof/text/imported_text.h"
#include "tools/mdof/text/run_tables.h"

namespace mdof::tools {
namespace {

Status write_json(const ChosenRun& choice, const std::string& json) {
  return choice.out.empty() ? write_line(json)
                            : write_file(choice.out, json + "\n", Existing::replace);
}

Status show_imported(store::Store& store, Run run, const ChosenRun& choice) {
  MDOF_TRY(const std::string sha256, store.result_sha256(run.header.id));
  MDOF_TRY(const auto actions, store.actions_of_run(run.header.id));
  if (choice.csv) return write_csv_of(run, false, imported_csv(run), choice);
  run = daemon::with_positioning_notices(std::move(run));
  const StatedFigures figures = daemon::positioning_figures(run);
  if (choice.json)
    return write_json(choice,
                      daemon::imported_document(run, run.header, figures, sha256, actions, true));
  const std::size_t width = terminal_columns();
  return write_out(imported_text(run, figures, sha256, width, choice.all_warnings) +
                   history_text(actions, width));
}

}  // namespace

Status show_run(const ChosenRun& choice) {
  MDOF_TRY(store::Store store, open_to_read(choice.database));
  MDOF_TRY(const Run run, load_run(store, choice));
  MDOF_CHECK(warn_if_superseded(store, run.header.id));
  if (is_imported(run.header)) return show_imported(store, run, choice);
  if (choice.csv) {
    const RunUncertainty uncertainty = daemon::uncertainty_of(run);
    return write_csv_of(run, uncertainty.noise_only, points_csv(run, uncertainty), choice);
  }
  MDOF_TRY(const std::string sha256, store.result_sha256(run.header.id));
  MDOF_TRY(const auto actions, store.actions_of_run(run.header.id));
  if (choice.json) {
    const daemon::StatedRun stated = daemon::stated_run(run);
    return write_json(choice, daemon::run_document({run, run.header, stated.points, stated.figures},
                                                   sha256, actions));
  }
  const std::size_t width = terminal_columns();
  const std::string drift = drift_notice(run, drift_of(run).found, width);
  const Extent extent = choice.all_points ? Extent::all : Extent::brief;
  return write_out(
      show_text(run, daemon::uncertainty_of(run), sha256, width, extent, choice.all_warnings) +
      (drift.empty() ? "" : "\n" + drift) + history_text(actions, width));
}

namespace {

Action declare_show(CLI::App& command) {
  const auto choice = std::make_shared<ChosenRun>();
  add_chosen_run(command, *choice);
  command.add_flag("--all", choice->all_points, "Show all points, not only the means by target");
  return [choice] { return show_run(*choice); };
}

}  // namespace

Command show_command() {
  return {.name = "show",
          .summary = "Show the errors of a run by target, or all its points, with uncertainty",
          .footer =
              "Examples:\n"
              "  mdof show 12\n"
              "  mdof show 12 --all\n"
              "  mdof show latest --axis X --csv > points_X.csv",
          .declare = declare_show};
}

}  // namespace mdof::tools
