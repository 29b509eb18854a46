// mdof machine error MACHINE.toml --at X,Y,Z: calculates the error of the tool relative to the
// work.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>

#include "algo/machine/compensating.h"
#include "schema/units.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/commands/machine/machine_file.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/run_tables.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

struct MachineErrorCommand {
  std::string file, database, at, approach = "mean";
  bool json = false;
};

struct FoundError {
  algo::Command at{};
  algo::ToolError error;
  std::optional<algo::CompensatingCommand> compensating;  // nullopt: the machine has no linear axis
};

void write_by_component(JsonWriter& json, const char* key,
                        const std::array<std::vector<std::string>, 6>& names) {
  json.key(key).begin_object();
  for (std::size_t k = 0; k < 6; ++k) write_strings(json, kComponents[k], names[k]);
  json.end_object();
}

void write_compensating(JsonWriter& json, const Machine& machine,
                        const algo::CompensatingCommand& c) {
  json.key("compensation").begin_object();
  write_command(json, "command", machine, c.command);
  json.field("residual_um", to_um(c.residual_m.norm())).key("residual").begin_object();
  for (int k = 0; k < 3; ++k) json.field(kComponents[k], to_um(c.residual_m[k]));
  json.end_object().key("angles_left").begin_object();
  for (int k = 0; k < 3; ++k) json.field(kComponents[3 + k], to_urad(c.angles_rad[k]));
  json.end_object().field("steps", c.steps).field("converged", c.converged);
  write_strings(json, "beyond_tables", c.beyond);
  json.end_object();
}

std::vector<std::string> names_without_u(const algo::ToolError& e) {
  std::vector<std::string> all;
  for (const auto& names : e.no_u) algo::add_new(names, all);
  return all;
}

std::string error_json(const Machine& machine, const FoundError& found,
                       const std::string& approach) {
  const algo::ToolError& e = found.error;
  JsonWriter json;
  json.begin_object()
      .field("machine", machine.name)
      .field("chain", machine.chain.text)
      .field("simulated", machine.simulated)
      .field("noise_only", noise_only(machine) == NoiseOnly::all)
      .field("approach", approach);
  write_command(json, "at", machine, found.at);
  json.field(
      "sense",
      "error of the tool relative to the workpiece, actual - nominal, in workpiece coordinates");
  write_components(json, "error", e.exact);
  write_components(json, "u", e.u);
  json.field("u_covers", covers_text(machine, !names_without_u(e).empty()));
  write_components(json, "linear", e.linear);
  write_components(json, "difference", e.exact - e.linear);
  json.key("difference_bound")
      .begin_object()
      .field("place_um", to_um(e.bound.place_m))
      .field("angle_urad", to_urad(e.bound.angle_rad))
      .end_object();
  write_by_component(json, "not_measured", e.not_measured);
  write_by_component(json, "not_declared", e.no_u);
  write_strings(json, "beyond_tables", e.beyond);
  if (found.compensating)
    write_compensating(json, machine, *found.compensating);
  else
    json.key("compensation").null();
  write_stored_notices(json, machine);
  json.end_object();
  return json.take();
}

std::string compensating_text(const Machine& machine, const FoundError& found) {
  if (!found.compensating) return "the machine has no linear axis that could correct the error\n";
  const auto& c = *found.compensating;
  std::string text = c.converged ? "the tool reaches the nominal position with the commands"
                                 : "NOT CONVERGED: the errors change so much with the position "
                                   "that mdof cannot calculate a compensating command\ncommands of "
                                   "the last iteration:";
  for (const MachineFrame& frame : machine.frames)
    if (frame.kind == FrameKind::linear) {
      const double to = algo::command_of(frame, c.command);
      text += " " + frame.id + " " + fixed(to_mm(to), 6) + " mm (change " +
              fixed(to_um(to - algo::command_of(frame, found.at)), 4) + " µm)";
    }
  return text + "; residual " + fixed(to_um(c.residual_m.norm()), 6) +
         " µm\nangular errors that remain: " + in_urad(c.angles_rad[0]) + ", " +
         in_urad(c.angles_rad[1]) + ", " + in_urad(c.angles_rad[2]) + " µrad about X, Y, Z\n";
}

std::string error_text(const Machine& machine, const FoundError& found,
                       algo::MachineApproach approach) {
  const algo::ToolError& e = found.error;
  TextTable table({"", "error", "u", "linear", "difference", "missing"});
  const char* const labels[] = {"x/µm", "y/µm", "z/µm", "a/µrad", "b/µrad", "c/µrad"};
  for (int k = 0; k < 6; ++k) {
    const auto& without = e.not_measured[static_cast<std::size_t>(k)];
    table.add({labels[k], fixed(to_key_unit(e.exact[k]), 4), fixed(to_key_unit(e.u[k]), 4),
               fixed(to_key_unit(e.linear[k]), 4), fixed(to_key_unit(e.exact[k] - e.linear[k]), 6),
               joined(without, " ")});
  }
  const std::vector<std::string> no_u = names_without_u(e);
  return noise_only_notice(noise_only(machine)) + simulated_notice(machine.simulated) +
         wrapped(machine.name + ", " + machine.chain.text +
                     ": error of the tool relative to the workpiece, actual - nominal",
                 terminal_columns()) +
         "\n" + approach_text(machine, approach) + table.text(terminal_columns()) +
         "missing: errors that were not measured\n" +
         wrapped("u is the standard uncertainty. It contains " +
                     covers_text(machine, !no_u.empty()) + ".",
                 terminal_columns()) +
         "\n" + missing_text({}, no_u, terminal_columns()) +
         fitted(compensating_text(machine, found), terminal_columns(), 0);
}

Status machine_error(const MachineErrorCommand& o) {
  MDOF_TRY(const Machine machine, load_machine(o.file, o.database));
  FoundError found;
  MDOF_TRY(found.at, command_from(machine, o.at));
  const auto approach = approach_from(o.approach);
  found.error = algo::tool_error(machine, found.at, approach);
  if (std::any_of(machine.frames.begin(), machine.frames.end(),
                  [](const MachineFrame& f) { return f.kind == FrameKind::linear; })) {
    MDOF_TRY(found.compensating, algo::compensating_command(machine, found.at, approach));
  }
  warn_outside_tables(found.error.beyond);
  return o.json ? write_line(error_json(machine, found, o.approach))
                : write_out(error_text(machine, found, approach));
}

Action declare_machine_error(CLI::App& command) {
  const auto o = std::make_shared<MachineErrorCommand>();
  add_machine_argument(command, o->file);
  command
      .add_option("--at", o->at,
                  "Commanded positions of X, Y and Z in mm, such as 10,20,30, or of named axes, "
                  "such as X=10,C=90 (rotary axes: degrees)")
      ->required()
      ->type_name("X,Y,Z");
  add_approach_option(command, o->approach);
  add_database_option(command, o->database);
  add_json_flag(command, o->json);
  return [o] { return machine_error(*o); };
}

}  // namespace

Command machine_error_command() {
  return {.name = "machine error",
          .summary = "Calculate the error of the tool at a position, and the compensating command",
          .footer = "Example:\n  mdof machine error machine.toml --at 10,20,30",
          .declare = declare_machine_error};
}

}  // namespace mdof::tools
