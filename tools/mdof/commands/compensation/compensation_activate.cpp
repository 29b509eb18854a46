// mdof compensation activate: activates a table on its axis.
#include <CLI/CLI.hpp>

#include "daemon/history.h"
#include "daemon/measure/evaluation.h"
#include "schema/base/json_writer.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/commands/compensation/active_table.h"
#include "tools/mdof/options.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/stored/database_writer.h"

namespace mdof::tools {
namespace {

struct ActivateCommand {
  std::string database, socket, reason;
  std::int64_t table = 0;
  daemon::Consent consent;
  std::optional<std::int64_t> expected_generation;
  bool json = false;
};

Result<std::string> activated(const ActivateCommand& command) {
  MDOF_TRY(auto mdofd, writing_daemon(command.database, command.socket));
  if (mdofd) {
    JsonWriter params;
    params.begin_object()
        .field("table", command.table)
        .field("simulated", command.consent.simulated)
        .field("despite_warnings", command.consent.despite_warnings)
        .field("reason", command.reason);
    if (command.expected_generation)
      params.field("expected_generation", *command.expected_generation);
    params.end_object();
    return mdofd->call("compensation.activate", params.text());
  }
  MDOF_TRY(store::Store store, open_existing_to_write(command.database));
  HistoryEntry action = daemon::action_now("compensation.activate", daemon::this_process());
  action.detail = command.reason;
  MDOF_TRY(const auto done, daemon::activate_table(store, {command.table, command.consent, action,
                                                           command.expected_generation}));
  return store::activation_json("\"table\":" + std::to_string(command.table), done);
}

Status activate(const ActivateCommand& command) {
  MDOF_TRY(const std::string reply, activated(command));
  const std::string table = "table " + std::to_string(command.table);
  return print_activation(reply, table + " is active", table + " is already active", command.json);
}

Action declare_activate(CLI::App& command) {
  const auto o = std::make_shared<ActivateCommand>();
  add_database_option(command, o->database);
  command.add_option("TABLE", o->table, "Number of the table")->required()->type_name("");
  add_consent_flags(command, o->consent, "a table");
  command.add_option("--reason", o->reason, "Reason of the change, stored in the history");
  add_expected_generation_option(command, o->expected_generation);
  add_socket_option(command, o->socket);
  add_json_flag(command, o->json);
  return [o] { return activate(*o); };
}

}  // namespace

Command compensation_activate_command() {
  return {.name = "compensation activate",
          .summary = "Activate a table of an axis or of the volume",
          .footer = "Example:\n  mdof compensation activate 1",
          .declare = declare_activate};
}

}  // namespace mdof::tools
