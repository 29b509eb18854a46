// mdof status: what mdofd is doing.
#include <CLI/CLI.hpp>

#include "daemon/rpc/client.h"
#include "schema/json_writer.h"
#include "tools/mdof/command.h"
#include "tools/mdof/json_text.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"

namespace mdof::tools {
namespace {

struct StatusCommand {
  std::string socket;
  bool json = false;
};

struct Section {
  const char *title, *method, *params;
};
constexpr Section kSections[] = {
    {"server", "server.info", "{}"},
    {"devices", "device.list", "{}"},
    {"compensation", "compensation.status", "{}"},
    {"runs", "run.list", "{\"count\":10}"},
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
    text +=
        std::string(text.empty() ? "" : "\n") + "== " + section.title + "\n" + readable(*result);
  }
  json.end_object();
  return command.json ? write_line(json.text()) : write_out(text);
}

}  // namespace

void add_status(CLI::App& app, Action& chosen) {
  const auto o = std::make_shared<StatusCommand>();
  auto* command = app.add_subcommand("status", "What mdofd is doing");
  add_socket_option(*command, o->socket);
  add_json_flag(*command, o->json);
  command->footer("Example:\n  mdof status --json");
  command->callback([o, &chosen] { chosen = [o] { return status(*o); }; });
}

}  // namespace mdof::tools
