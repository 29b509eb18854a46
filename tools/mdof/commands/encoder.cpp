// mdof encoder set: tells mdofd where an axis stands whose encoder counts from anywhere.
#include <CLI/CLI.hpp>

#include "schema/base/json_writer.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/daemon_call.h"
#include "tools/mdof/stored/json_read.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

struct EncoderCommand {
  std::string socket, axis;
  double position_mm = 0;
  bool json = false;
};

Status set(const EncoderCommand& command) {
  JsonWriter params;
  params.begin_object()
      .field("axis", command.axis)
      .field("position_mm", command.position_mm)
      .end_object();
  MDOF_TRY(const std::string reply, call_daemon(command.socket, "encoder.set", params.text()));
  if (command.json) return write_line(reply);
  simdjson::dom::parser parser;
  const auto done = parser.parse(simdjson::padded_string(reply));
  return write_line("axis " + command.axis + " stands at " + fixed(command.position_mm, 4) +
                    " mm now; device \"" + text(done, "device") + "\" counts from " +
                    fixed(number(done, "offset_mm"), 4) + " mm");
}

}  // namespace

void add_encoder(CLI::App& app, Action& chosen) {
  const auto o = std::make_shared<EncoderCommand>();
  auto* command = app.add_subcommand("encoder", "Where an axis stands whose encoder counts");
  command->require_subcommand(1);
  auto* of_set = command->add_subcommand("set", "Say where the axis stands now");
  of_set->add_option("AXIS", o->axis, "Of the machine, at rest")
      ->required()
      ->check(CLI::IsMember({"X", "Y", "Z"}));
  of_set->add_option("POSITION_MM", o->position_mm, "By the machine's coordinates")->required();
  add_socket_option(*of_set, o->socket);
  add_json_flag(*of_set, o->json);
  of_set->footer("Example:\n  mdof encoder set X 12.5");
  of_set->callback([o, &chosen] { chosen = [o] { return set(*o); }; });
}

}  // namespace mdof::tools
