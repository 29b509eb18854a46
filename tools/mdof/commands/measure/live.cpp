// mdof live: shows the present readings of the probes in mdofd relative to their ranges.
#include <CLI/CLI.hpp>
#include <algorithm>

#include "daemon/rpc/line/client.h"
#include "schema/base/json_writer.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/commands/measure/live_view.h"
#include "tools/mdof/interrupt.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/json_read.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

constexpr std::chrono::seconds kPatience{10};
constexpr std::chrono::milliseconds kTurn{100};  // largest delay after Ctrl-C

struct LiveCommand {
  std::string socket, axis;
  std::int64_t count = 0, interval_ms = 200;
  bool json = false, ndjson = false;
};

// Error: mdofd does not have this axis. The command would otherwise wait forever, because mdofd
// sends no updates for it.
Status check_axis(rpc::Client& client, const std::string& axis) {
  MDOF_TRY(const std::string info, client.call("server.info"));
  simdjson::dom::parser parser;
  simdjson::dom::array axes;
  if (parser.parse(simdjson::padded_string(info))["axes"].get_array().get(axes)) return {};
  std::vector<std::string> names;
  for (const auto known : axes) names.push_back(text(known, "axis"));
  if (names.empty())
    return fail(ErrorCode::not_found,
                "live: mdofd has no axis to measure; add an [[axis]] table to the configuration "
                "file of mdofd");
  if (axis.empty() || std::find(names.begin(), names.end(), axis) != names.end()) return {};
  return fail(ErrorCode::not_found,
              "live: mdofd does not measure axis " + axis + "; it measures " + joined(names));
}

Result<rpc::Client> subscribe(const LiveCommand& command) {
  MDOF_TRY(rpc::Client client, rpc::Client::connect(command.socket));
  MDOF_CHECK(check_axis(client, command.axis));
  JsonWriter params;
  params.begin_object().field("interval_ms", command.interval_ms).end_object();
  MDOF_CHECK(client.call("live.subscribe", params.text()));
  return client;
}

Result<ProbeRanges> ranges_of(rpc::Client& client) {
  ProbeRanges ranges;
  MDOF_TRY(const std::string info, client.call("server.info"));
  simdjson::dom::parser parser;
  simdjson::dom::array axes;
  if (parser.parse(simdjson::padded_string(info))["axes"].get_array().get(axes)) return ranges;
  for (const auto known : axes) {
    JsonWriter params;
    params.begin_object().field("axis", text(known, "axis")).end_object();
    const auto rig = client.call("rig.get", params.text());
    if (rig)
      ranges.add(text(known, "axis"), *rig);
    else if (client.connected())
      warn("axis " + text(known, "axis") +
           " is shown without the ranges of its probes: " + rig.error().message);
    else
      return tl::unexpected(rig.error());
  }
  return ranges;
}

// Prints a fault of a device at once. If the screen is redrawn, prints nothing, because the next
// update shows the fault.
Status report(const std::string& notification, const LiveCommand& command) {
  const auto trouble = read_trouble(notification);
  if (!trouble || (!command.axis.empty() && trouble->axis != command.axis)) return {};
  if (command.ndjson) return write_line(trouble->json);
  if (!out_is_terminal() || !messages_are_on_terminal())
    say(wrapped(trouble->line, terminal_columns(), 2));
  return {};
}

// The next update of the requested axis.
Result<LiveUpdate> next_update(rpc::Client& client, const LiveCommand& command) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (std::chrono::steady_clock::now() < end && !Interrupt::requested()) {
    const auto line = client.next_notification(kTurn);
    if (!line && !client.connected()) return tl::unexpected(line.error());
    if (!line) continue;
    const auto update = read_update(*line);
    if (update && (command.axis.empty() || update->axis == command.axis)) return *update;
    if (!update) MDOF_CHECK(report(*line, command));
  }
  return io_error("mdofd sends no readings" +
                  (command.axis.empty() ? std::string() : " of axis " + command.axis) +
                  "; to see the state of the devices, use: mdof device list");
}

// Prints one JSON document with one update, or with --count updates.
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

// Prints each update as it arrives: as a JSON object, as text, or on a screen that is redrawn.
Status print_updates(rpc::Client& client, const LiveCommand& command) {
  const Interrupt interrupt;
  MDOF_TRY(const ProbeRanges ranges, ranges_of(client));
  LiveScreen screen(out_is_terminal(), terminal_columns());
  for (std::int64_t i = 0; command.count == 0 || i < command.count; ++i) {
    auto update = next_update(client, command);
    if (Interrupt::requested()) return {};
    if (!update) return tl::unexpected(update.error());
    ranges.apply(*update);
    MDOF_CHECK(command.ndjson ? write_line(update->json) : write_commands(screen.next(*update)));
  }
  return {};
}

Status live(const LiveCommand& command) {
  MDOF_TRY(rpc::Client client, subscribe(command));
  return command.json ? print_document(client, command) : print_updates(client, command);
}

Action declare_live(CLI::App& command) {
  const auto o = std::make_shared<LiveCommand>();
  command.add_option("--axis", o->axis, "Show only this axis")
      ->check(CLI::IsMember({"X", "Y", "Z"}));
  command.add_option("--count", o->count, "End after this number of updates [default: never]")
      ->check(positive_number());
  command.add_option("--interval-ms", o->interval_ms, "Time between two updates")
      ->check(CLI::Range(20, 60000))
      ->capture_default_str();
  add_socket_option(command, o->socket);
  add_json_flag(command, o->json);
  command
      .add_flag("--ndjson", o->ndjson,
                "Print one JSON object per line: updates, device faults (type \"trouble\"), "
                "stops that are not near a target (type \"left_out\")")
      ->excludes("--json");
  return [o] { return live(*o); };
}

}  // namespace

Command live_command() {
  return {.name = "live",
          .summary = "Show the readings of the probes and their ranges while mdofd measures",
          .footer =
              "Examples:\n"
              "  mdof live --axis X\n"
              "  mdof live --ndjson --interval-ms 20 > readings.ndjson",
          .declare = declare_live};
}

}  // namespace mdof::tools
