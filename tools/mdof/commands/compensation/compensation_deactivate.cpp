// mdof compensation deactivate: deactivates the table of an axis.
#include <CLI/CLI.hpp>

#include "daemon/history.h"
#include "schema/axis.h"
#include "schema/base/json_writer.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/commands/compensation/active_table.h"
#include "tools/mdof/options.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/stored/database_writer.h"

namespace mdof::tools {
namespace {

constexpr const char* kVolume = "volume";

struct DeactivateCommand {
  std::string database, socket, axis, reason;
  std::optional<std::int64_t> expected_generation;
  bool json = false;
};

Result<std::string> deactivated(const DeactivateCommand& command) {
  MDOF_TRY(auto mdofd, writing_daemon(command.database, command.socket));
  if (mdofd) {
    JsonWriter params;
    params.begin_object().field("axis", command.axis).field("reason", command.reason);
    if (command.expected_generation)
      params.field("expected_generation", *command.expected_generation);
    params.end_object();
    return mdofd->call("compensation.deactivate", params.text());
  }
  MDOF_TRY(store::Store store, open_existing_to_write(command.database));
  HistoryEntry action = daemon::action_now("compensation.deactivate", daemon::this_process());
  action.detail = command.reason;
  const std::string actor = daemon::actor_text(action.by);
  MDOF_TRY(const auto done, command.axis == kVolume
                                ? store.change_volumetric(std::nullopt, actor, action.utc, action,
                                                          command.expected_generation)
                                : store.deactivate(*axis_from(command.axis), actor, action.utc,
                                                   action, command.expected_generation));
  return store::activation_json("\"axis\":\"" + command.axis + "\"", done);
}

Status deactivate(const DeactivateCommand& command) {
  MDOF_TRY(const std::string reply, deactivated(command));
  const std::string of = command.axis == kVolume ? "the volume" : "axis " + command.axis;
  return print_activation(reply, "the table of " + of + " is no longer active",
                          "no table of " + of + " was active", command.json);
}

Action declare_deactivate(CLI::App& command) {
  const auto o = std::make_shared<DeactivateCommand>();
  add_database_option(command, o->database);
  command
      .add_option(
          "--axis", o->axis,
          "Axis whose table is deactivated (X, Y or Z), or \"volume\" for the volumetric table")
      ->required()
      ->check(CLI::IsMember({"X", "Y", "Z", kVolume}));
  command.add_option("--reason", o->reason, "Reason of the change, stored in the history");
  add_expected_generation_option(command, o->expected_generation);
  add_socket_option(command, o->socket);
  add_json_flag(command, o->json);
  return [o] { return deactivate(*o); };
}

}  // namespace

Command compensation_deactivate_command() {
  return {.name = "compensation deactivate",
          .summary = "Deactivate the table of an axis or of the volume",
          .footer = "Example:\n  mdof compensation deactivate --axis X",
          .declare = declare_deactivate};
}

}  // namespace mdof::tools
