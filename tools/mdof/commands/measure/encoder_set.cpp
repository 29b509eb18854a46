// mdof encoder set: sets the present position of an axis in mdofd, for axes with an incremental
// encoder.
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
  return write_line("axis " + command.axis + " is now at " + fixed(command.position_mm, 4) +
                    " mm; device \"" + text(done, "device") + "\" now has the offset " +
                    fixed(number(done, "offset_mm"), 4) + " mm");
}

Action declare_encoder_set(CLI::App& command) {
  const auto o = std::make_shared<EncoderCommand>();
  command.add_option("AXIS", o->axis, "Axis of the machine; the axis must be at rest")
      ->required()
      ->check(CLI::IsMember({"X", "Y", "Z"}));
  command
      .add_option("POSITION_MM", o->position_mm,
                  "Present position of the axis in machine coordinates")
      ->required();
  add_socket_option(command, o->socket);
  add_json_flag(command, o->json);
  return [o] { return set(*o); };
}

}  // namespace

Command encoder_set_command() {
  return {
      .name = "encoder set",
      .summary = "Set the present position of an axis that has an incremental encoder",
      .footer =
          "HAZARD: before you drive the axis to a known position with the fixture mounted, run\n"
          "mdof clearance RIG.toml to see which motions drive the target into a probe.\n"
          "Example:\n  mdof encoder set X 12.5",
      .declare = declare_encoder_set};
}

}  // namespace mdof::tools
