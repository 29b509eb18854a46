// mdof studies, mdof study ID: sensitivity studies that were stored.
#include <CLI/CLI.hpp>

#include "schema/base/json_writer.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/plot/study_plots.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/study/json.h"
#include "tools/mdof/study/output.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

struct StudiesCommand {
  std::string database, plots;
  std::int64_t study = 0, count = 50, offset = 0;
  bool json = false, csv = false;
};

struct Row {
  store::StudyRecord record;
  std::string state;  // open: under way, or ended without a word
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
    json.field("software", row.record.software_version).field("source", row.record.source);
    json.end_object();
  }
  json.end_array().end_object();
  return json.take();
}

std::string rows_text(const std::vector<Row>& rows) {
  TextTable table({"study", "state", "trials", "of", "seed", "started", "name"});
  for (const Row& row : rows) {
    const auto& wanted = row.record.trials_wanted;
    table.add({std::to_string(row.record.id), row.state, std::to_string(row.trials),
               wanted ? std::to_string(*wanted) : "adaptive", std::to_string(row.record.seed),
               row.record.started_utc, row.record.name});
  }
  return table.text(terminal_columns());
}

Status list_studies(const StudiesCommand& command) {
  MDOF_TRY(store::Store store, open_to_read(command.database));
  MDOF_TRY(const std::int64_t total, store.count_studies());
  MDOF_TRY(auto records, store.list_studies(command.offset, command.count));
  std::vector<Row> rows;
  for (auto& record : records) {
    MDOF_TRY(Row row, row_of(store, std::move(record)));
    rows.push_back(std::move(row));
  }
  return command.json ? write_line(rows_json(rows, total)) : write_out(rows_text(rows));
}

Status show_study(const StudiesCommand& command) {
  MDOF_TRY(store::Store store, open_to_read(command.database));
  MDOF_TRY(const store::StudyRecord record, store.study(command.study));
  MDOF_TRY(const auto outcome, store.study_outcome(command.study));
  const std::string id = std::to_string(command.study);
  if (!outcome)
    return fail(ErrorCode::not_found, "study " + id +
                                          ": has no result yet; if it is not under "
                                          "way, mdof sensitivity --continue " +
                                          id);
  StudyResult result;
  MDOF_CHECK(read_study_figures(outcome->figures_json, "study " + id, result));
  result.plan_toml = record.plan_toml;
  result.software = outcome->software_version;
  result.started_utc = record.started_utc;
  result.elapsed_s = outcome->elapsed_s;
  result.state = outcome->state;
  if (!command.plots.empty()) MDOF_CHECK(write_study_plots(result, command.plots));
  const StudyForm form = command.json  ? StudyForm::json
                         : command.csv ? StudyForm::csv
                                       : StudyForm::text;
  return print_study(result, outcome->figures_json, command.study, form);
}

}  // namespace

void add_studies(CLI::App& app, Action& chosen) {
  const auto o = std::make_shared<StudiesCommand>();
  auto* command = app.add_subcommand("studies", "List the stored studies, newest first");
  add_database_option(*command, o->database);
  command->add_option("--offset", o->offset, "Leave out so many")->check(CLI::NonNegativeNumber);
  command->add_option("--count", o->count, "At most")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  add_json_flag(*command, o->json);
  command->footer("Example:\n  mdof studies --count 10");
  command->callback([o, &chosen] { chosen = [o] { return list_studies(*o); }; });
}

void add_study(CLI::App& app, Action& chosen) {
  const auto o = std::make_shared<StudiesCommand>();
  auto* command = app.add_subcommand("study", "Show the result of a stored study");
  command->add_option("STUDY", o->study, "Its number, see mdof studies")->required()->type_name("");
  add_database_option(*command, o->database);
  auto* csv = command->add_flag("--csv", o->csv, "Print one row an output and bin");
  command->add_flag("--json", o->json, "Print one JSON document")->excludes(csv);
  command->add_option("--plot", o->plots, "Draw it again as SVG")->type_name("DIR");
  command->footer("Example:\n  mdof study 3 --csv > study.csv");
  command->callback([o, &chosen] { chosen = [o] { return show_study(*o); }; });
}

}  // namespace mdof::tools
