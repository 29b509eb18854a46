#include "tools/mdof/commands/compensation/volume_build.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>

#include "daemon/history.h"
#include "daemon/measure/gate/table_documents.h"
#include "daemon/measure/machine/volumetric.h"
#include "daemon/words/words.h"
#include "schema/base/files.h"
#include "schema/run_json.h"
#include "schema/units.h"
#include "tools/mdof/commands/machine/machine_file.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/stored/database_writer.h"
#include "tools/mdof/stored/json_read.h"
#include "tools/mdof/text/notice_lines.h"
#include "tools/mdof/text/volumetric_text.h"

namespace mdof::tools {
namespace {

constexpr std::string_view kAxes = "XYZ";

std::string axes_of(const VolumeOptions& o) {
  return o.volume ? "XYZ" : o.plane;
}

Status check_options(const VolumeOptions& o) {
  if (o.volume == !o.plane.empty())
    return fail(ErrorCode::usage, "--machine needs either --plane (XY, XZ or YZ) or --volume");
  if (!o.step_mm)
    return fail(ErrorCode::usage,
                "missing option --step-mm (distance between two nodes of the grid)");
  return {};
}

// The positions of the axes that are not in the grid, from --at. If the user stated three numbers,
// the numbers of the axes in the grid must be 0.
Result<algo::Command> fixed_axis_positions(const Machine& machine, const VolumeOptions& o) {
  MDOF_TRY(const algo::Command at, command_from(machine, o.at));
  const bool named = o.at.find('=') != std::string::npos;
  for (const char axis : axes_of(o)) {
    const std::size_t k = kAxes.find(axis);
    if (named ? o.at.find(axis) == std::string::npos : at[k] == 0) continue;
    return fail(ErrorCode::usage,
                std::string("--at \"") + o.at + "\": " + axis + " is an axis of the grid (" +
                    axes_of(o) +
                    "), so it has no fixed position; give only the positions of the other "
                    "axes, as AXIS=MM");
  }
  return at;
}

Result<daemon::BuiltVolumetric> build_and_store(const VolumeBuild& command) {
  const VolumeOptions& o = command.options;
  daemon::VolumetricTableRequest request;
  MDOF_TRY(DescribedMachine described, described_with_text(o.machine));
  request.description = std::move(described.text);
  request.machine = std::move(described.machine);
  request.grid.along = {};
  for (const char axis : axes_of(o)) request.grid.along[kAxes.find(axis)] = true;
  request.grid.step_m = from_mm(*o.step_mm);
  if (!o.at.empty()) {
    MDOF_TRY(request.grid.others, fixed_axis_positions(request.machine, o));
  }
  request.grid.approach = approach_from(o.approach);
  request.grid.incomplete = o.incomplete;
  MDOF_TRY(request.grid.limits, command.limits.limits());
  MDOF_TRY(store::Store store, open_to_write(command.database));
  auto built = daemon::calculate_volumetric(store, request);
  if (!built) return in_context(o.machine, std::move(built.error()));
  MDOF_CHECK(daemon::store_volumetric(
      store, built->table,
      daemon::action_now("compensation.build_volume", daemon::this_process())));
  return built;
}

// If mdofd uses the database, mdofd builds and stores the table. This program then reads and shows
// the table.
Result<daemon::BuiltVolumetric> build_in_daemon(rpc::Client& mdofd, const VolumeBuild& command) {
  const VolumeOptions& o = command.options;
  MDOF_TRY(const std::string text, read_text_file(o.machine));
  JsonWriter params;
  // mdofd reads the files in this folder with the permissions of this user.
  const std::string source = std::filesystem::absolute(o.machine).lexically_normal().string();
  params.begin_object().field("machine", text).field("machine_source", source);
  params.field("axes", axes_of(o)).field("step_mm", *o.step_mm);
  if (!o.at.empty()) {
    MDOF_TRY(const Machine machine, described_machine(o.machine));
    MDOF_TRY(const algo::Command at, fixed_axis_positions(machine, o));
    for (const MachineFrame& frame : machine.frames)
      if (frame.kind != FrameKind::fixed && axes_of(o).find(frame.id) == std::string::npos)
        params.field(frame.id + "_" + position_unit(frame),
                     written_position(frame, algo::command_of(frame, at)));
  }
  if (!o.approach.empty()) params.field("approach", o.approach);
  if (o.incomplete) params.field("incomplete", true);
  if (command.limits.um) params.field("limit_um", *command.limits.um);
  if (command.limits.um_per_mm) params.field("limit_um_per_mm", *command.limits.um_per_mm);
  params.end_object();
  MDOF_TRY(const std::string reply, mdofd.call("compensation.build_volume", params.text()));
  simdjson::dom::parser parser;
  const auto json = parser.parse(simdjson::padded_string(reply));
  daemon::BuiltVolumetric built;
  built.notices = notices_of(json);
  MDOF_TRY(store::Store store, open_to_read(command.database));
  MDOF_TRY(built.table, store.volumetric(integer(json, "table").value_or(0)));
  MDOF_TRY(built.doubtful, daemon::doubtful_notices(store, built.table));
  return built;
}

}  // namespace

Status VolumeOptions::check_unused() const {
  const char* option = volume              ? "--volume"
                       : incomplete        ? "--incomplete"
                       : step_mm           ? "--step-mm"
                       : !plane.empty()    ? "--plane"
                       : !at.empty()       ? "--at"
                       : !approach.empty() ? "--approach"
                                           : nullptr;
  if (!option) return {};
  return fail(ErrorCode::usage, std::string(option) + " needs --machine MACHINE.toml");
}

void add_volume_options(CLI::App& command, VolumeOptions& o) {
  command
      .add_option(
          "--machine", o.machine,
          "MACHINE.toml: build a table over a plane or a volume from the errors of this machine")
      ->type_name("FILE");
  command.add_option("--plane", o.plane, "The two axes of the grid")
      ->check(CLI::IsMember({"XY", "XZ", "YZ"}));
  command.add_flag("--volume", o.volume, "Grid over all three axes");
  command.add_option("--step-mm", o.step_mm, "Approximate distance between two nodes of the grid")
      ->check(positive_number());
  command
      .add_option("--at", o.at,
                  "Positions of the axes that are not in the grid, such as Z=30 [default: 0]")
      ->type_name("AXIS=MM");
  command
      .add_option(
          "--approach", o.approach,
          "Approach whose errors mdof uses: forward, reverse, or the mean of both [default: mean]")
      ->check(CLI::IsMember({"mean", "forward", "reverse"}));
  command.add_flag(
      "--incomplete", o.incomplete,
      "Build the table although some errors were not measured; the table lists these errors");
}

Status build_volume(const VolumeBuild& command) {
  MDOF_CHECK(check_options(command.options));
  MDOF_TRY(auto mdofd, writing_daemon(command.database, command.socket));
  MDOF_TRY(const auto built, mdofd ? build_in_daemon(*mdofd, command) : build_and_store(command));
  const VolumetricTable& table = built.table;
  show_notices(built.notices, command.all_warnings);
  MDOF_CHECK(command.json ? write_line(with_notices(
                                daemon::volumetric_document(table, 0, !built.doubtful.empty()),
                                built.notices, words::text))
                          : write_out(volumetric_text(table, 0)));
  say("stored; activate the table with: mdof compensation activate " + std::to_string(table.id) +
      (table.simulated ? " --simulated" : "") +
      (built.doubtful.empty() ? "" : " --despite-warnings") +
      place_options(command.database, command.socket));
  return {};
}

}  // namespace mdof::tools
