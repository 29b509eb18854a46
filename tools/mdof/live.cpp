// mdof live: the probes against their ranges, as mdofd sees them now.
#include <CLI/CLI.hpp>

#include "daemon/rpc/client.h"
#include "schema/json_writer.h"
#include "tools/mdof/command.h"
#include "tools/mdof/live_view.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"

namespace mdof::tools {
namespace {

constexpr std::chrono::seconds kPatience{10};

struct LiveCommand {
  std::string socket, axis;
  std::int64_t count = 0, interval_ms = 200;
  bool json = false;
};

Result<rpc::Client> subscribe(const LiveCommand& command) {
  MDOF_TRY(rpc::Client client, rpc::Client::connect(command.socket));
  JsonWriter params;
  params.begin_object().field("interval_ms", command.interval_ms).end_object();
  MDOF_CHECK(client.call("live.subscribe", params.text()));
  return client;
}

// The next update of the axis asked for.
Result<LiveUpdate> next_update(rpc::Client& client, const LiveCommand& command) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (std::chrono::steady_clock::now() < end) {
    auto line = client.next_notification(kPatience);
    if (!line) break;
    const auto update = read_update(*line);
    if (update && (command.axis.empty() || update->axis == command.axis)) return *update;
  }
  return io_error("mdofd sends no readings" +
                  (command.axis.empty() ? std::string() : " of the axis " + command.axis) +
                  "; see mdof status for the state of its devices");
}

// A document has an end: one update unless a count is given.
Status print_document(rpc::Client& client, const LiveCommand& command) {
  JsonWriter json;
  json.begin_object().key("updates").begin_array();
  for (std::int64_t i = 0; i < std::max<std::int64_t>(command.count, 1); ++i) {
    MDOF_TRY(const LiveUpdate update, next_update(client, command));
    json.raw(update.json);
  }
  json.end_array().end_object();
  return write_line(json.text());
}

Status live(const LiveCommand& command) {
  MDOF_TRY(rpc::Client client, subscribe(command));
  if (command.json) return print_document(client, command);
  LiveScreen screen(out_is_terminal());
  for (std::int64_t i = 0; command.count == 0 || i < command.count; ++i) {
    MDOF_TRY(const LiveUpdate update, next_update(client, command));
    MDOF_CHECK(write_out(screen.next(update)));
  }
  return {};
}

}  // namespace

void add_live(CLI::App& app, Action& chosen) {
  const auto o = std::make_shared<LiveCommand>();
  auto* command = app.add_subcommand("live", "Watch the probes against their ranges");
  command->add_option("--axis", o->axis, "Only this axis")->check(CLI::IsMember({"X", "Y", "Z"}));
  command->add_option("--count", o->count, "End after so many updates [default: never]")
      ->check(CLI::PositiveNumber);
  command->add_option("--interval-ms", o->interval_ms, "Between two updates")
      ->check(CLI::Range(20, 60000))
      ->capture_default_str();
  add_socket_option(*command, o->socket);
  add_json_flag(*command, o->json);
  command->footer("Example:\n  mdof live --axis X");
  command->callback([o, &chosen] { chosen = [o] { return live(*o); }; });
}

}  // namespace mdof::tools
