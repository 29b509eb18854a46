// mdof show RUN: shows the points or the figures of a stored run.
#include <CLI/CLI.hpp>

#include "daemon/measure/analysis/analysis.h"
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
#include "tools/mdof/text/history_text.h"
#include "tools/mdof/text/imported_text.h"

namespace mdof::tools {
namespace {

Status write_json(const ChosenRun& choice, const std::string& json) {
  return choice.out.empty() ? write_line(json)
                            : write_file(choice.out, json + "\n", Existing::replace);
}

Status show_imported(store::Store& store, Run run, const ChosenRun& choice) {
  MDOF_TRY(const std::string sha256, store.result_sha256(run.header.id));
  MDOF_TRY(const auto actions, store.run_actions(run.header.id));
  if (choice.csv) return write_marked_csv(run, false, imported_csv(run), choice);
  run = daemon::with_positioning_notices(std::move(run));
  const StatedFigures figures = daemon::positioning_figures(run);
  if (choice.json)
    return write_json(choice,
                      daemon::imported_document(run, run.header, figures, sha256, actions, true));
  const std::size_t width = terminal_columns();
  return write_out(imported_text(run, figures, sha256, width, choice.all_warnings) +
                   history_text(actions, width));
}

Status figures_csv_or_json(store::Store& store, const Run& run, const ChosenRun& choice) {
  if (choice.csv) {
    const StatedFigures stated = daemon::figure_budgets(run);
    return write_marked_csv(run, are_noise_only(stated.budgets), figures_csv(run, stated), choice);
  }
  MDOF_TRY(const std::string document, daemon::analysis_document(store, run));
  return write_json(choice, document);
}

}  // namespace

Status show_run(const ChosenRun& choice) {
  MDOF_TRY(store::Store store, open_to_read(choice.database));
  MDOF_TRY(const Run run, load_run(store, choice));
  MDOF_CHECK(warn_if_superseded(store, run.header.id, choice.database));
  if (choice.extent == Extent::figures) {
    MDOF_CHECK(check_measured(run.header, "an analysis"));
    if (choice.csv || choice.json) return figures_csv_or_json(store, run, choice);
  }
  if (is_imported(run.header)) return show_imported(store, run, choice);
  if (choice.csv) {
    const RunUncertainty uncertainty = daemon::uncertainty_of(run);
    return write_marked_csv(run, uncertainty.noise_only, points_csv(run, uncertainty), choice);
  }
  MDOF_TRY(const std::string sha256, store.result_sha256(run.header.id));
  MDOF_TRY(const auto actions, store.run_actions(run.header.id));
  const daemon::StatedRun stated = daemon::stated_run(run);
  if (choice.json)
    return write_json(choice, daemon::run_document({run, run.header, stated.points, stated.figures},
                                                   sha256, actions));
  const std::size_t width = terminal_columns();
  return write_out(run_text(run, stated, sha256, width, choice.extent, choice.all_warnings) +
                   history_text(actions, width));
}

namespace {

Action declare_show(CLI::App& command) {
  const auto choice = std::make_shared<ChosenRun>();
  add_chosen_run(command, *choice);
  const auto set = [choice](Extent extent) {
    return [choice, extent](std::int64_t) { choice->extent = extent; };
  };
  auto* all = command.add_flag_function("--all", set(Extent::all),
                                        "Show all points, and then the output of --figures");
  command
      .add_flag_function("--figures", set(Extent::figures),
                         "Show straightness for each reference line and approach, angles, closure "
                         "and drift, but no points")
      ->excludes(all);
  return [choice] { return show_run(*choice); };
}

}  // namespace

Command show_command() {
  return {.name = "show",
          .summary = "Show the errors of a run by target, its straightness, angles and drift",
          .footer =
              "Examples:\n"
              "  mdof show 12\n"
              "  mdof show 12 --figures\n"
              "  mdof show latest --axis X --csv > points_X.csv\n"
              "  mdof show 12 --figures --csv > figures.csv",
          .declare = declare_show};
}

}  // namespace mdof::tools
