// mdof analyse RUN: the figures of a stored run.
#include <CLI/CLI.hpp>

#include "algo/iso230/straightness.h"
#include "daemon/measure/analysis/analysis.h"
#include "daemon/measure/budgets.h"
#include "schema/imported/series.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/commands/results/chosen_run.h"
#include "tools/mdof/csv/run_csv.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/analyses/budget_text.h"
#include "tools/mdof/text/analyses/drift_text.h"
#include "tools/mdof/text/run_tables.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

// Made on reading: what is stored, and its hash, is as it was.
std::vector<StraightnessLines> lines_of(const Run& run) {
  return algo::straightness_lines(run.header.moving(), run.points);
}

Status analyse(const ChosenRun& choice) {
  MDOF_TRY(store::Store store, open_to_read(choice.database));
  MDOF_TRY(const Run run, load_run(store, choice));
  MDOF_CHECK(check_measured(run.header, "an analysis"));
  MDOF_CHECK(warn_if_superseded(store, run.header.id));
  if (choice.csv) {
    const StatedFigures stated = daemon::figure_budgets(run);
    return write_csv_of(run, are_noise_only(stated.budgets), figures_csv(run, stated), choice);
  }
  if (choice.json) {
    MDOF_TRY(const std::string document, daemon::analysis_document(store, run));
    return write_line(document);
  }
  const std::size_t width = terminal_columns();
  const StatedFigures stated = daemon::figure_budgets(run);
  return write_out(noise_only_notice(are_noise_only(stated.budgets)) +
                   head_text(run.header, "", width, choice.all_warnings) + "\n" +
                   figures_text(run, stated, width) + "\n" +
                   minimum_zone_text(lines_of(run), width) + "\n" +
                   drift_text(run, drift_of(run), width));
}

Action declare_analyse(CLI::App& command) {
  const auto choice = std::make_shared<ChosenRun>();
  add_chosen_run(command, *choice);
  return [choice] { return analyse(*choice); };
}

}  // namespace

Command analyse_command() {
  return {.name = "analyse",
          .summary = "Show straightness (for each reference line), angles and drift of a run",
          .footer =
              "Examples:\n"
              "  mdof analyse latest\n"
              "  mdof analyse 12 --csv > figures.csv",
          .declare = declare_analyse};
}

}  // namespace mdof::tools
