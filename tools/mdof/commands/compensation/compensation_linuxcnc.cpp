// mdof compensation linuxcnc: writes the HAL lines for live compensation in LinuxCNC.
#include <CLI/CLI.hpp>
#include <filesystem>

#include "daemon/measure/evaluation.h"
#include "schema/base/json_writer.h"
#include "schema/base/number/number_text.h"
#include "schema/base/output/output_files.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/linuxcnc/live_compensation.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"

namespace mdof::tools {
namespace {

// Largest margin. It is much larger than any correction; a larger value is probably a typing error.
constexpr double kMostMargin_mm = 5;

struct LinuxCncCommand {
  std::string ini, folder;
  LiveRequest request;
  daemon::Consent consent;
  bool json = false;
};

std::string live_json(const LiveCompensation& live, const std::string& file) {
  JsonWriter json;
  json.begin_object().field("units", live.inch ? "inch" : "mm").key("joints").begin_object();
  for (const bool second : {false, true}) {
    if (second) json.end_object().key("second_joints").begin_object();
    for (const LiveJoint& joint : live.joints)
      if (joint.second == second) json.field(std::string(1, joint.axis), joint.joint);
  }
  json.end_object();
  json.field("max_offset", live.max_offset).field("max_offset_from", live.offset_reason);
  json.field("max_velocity", live.max_velocity).field("max_velocity_from", live.velocity_reason);
  json.field("max_acceleration", live.max_acceleration);
  json.field("fade_velocity", live.fade_velocity).key("file");
  file.empty() ? json.null() : json.value(file);
  json.field("ini_line", std::string("HALFILE = ") + kCompensationHal).field("hal", live.hal);
  json.end_object();
  return json.take();
}

std::string live_text(const LiveCompensation& live, const std::string& file) {
  const std::string unit = live.inch ? " inch" : " mm";
  std::string joints;
  for (const LiveJoint& joint : live.joints)
    joints += std::string(joints.empty() ? "" : ", ") + joint.axis + " joint " +
              std::to_string(joint.joint);
  return file + "\n" + joints + "\nlargest permitted correction " + plain_number(live.max_offset) +
         unit + " (" + live.offset_reason + ")\nlargest permitted velocity of the correction " +
         plain_number(live.max_velocity) + unit + "/s (" + live.velocity_reason +
         ")\n"
         "after a change of tables, the correction changes at a rate of at most " +
         plain_number(live.fade_velocity) + unit + "/s\n";
}

Status write_lines(const LinuxCncCommand& command) {
  MDOF_TRY(const LinuxCncIni ini, read_linuxcnc_ini(command.ini));
  MDOF_TRY(const HalWiring wiring, read_hal_files(ini, kCompensationHal));
  LiveRequest request = command.request;
  request.simulated = command.consent.simulated;
  request.despite_warnings = command.consent.despite_warnings;
  MDOF_TRY(const LiveCompensation live, live_compensation(ini, wiring, request));
  std::string file;
  if (!command.folder.empty()) {
    const auto path = std::filesystem::path(command.folder) / kCompensationHal;
    MDOF_CHECK(write_file(path, live.hal, Existing::replace));
    file = path.string();
  }
  say(std::string(
          "add this line to [HAL] of the INI file, after all other HALFILE lines: HALFILE = ") +
      kCompensationHal);
  if (command.json) return write_line(live_json(live, file));
  return write_out(file.empty() ? live.hal : live_text(live, file));
}

Action declare_linuxcnc(CLI::App& command) {
  const auto o = std::make_shared<LinuxCncCommand>();
  command.add_option("--ini", o->ini, "INI file of the machine")->required()->type_name("FILE");
  command
      .add_option("--out", o->folder,
                  "Folder of the INI file; mdof_compensation.hal is written there [default: "
                  "standard output]")
      ->type_name("FOLDER");
  command
      .add_option(
          "--margin-mm", o->request.margin_mm,
          "Distance from the soft limits to the hard stops; mdof refuses larger corrections")
      ->check(number_in(0.001, kMostMargin_mm))
      ->capture_default_str();
  add_consent_flags(command, o->consent, "a table");
  command.add_flag("--one-approach", o->request.one_approach,
                   "Use a table of one approach (forward or reverse) for both approaches; the "
                   "reversal error is not corrected");
  add_socket_option(command, o->request.socket);
  add_json_flag(command, o->json);
  return [o] { return write_lines(*o); };
}

}  // namespace

Command compensation_linuxcnc_command() {
  return {.name = "compensation linuxcnc",
          .summary = "Write the HAL lines for live compensation in LinuxCNC",
          .footer =
              "If the INI file does not allow a safe compensation, the error message gives the "
              "section and key of the INI file.\n"
              "Example:\n"
              "  mdof compensation linuxcnc --ini mill.ini --out .",
          .declare = declare_linuxcnc};
}

}  // namespace mdof::tools
