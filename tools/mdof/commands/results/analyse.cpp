// mdof analyse RUN: the figures of a stored run.
#include <CLI/CLI.hpp>

#include "algo/iso230/straightness.h"
#include "daemon/measure/budgets.h"
#include "daemon/measure/evaluation.h"
#include "schema/imported/series.h"
#include "schema/iso230/iso230_json.h"
#include "schema/run_json.h"
#include "schema/uncertainty/budget_json.h"
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

std::string analysis_json(const Run& run, const std::vector<std::string>& probes,
                          std::optional<std::int64_t> superseded_by) {
  JsonWriter json;
  json.begin_object()
      .field("run", run.header.id)
      .field("axis", std::string_view(std::string(1, letter(run.header.axis))))
      .field("model", run.header.provenance.model)
      .field("simulated", run.header.simulated)
      .key("superseded_by");
  superseded_by ? json.value(*superseded_by) : json.null();
  write_reference(json, run.header.stated);
  const StatedFigures stated = daemon::figure_budgets(run);
  write_covers(json, stated.budgets);
  json.key("straightness");
  write_straightness(json, run.straightness, stated.budgets);
  json.key("straightness_lines");
  write_straightness_lines(json, lines_of(run));
  json.key("angles");
  write_angles(json, run.angles);
  write_stated(json, stated);
  json.key("drift");
  write_drift(json, run, probes, drift_of(run));
  json.end_object();
  return json.take();
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
    MDOF_TRY(const Rig rig, daemon::rig_of(run.header));
    std::vector<std::string> probes;
    for (const Probe& probe : rig.probes) probes.push_back(probe.id);
    MDOF_TRY(const auto by, store.superseded_by(run.header.id));
    return write_line(analysis_json(run, probes, by));
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
