// mdof status: shows the state of mdofd.
#include <CLI/CLI.hpp>
#include <cmath>

#include "daemon/rpc/line/client.h"
#include "schema/base/json_writer.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/json_read.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/device_table.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

using simdjson::dom::array;
using simdjson::dom::element;

struct StatusCommand {
  std::string socket;
  bool json = false;
};

std::string or_dash(const std::optional<std::int64_t>& number) {
  return number ? std::to_string(*number) : "-";
}

// One line for each axis with a note on the zero of its encoder.
std::string encoder_text(const array& axes, std::size_t columns) {
  std::string lines;
  for (const element axis : axes)
    if (const std::string note = text(axis["encoder"], "note"); !note.empty())
      lines += wrapped("encoder of " + text(axis, "axis") + ": " + note, columns, 2) + "\n";
  return lines;
}

std::string server_text(const element& info, std::size_t columns) {
  std::string lines = text(info, "server") + " " + text(info, "version") + ", up for " +
                      fixed(number(info, "uptime_s"), 0) + " s\n" +
                      wrapped("database " + text(info, "database"), columns, 2) + "\n";
  if (const std::string storage = text(info, "storage"); storage != "ok")
    lines += wrapped("storage " + storage + ": " + text(info, "storage_reason"), columns, 2) + "\n";
  array axes;
  if (info["axes"].get_array().get(axes)) return lines;
  TextTable table({"axis", "run", "rig", "devices", "simulated"});
  const auto run_of = [](const element& axis) {
    const auto unstored = integer(axis, "unstored_run");
    return unstored ? std::to_string(*unstored) + " (ended, not stored yet)"
                    : or_dash(integer(axis, "run"));
  };
  for (const element axis : axes)
    table.add({text(axis, "axis"), run_of(axis), text(axis, "rig"), joined(texts(axis, "devices")),
               flag(axis, "simulated") ? "SIMULATED" : "no"});
  if (axes.size() == 0) return lines + "no axis is configured\n";
  return lines + "\n" + table.text(columns) + encoder_text(axes, columns);
}

std::string compensation_text(const element& status, std::size_t columns) {
  const std::string head = "generation " + or_dash(integer(status, "generation")) + "\n";
  TextTable table({"axis", "table", "from/mm", "to/mm", "active since", "doubtful", "simulated"});
  const auto add = [&table](std::string_view axis, const element& active) {
    const auto range = [&](const char* end) {
      const double at_mm = number(active, end);
      return std::isnan(at_mm) ? "-" : fixed(at_mm, 3);
    };
    table.add({std::string(axis), or_dash(integer(active, "table")), range("first_mm"),
               range("last_mm"), text(active, "activated_utc"),
               flag(active, "doubtful") ? "DOUBTFUL" : "no",
               flag(active, "simulated") ? "SIMULATED" : "no"});
  };
  bool any = false;
  simdjson::dom::object axes;
  if (!status["axes"].get_object().get(axes))
    for (const auto [axis, active] : axes) add(axis, active), any = true;
  element volume;
  if (!status["volume"].get(volume) && volume.is_object()) add("volume", volume), any = true;
  return head + (any ? table.text(columns) : "no table is active\n");
}

std::string runs_text(const element& list, std::size_t columns) {
  array runs;
  if (list["runs"].get_array().get(runs) || runs.size() == 0) return "none\n";
  TextTable table({"run", "axis", "state", "started", "lost scans", "notices", "note"});
  for (const element run : runs)
    table.add({or_dash(integer(run, "run")), text(run, "axis"), text(run, "state"),
               text(run, "started_utc").substr(0, 19), or_dash(integer(run, "scans_lost")),
               std::to_string(notices_of(run).size()), text(run, "note")});
  return table.text(columns);
}

std::string devices_text(const element& list, std::size_t columns) {
  return device_table(simdjson::to_string(list), columns);
}

struct Section {
  const char *title, *method, *params;
  std::string (*text)(const element& result, std::size_t columns);
};
constexpr Section kSections[] = {
    {"server", "server.info", "{}", server_text},
    {"devices", "device.list", "{}", devices_text},
    {"compensation", "compensation.status", "{}", compensation_text},
    {"runs", "run.list", "{\"count\":10}", runs_text},
};

Status status(const StatusCommand& command) {
  MDOF_TRY(rpc::Client client, rpc::Client::connect(command.socket));
  JsonWriter json;
  std::string text;
  json.begin_object();
  for (const Section& section : kSections) {
    auto result = client.call(section.method, section.params);
    if (!result) return in_context(std::string("mdofd: ") + section.method, result.error());
    json.key(section.title).raw(*result);
    simdjson::dom::parser parser;
    const auto parsed = parser.parse(simdjson::padded_string(*result));
    text += std::string(text.empty() ? "" : "\n") + "== " + section.title + "\n";
    if (!parsed.error()) text += section.text(parsed.value_unsafe(), terminal_columns());
  }
  json.end_object();
  return command.json ? write_line(json.text()) : write_out(text);
}

Action declare_status(CLI::App& command) {
  const auto o = std::make_shared<StatusCommand>();
  add_socket_option(command, o->socket);
  add_json_flag(command, o->json);
  return [o] { return status(*o); };
}

}  // namespace

Command status_command() {
  return {.name = "status",
          .summary = "Show the state of mdofd: devices, compensation, runs",
          .footer = "Example:\n  mdof status --json",
          .declare = declare_status};
}

}  // namespace mdof::tools
