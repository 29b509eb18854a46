// mdof studies [STUDY]: lists the stored sensitivity studies, or shows one of them.
#include <CLI/CLI.hpp>
#include <optional>

#include "daemon/output/charts/study/study_plots.h"
#include "schema/base/json_writer.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/list_page.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/study/json.h"
#include "tools/mdof/study/output.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

struct StudiesCommand {
  std::string database, plots;
  std::optional<std::int64_t> study;  // nullopt: list the studies
  ListPage page;
  bool json = false, csv = false;
};

struct Row {
  store::StudyRecord record;
  std::string state;  // "open": the study is in progress, or its process was killed
  std::uint64_t trials = 0;
};

Result<Row> row_of(store::Store& store, store::StudyRecord record) {
  MDOF_TRY(const auto outcome, store.study_outcome(record.id));
  if (!outcome) return Row{std::move(record), "open", 0};
  return Row{std::move(record), to_string(outcome->state), outcome->trials};
}

std::string rows_json(const std::vector<Row>& rows, std::int64_t total) {
  JsonWriter json;
  json.begin_object().field("total", total).key("studies").begin_array();
  for (const Row& row : rows) {
    json.begin_object().field("study", row.record.id).field("name", row.record.name);
    json.field("state", row.state).field("trials", row.trials).key("trials_wanted");
    row.record.trials_wanted ? json.value(*row.record.trials_wanted) : json.null();
    json.field("seed", row.record.seed).field("started_utc", row.record.started_utc);
    json.field("software_version", row.record.software_version).field("source", row.record.source);
    json.end_object();
  }
  json.end_array().end_object();
  return json.take();
}

std::string rows_text(const std::vector<Row>& rows, std::int64_t total) {
  TextTable table({"study", "state", "trials", "requested trials", "seed", "started", "name"});
  for (const Row& row : rows) {
    const auto& wanted = row.record.trials_wanted;
    table.add({std::to_string(row.record.id), row.state, std::to_string(row.trials),
               wanted ? std::to_string(*wanted) : "adaptive", std::to_string(row.record.seed),
               row.record.started_utc, row.record.name});
  }
  return table.text(terminal_columns()) + left_out(rows.size(), total, "studies");
}

Status list_studies(const StudiesCommand& command) {
  MDOF_TRY(store::Store store, open_to_read(command.database));
  MDOF_TRY(const std::int64_t total, store.count_studies());
  MDOF_TRY(auto records, store.list_studies(command.page.offset, command.page.count));
  std::vector<Row> rows;
  for (auto& record : records) {
    MDOF_TRY(Row row, row_of(store, std::move(record)));
    rows.push_back(std::move(row));
  }
  return command.json ? write_line(rows_json(rows, total)) : write_out(rows_text(rows, total));
}

Status show_study(const StudiesCommand& command) {
  MDOF_TRY(store::Store store, open_to_read(command.database));
  MDOF_TRY(const store::StudyRecord record, store.study(*command.study));
  MDOF_TRY(const auto outcome, store.study_outcome(*command.study));
  const std::string id = std::to_string(*command.study);
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
  return print_study(result, outcome->figures_json, *command.study, form);
}

Action declare_studies(CLI::App& command) {
  const auto o = std::make_shared<StudiesCommand>();
  auto* study = command.add_option("STUDY", o->study, "Number of the study to show")->type_name("");
  add_database_option(command, o->database);
  add_page_options(command, o->page);
  for (const char* of_list : {"--offset", "--count"}) command.get_option(of_list)->excludes(study);
  auto* csv =
      command
          .add_flag("--csv", o->csv, "Print CSV with one row for each output and bin of the travel")
          ->needs(study);
  command.add_flag("--json", o->json, "Print one JSON document")->excludes(csv);
  command.add_option("--plot", o->plots, "Draw the charts again as SVG files in this folder")
      ->type_name("DIR")
      ->needs(study);
  return [o] { return o->study ? show_study(*o) : list_studies(*o); };
}

}  // namespace

Command studies_command() {
  return {.name = "studies",
          .summary = "List the stored studies, newest first, or show the result of one study",
          .footer =
              "Examples:\n"
              "  mdof studies --count 10\n"
              "  mdof studies 3 --csv > study.csv",
          .declare = declare_studies};
}

}  // namespace mdof::tools
