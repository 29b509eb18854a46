// mdof history: lists the recorded actions.
#include <CLI/CLI.hpp>

#include "daemon/history.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/list_page.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

struct HistoryCommand {
  std::string database;
  ListPage page;
  bool json = false;
};

std::string actions_json(const std::vector<HistoryEntry>& actions, std::int64_t total,
                         std::int64_t offset) {
  JsonWriter json;
  json.begin_object().field("total", total).field("offset", offset).key("history");
  daemon::write_actions(json, actions);
  json.end_object();
  return json.take();
}

std::string actions_text(const std::vector<HistoryEntry>& actions, std::int64_t total) {
  TextTable table({"when", "action", "subject", "id", "by", "detail"});
  for (const HistoryEntry& action : actions)
    table.add({action.utc, action.name, action.subject, std::to_string(action.row),
               daemon::actor_text(action.by), action.detail});
  return table.text(terminal_columns()) + left_out(actions.size(), total, "actions");
}

Status list_history(const HistoryCommand& command) {
  MDOF_TRY(store::Store store, open_to_read(command.database));
  MDOF_TRY(const auto actions, store.list_actions(command.page.offset, command.page.count));
  MDOF_TRY(const auto total, store.count_actions());
  return command.json ? write_line(actions_json(actions, total, command.page.offset))
                      : write_out(actions_text(actions, total));
}

Action declare_history(CLI::App& command) {
  const auto o = std::make_shared<HistoryCommand>();
  add_database_option(command, o->database);
  add_page_options(command, o->page);
  add_json_flag(command, o->json);
  return [o] { return list_history(*o); };
}

}  // namespace

Command history_command() {
  return {.name = "history",
          .summary = "List the recorded actions (who, what, when), newest first",
          .footer = "Example:\n  mdof history --count 10",
          .declare = declare_history};
}

}  // namespace mdof::tools
