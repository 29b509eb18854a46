// mdof studies: the sensitivity studies that were stored.
#include <CLI/CLI.hpp>

#include "schema/base/json_writer.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/list_page.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

struct ListStudiesCommand {
  std::string database;
  ListPage page;
  bool json = false;
};

struct Row {
  store::StudyRecord record;
  std::string state;  // open: under way, or its process was killed
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

Status list_studies(const ListStudiesCommand& command) {
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

Action declare_studies(CLI::App& command) {
  const auto o = std::make_shared<ListStudiesCommand>();
  add_database_option(command, o->database);
  add_page_options(command, o->page);
  add_json_flag(command, o->json);
  return [o] { return list_studies(*o); };
}

}  // namespace

Command studies_command() {
  return {.name = "studies",
          .summary = "List the stored studies, newest first",
          .footer = "Example:\n  mdof studies --count 10",
          .declare = declare_studies};
}

}  // namespace mdof::tools
