// mdof history: who did what.
#include <CLI/CLI.hpp>

#include "daemon/doer.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

struct HistoryCommand {
  std::string database;
  std::int64_t count = 50, offset = 0;
  bool json = false;
};

std::string deeds_json(const std::vector<Deed>& deeds, std::int64_t total) {
  JsonWriter json;
  json.begin_object().field("total", total).key("history");
  daemon::write_deeds(json, deeds);
  json.end_object();
  return json.take();
}

std::string deeds_text(const std::vector<Deed>& deeds) {
  TextTable table({"when", "what", "of", "id", "by", "detail"});
  for (const Deed& deed : deeds)
    table.add({deed.utc, deed.name, deed.subject, std::to_string(deed.row),
               daemon::doer_text(deed.by), deed.detail});
  return table.text(terminal_columns());
}

Status list_history(const HistoryCommand& command) {
  MDOF_TRY(store::Store store, open_to_read(command.database));
  MDOF_TRY(const auto deeds, store.list_deeds(command.offset, command.count));
  MDOF_TRY(const auto total, store.count_deeds());
  return command.json ? write_line(deeds_json(deeds, total)) : write_out(deeds_text(deeds));
}

}  // namespace

void add_history(CLI::App& app, Action& chosen) {
  const auto o = std::make_shared<HistoryCommand>();
  auto* command = app.add_subcommand(
      "history", "Who started, stopped, built, activated and set an encoder, newest first");
  add_database_option(*command, o->database);
  command->add_option("--offset", o->offset, "Leave out so many")->check(CLI::NonNegativeNumber);
  command->add_option("--count", o->count, "At most")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  add_json_flag(*command, o->json);
  command->footer("Example:\n  mdof history --count 10");
  command->callback([o, &chosen] { chosen = [o] { return list_history(*o); }; });
}

}  // namespace mdof::tools
