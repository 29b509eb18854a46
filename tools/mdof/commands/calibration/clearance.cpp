// mdof clearance RIG.toml: shows along which axes a motion would drive the target into a probe, and
// after which travel.
#include <CLI/CLI.hpp>

#include "algo/model/clearance.h"
#include "schema/base/json_writer.h"
#include "schema/units.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

struct ClearanceCommand {
  std::string rig;
  bool json = false;
};

std::string clearance_json(const std::array<algo::MotionClearance, 3>& motions) {
  JsonWriter json;
  json.begin_object().key("motions").begin_array();
  for (const auto& motion : motions) {
    json.begin_object().field("axis", std::string(1, letter(motion.axis)));
    json.field("hazard", !motion.probes.empty()).key("probes").begin_array();
    for (const auto& probe : motion.probes) {
      json.begin_object().field("probe", probe.id).field("range_ends_um", to_um(probe.range_m));
      json.key("contact_um");
      probe.contact_m ? json.value(to_um(*probe.contact_m)) : json.null();
      json.key("towards");
      probe.towards == 0 ? json.null() : json.value(probe.towards);
      json.end_object();
    }
    json.end_array().end_object();
  }
  json.end_array().end_object();
  return json.take();
}

Status clearance(const ClearanceCommand& command) {
  MDOF_TRY(const Rig rig, load_rig(command.rig));
  MDOF_TRY(const auto motions, algo::motion_clearances(rig));
  if (command.json) return write_line(clearance_json(motions));
  std::string text =
      "Motions of the target relative to the fixture. The target starts at the nominal\n"
      "position without tilt.\n";
  for (const auto& motion : motions)
    text += wrapped(algo::clearance_text(motion), terminal_columns(), 2) + "\n";
  return write_out(text +
                   wrapped("mdof considers only the probes and the surfaces that the probes "
                           "measure. It does not consider clamps, cables or corners of the target.",
                           terminal_columns()) +
                   "\n");
}

Action declare_clearance(CLI::App& command) {
  const auto o = std::make_shared<ClearanceCommand>();
  command.add_option("RIG", o->rig, "Rig file, which describes the probes and the encoder")
      ->required()
      ->type_name("");
  add_json_flag(command, o->json);
  return [o] { return clearance(*o); };
}

}  // namespace

Command clearance_command() {
  return {.name = "clearance",
          .summary = "Show which motions drive the target into a probe, and after how much travel",
          .footer = "Example:\n  mdof clearance rig_X.toml",
          .declare = declare_clearance};
}

}  // namespace mdof::tools
