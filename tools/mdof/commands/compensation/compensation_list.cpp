// mdof compensation list: lists the stored tables, newest first.
#include <CLI/CLI.hpp>

#include "daemon/measure/gate/table_documents.h"
#include "schema/axis.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/commands/compensation/active_table.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/text/compensation_text.h"

namespace mdof::tools {
namespace {

constexpr std::int64_t kMostTables = 1'000'000;

struct ListTablesCommand {
  std::string database, axis;
  bool json = false;
};

Status list(const ListTablesCommand& command) {
  MDOF_TRY(store::Store store, open_to_read(command.database));
  daemon::ListedTables found;
  MDOF_TRY(found.generation, store.generation());
  MDOF_TRY(found.tables, store.list_tables(0, kMostTables, axis_from(command.axis)));
  for (const auto& table : found.tables) {
    MDOF_TRY(const std::int64_t generation, generation_of(store, table));
    found.generations.push_back(generation);
  }
  if (command.axis.empty()) {
    MDOF_TRY(found.volumes, store.list_volumetric(0, kMostTables));
  }
  for (const auto& table : found.volumes) {
    MDOF_TRY(const std::int64_t generation, generation_of(store, table));
    found.volume_generations.push_back(generation);
  }
  return command.json ? write_line(daemon::list_document(found)) : write_out(list_text(found));
}

Action declare_list(CLI::App& command) {
  const auto o = std::make_shared<ListTablesCommand>();
  add_database_option(command, o->database);
  add_only_axis_option(command, o->axis);
  add_json_flag(command, o->json);
  return [o] { return list(*o); };
}

}  // namespace

Command compensation_list_command() {
  return {.name = "compensation list",
          .summary = "List the stored tables, newest first",
          .footer = "Example:\n  mdof compensation list --axis X",
          .declare = declare_list};
}

}  // namespace mdof::tools
