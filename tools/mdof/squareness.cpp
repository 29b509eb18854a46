// mdof squareness RUN_X RUN_Y: the angle between two axes, with its standard uncertainty.
#include <CLI/CLI.hpp>
#include <optional>

#include "algo/straightness.h"
#include "algo/usable_runs.h"
#include "daemon/paths.h"
#include "schema/rig.h"
#include "schema/run_json.h"
#include "schema/units.h"
#include "tools/mdof/command.h"
#include "tools/mdof/daemon_call.h"
#include "tools/mdof/database.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/run_tables.h"
#include "tools/mdof/text_table.h"

namespace mdof::tools {
namespace {

struct SquarenessCommand {
  std::string database, socket;
  std::int64_t run_x = 0, run_y = 0;
  std::optional<double> artefact_urad;
  double u_artefact_urad = 0;
  bool partial = false, json = false;
};

// Of the square that was clamped for run X, unless it was calibrated since.
Result<double> artefact_angle_error_rad(const SquarenessCommand& command, const Run& run_x) {
  if (command.artefact_urad) return from_urad(*command.artefact_urad);
  MDOF_TRY(const Rig rig, parse_rig(run_x.header.provenance.rig_text,
                                    "rig of run " + std::to_string(command.run_x)));
  return rig.artefact_angle_error_rad;
}

Result<Squareness> fit(const SquarenessCommand& command, std::vector<std::string>& warnings) {
  MDOF_TRY(store::Store store, open_to_write(command.database));
  MDOF_TRY(const Run run_x, store.run(command.run_x));
  MDOF_TRY(const Run run_y, store.run(command.run_y));
  MDOF_TRY(const double artefact_rad, artefact_angle_error_rad(command, run_x));
  MDOF_TRY(Squareness s, algo::squareness(run_x, run_y, artefact_rad,
                                          from_urad(command.u_artefact_urad), command.partial));
  warnings = algo::partial_warnings({&run_x, &run_y});
  s.created_utc = daemon::utc_now();
  MDOF_TRY(s.id, store.add_squareness(s));
  return s;
}

std::string squareness_text(const Squareness& s) {
  TextTable table({"", "slope/µrad"});
  table.add({"EYX, run " + std::to_string(s.run_x),
             with_u(in_urad(s.slope_EYX_rad), in_urad(s.u_slope_EYX_rad))});
  table.add({"EXY, run " + std::to_string(s.run_y),
             with_u(in_urad(s.slope_EXY_rad), in_urad(s.u_slope_EXY_rad))});
  table.add({"artefact", in_urad(s.artefact_angle_error_rad)});
  return simulated_notice(s.simulated) + table.text() +
         "\nEC0Y = " + with_u(in_urad(s.EC0Y_rad), in_urad(s.u_EC0Y_rad)) +
         " µrad (one standard uncertainty); the angle from +X to +Y is 90° + EC0Y\n";
}

// mdofd has the database: it fits and stores.
Status ask_daemon(const SquarenessCommand& command) {
  JsonWriter params;
  params.begin_object().field("run_x", command.run_x).field("run_y", command.run_y);
  if (command.artefact_urad) params.field("artefact_angle_error_urad", *command.artefact_urad);
  if (command.u_artefact_urad > 0) params.field("u_artefact_urad", command.u_artefact_urad);
  if (command.partial) params.field("partial", true);
  params.end_object();
  return print_call(command.socket, "squareness.fit", params.text(), command.json);
}

Status squareness(const SquarenessCommand& command) {
  MDOF_TRY(const bool busy, somebody_writes(command.database));
  if (busy) return ask_daemon(command);
  std::vector<std::string> warnings;
  MDOF_TRY(const Squareness s, fit(command, warnings));
  for (const auto& warning : warnings) warn(warning);
  return command.json ? write_line(with_warnings(squareness_json(s), warnings))
                      : write_out(squareness_text(s));
}

}  // namespace

void add_squareness(CLI::App& app, Action& chosen) {
  const auto o = std::make_shared<SquarenessCommand>();
  auto* command = app.add_subcommand("squareness", "Angle between two axes from a run along each");
  command->add_option("RUN_X", o->run_x, "Run along X")->required()->type_name("");
  command->add_option("RUN_Y", o->run_y, "Run along Y, same square")->required()->type_name("");
  command->add_option("--artefact-urad", o->artefact_urad,
                      "Angle error of the square [default: of the rig of RUN_X]");
  command->add_option("--u-artefact-urad", o->u_artefact_urad, "Its standard uncertainty")
      ->check(CLI::NonNegativeNumber);
  command->add_flag("--partial", o->partial, "Take partial runs as well");
  add_database_option(*command, o->database);
  add_socket_option(*command, o->socket);
  add_json_flag(*command, o->json);
  command->footer("Example:\n  mdof squareness 1 2 --artefact-urad -1.3 --u-artefact-urad 0.4");
  command->callback([o, &chosen] { chosen = [o] { return squareness(*o); }; });
}

}  // namespace mdof::tools
