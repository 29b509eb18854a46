// mdof study ID: the result of a stored sensitivity study.
#include <CLI/CLI.hpp>

#include "daemon/output/charts/study/study_plots.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/options.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/study/json.h"
#include "tools/mdof/study/output.h"

namespace mdof::tools {
namespace {

struct ShowStudyCommand {
  std::string database, plots;
  std::int64_t study = 0;
  bool json = false, csv = false;
};

Status show_study(const ShowStudyCommand& command) {
  MDOF_TRY(store::Store store, open_to_read(command.database));
  MDOF_TRY(const store::StudyRecord record, store.study(command.study));
  MDOF_TRY(const auto outcome, store.study_outcome(command.study));
  const std::string id = std::to_string(command.study);
  if (!outcome)
    return fail(ErrorCode::not_found, "study " + id +
                                          ": there is no result yet; if the study is not running, "
                                          "continue the study with: mdof sensitivity --continue " +
                                          id);
  StudyResult result;
  MDOF_CHECK(read_study_figures(outcome->figures_json, "study " + id, result));
  result.plan_toml = record.plan_toml;
  result.software = outcome->software_version;
  result.started_utc = record.started_utc;
  result.elapsed_s = outcome->elapsed_s;
  result.state = outcome->state;
  if (!command.plots.empty()) MDOF_CHECK(charts::write_study_plots(result, command.plots));
  const StudyForm form = command.json  ? StudyForm::json
                         : command.csv ? StudyForm::csv
                                       : StudyForm::text;
  return print_study(result, outcome->figures_json, command.study, form);
}

Action declare_study(CLI::App& command) {
  const auto o = std::make_shared<ShowStudyCommand>();
  command.add_option("STUDY", o->study, "Number of the study (see mdof studies)")
      ->required()
      ->type_name("");
  add_database_option(command, o->database);
  auto* csv = command.add_flag("--csv", o->csv,
                               "Print CSV with one row for each output and bin of the travel");
  command.add_flag("--json", o->json, "Print one JSON document")->excludes(csv);
  command.add_option("--plot", o->plots, "Draw the charts again as SVG files in this folder")
      ->type_name("DIR");
  return [o] { return show_study(*o); };
}

}  // namespace

Command study_command() {
  return {.name = "study",
          .summary = "Show the result of a stored study",
          .footer = "Example:\n  mdof study 3 --csv > study.csv",
          .declare = declare_study};
}

}  // namespace mdof::tools
