#include "tools/mdof/commands/compensation/exported.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "daemon/measure/evaluation.h"
#include "daemon/measure/imported/positioning_figures.h"
#include "daemon/measure/machine/stored_errors.h"
#include "daemon/measure/machine/volumetric.h"
#include "daemon/output/controllers/series.h"
#include "schema/base/number/number_text.h"
#include "schema/imported/series.h"
#include "schema/rig/correction.h"
#include "schema/units.h"
#include "tools/mdof/commands/compensation/active_table.h"
#include "tools/mdof/commands/compensation/export_gate.h"
#include "tools/mdof/commands/compensation/home_positions.h"
#include "tools/mdof/linuxcnc/joint_settings.h"
#include "tools/mdof/options.h"
#include "tools/mdof/stored/database.h"

namespace mdof::tools {
namespace {

constexpr double kMostTolerance_um = 100;
// Largest limits that the user may state. With larger limits, almost any file would pass the check
// of the export.
constexpr double kMostResidual_um = 20, kMostResidual_percent = 50;

Status check_request(const ExportRequest& request) {
  if (!std::isfinite(request.tolerance_um))
    return fail(ErrorCode::usage, "--tolerance-um must be a finite number");
  if (request.tolerance_um > kMostTolerance_um)
    return fail(ErrorCode::usage, "--tolerance-um " + plain_number(request.tolerance_um, 3) +
                                      " is too large, because the exported table would no longer "
                                      "contain the errors; give at most " +
                                      plain_number(kMostTolerance_um, 3));
  if (!(request.residual_um > 0 && request.residual_um <= kMostResidual_um))
    return fail(ErrorCode::usage,
                "--residual-um must be above 0 and at most " + plain_number(kMostResidual_um, 3));
  if (!(request.residual_percent > 0 && request.residual_percent <= kMostResidual_percent))
    return fail(ErrorCode::usage, "--residual-percent must be above 0 and at most " +
                                      plain_number(kMostResidual_percent, 3));
  return {};
}

// If the user changed limits, adds a comment with these limits to the files, because a reader of
// the files must know them.
void mark_limits(const ExportRequest& request, const algo::TableLimits& limits,
                 std::vector<std::string>& marks) {
  std::string changed;
  const auto add = [&](bool differs, const char* option, double value,
                       const std::string& by_default) {
    if (differs)
      changed += (changed.empty() ? "" : ", ") + std::string(option) + " " +
                 plain_number(value, 6) + " (default " + by_default + ")";
  };
  const algo::TableLimits usual;
  const ExportRequest plain;
  add(request.limits.um &&
          (limits.length_m != usual.length_m || limits.angle_rad != usual.angle_rad),
      "--limit-um", request.limits.um.value_or(0),
      plain_number(to_um(usual.length_m), 6) + " um, " + plain_number(to_urad(usual.angle_rad), 6) +
          " urad");
  add(request.limits.um_per_mm && (limits.length_slope != usual.length_slope ||
                                   limits.angle_slope_rad_per_m != usual.angle_slope_rad_per_m),
      "--limit-um-per-mm", request.limits.um_per_mm.value_or(0),
      plain_number(usual.length_slope * 1e3, 6) + " um/mm, " +
          plain_number(usual.angle_slope_rad_per_m * 1e3, 6) + " urad/mm");
  add(request.residual_um != plain.residual_um, "--residual-um", request.residual_um,
      plain_number(plain.residual_um, 6));
  add(request.residual_percent != plain.residual_percent, "--residual-percent",
      request.residual_percent, plain_number(plain.residual_percent, 6));
  if (!changed.empty()) marks.push_back("LIMITS CHANGED: " + changed);
}

// Reads the joints of the axes: "X=0,Y=1,Y=3".
Status read_joint_options(const ExportRequest& request, ExportedTables& out) {
  if ((!request.joints.empty() || request.units != "mm") && !out.format->takes_joints)
    return fail(
        ErrorCode::usage,
        request.format +
            " takes neither --joint nor --units; only the format linuxcnc has these options");
  out.options.inch = request.units == "inch";
  auto& joints = out.options.joints;
  std::istringstream words(request.joints);
  for (std::string word; std::getline(words, word, ',');) {
    int number = -1;
    const char* const end = word.data() + word.size();
    const bool right = word.size() > 2 && word[0] >= 'X' && word[0] <= 'Z' && word[1] == '=' &&
                       std::from_chars(word.data() + 2, end, number).ptr == end && number >= 0 &&
                       number < 16;
    if (!right)
      return fail(ErrorCode::usage, "--joint \"" + word +
                                        "\" must be an axis and its joint from 0 to 15, such as "
                                        "X=0,Z=1; a gantry has two joints, such as Y=1,Y=3");
    for (const auto& joint : joints)
      if (joint.number == number)
        return fail(ErrorCode::usage, "--joint names joint " + std::to_string(number) +
                                          " twice; give each joint once");
    joints.push_back({word[0], number});
  }
  return {};
}

// Reads MAX_ACCELERATION from the option or from the ini file. If the user stated neither,
// MAX_ACCELERATION remains unknown. `present`: as JointSettings::corrections.
Status read_ramp_options(const ExportRequest& request, ExportedTables& out,
                         std::vector<JointSettings::Correction>& present) {
  const bool given = request.max_acceleration_mm_s2.has_value();
  if (!given && request.ini.empty()) return {};
  if (!out.format->takes_joints)
    return fail(ErrorCode::usage, request.format +
                                      " takes neither --max-acceleration-mm-s2 nor --ini; only the "
                                      "format linuxcnc has these options");
  if (given) {
    for (const char axis : {'X', 'Y', 'Z'})
      out.options.ramps.push_back({axis, from_mm(*request.max_acceleration_mm_s2)});
    return {};
  }
  MDOF_TRY(JointSettings settings,
           read_joint_settings(request.ini, out.options.joints, out.options.inch));
  out.options.joints = std::move(settings.joints);
  out.options.ramps = std::move(settings.ramps);
  out.options.travels = std::move(settings.travels);
  present = std::move(settings.corrections);
  return {};
}

Status take_siemens_limits(const ExportRequest& request, ExportedTables& out) {
  out.options.siemens_points = request.siemens_points;
  out.options.siemens_tables = request.siemens_tables;
  if ((request.siemens_points == 0 && request.siemens_tables == 0) ||
      request.format.starts_with("siemens-"))
    return {};
  return fail(ErrorCode::usage,
              request.format +
                  " takes neither --siemens-points nor --siemens-tables; only the formats "
                  "siemens-lec and siemens-cec have these options");
}

// With --one-approach, uses values that were measured in only one approach for both approaches.
// Error: there are such values, but --one-approach is missing.
Status apply_one_approach(CompensationTable& table, const ExportRequest& request,
                          ExportedTables& out) {
  const auto has = [](const std::vector<double>& x) {
    return std::any_of(x.begin(), x.end(), [](double v) { return std::isfinite(v); });
  };
  const auto take = [&](const std::string& error, std::vector<double>& forward,
                        std::vector<double>& reverse) -> Status {
    if (has(forward) == has(reverse)) return {};
    const std::string what = "table " + std::to_string(table.id) + " has " + error + " for the " +
                             (has(forward) ? "forward" : "reverse") + " approach only";
    if (!request.one_approach)
      return bad_input(what +
                       "; measure both approaches, or use these values for both approaches with "
                       "--one-approach (a reversal error then remains)");
    out.options.marks.push_back("ONE APPROACH: " + what + "; a reversal error is not corrected");
    (has(forward) ? reverse : forward) = has(forward) ? forward : reverse;
    return {};
  };
  for (std::size_t k = 0; k < kErrorCount; ++k)
    MDOF_CHECK(take(error_names(table.axis)[k].name, table.forward[k], table.reverse[k]));
  if (!table.has_positioning()) return {};
  return take(positioning_name(table.axis), table.positioning.forward, table.positioning.reverse);
}

// Adds a warning to the files if the approach of the readings is unknown. Both approaches of such a
// table have the same values, and the controller therefore assumes a reversal error of 0.
Status mark_unknown_approach(store::Store& store, const CompensationTable& table,
                             ExportedTables& out) {
  if (!table.has_positioning() || !out.format->both_approaches) return {};
  for (const std::int64_t id : table.runs) {
    MDOF_TRY(const Run run, store.run(id));
    if (!daemon::has_unknown_approach(run)) continue;
    out.options.marks.push_back(
        "APPROACH NOT STATED: table " + std::to_string(table.id) + " is made from run " +
        std::to_string(id) +
        ". The readings of this run do not state their approach, so both approaches have the same "
        "values. The table does not correct a reversal error, and a controller that uses this "
        "table may ignore its own backlash compensation (LinuxCNC ignores BACKLASH)");
  }
  return {};
}

Result<std::int64_t> squareness_number(const std::string& word) {
  std::int64_t number = 0;
  const char* const end = word.data() + word.size();
  if (std::from_chars(word.data(), end, number).ptr == end && number > 0) return number;
  return fail(ErrorCode::usage, "--squareness \"" + word +
                                    "\" must be the number of a stored squareness, or \"latest\"");
}

std::string volume_formats() {
  std::string names;
  for (const controllers::Format& format : controllers::formats())
    if (format.volume.write) names += (names.empty() ? "" : ", ") + std::string(format.name);
  return names;
}

Status export_axes(store::Store& store, const ExportRequest& request,
                   const algo::TableLimits& limits,
                   const std::vector<JointSettings::Correction>& present, ExportedTables& out) {
  std::vector<CompensationTable> tables;
  for (const std::int64_t id : request.tables) {
    MDOF_TRY(const bool volume, store.is_volumetric(id));
    if (volume)
      return fail(ErrorCode::usage,
                  "table " + std::to_string(id) + " is a volumetric table, but the format " +
                      out.format->name + " contains " + out.format->holds +
                      "; the formats for a volumetric table are " + volume_formats());
    MDOF_TRY(CompensationTable table, store.table(id));
    MDOF_CHECK(judge_table(store, table, request, out));
    MDOF_CHECK(algo::check_limits(table, limits));
    MDOF_CHECK(apply_one_approach(table, request, out));
    MDOF_CHECK(mark_unknown_approach(store, table, out));
    if (request.cut_range)
      for (const std::string& text : controllers::cut_range_texts(table))
        out.options.marks.push_back("CUT RANGE: " + text);
    tables.push_back(std::move(table));
  }
  MDOF_CHECK(judge_present(present, tables, request, out.options.marks));
  std::string axes;
  for (const CompensationTable& table : tables) axes += letter(table.axis);
  if (out.format->takes_home) MDOF_CHECK(assign_home_axes(axes, out.options.homes));
  MDOF_TRY(out.files, out.format->axes.write(tables, out.options));
  MDOF_TRY(out.check, controllers::check_export(*out.format, tables, out.files, out.options));
  return {};
}

// Whether a volumetric table is exported. If the format supports tables of axes and volumetric
// tables, the kind of the stored table decides.
Result<bool> exports_volume(store::Store& store, const controllers::Format& format,
                            const ExportRequest& request) {
  if (!format.volume.write || !format.axes.write) return format.volume.write != nullptr;
  if (request.tables.size() > 1) return false;
  return store.is_volumetric(request.tables.front());
}

Status export_volume(store::Store& store, const ExportRequest& request,
                     const algo::TableLimits& limits, ExportedTables& out) {
  const std::int64_t id = request.tables.front();
  MDOF_TRY(const bool volume, store.is_volumetric(id));
  if (!volume || request.tables.size() > 1)
    return fail(ErrorCode::usage,
                std::string(out.format->name) +
                    " exports exactly one volumetric table; give the number of one volumetric "
                    "table (to build such a table, use: mdof compensation build --machine)");
  MDOF_TRY(const VolumetricTable table, store.volumetric(id));
  MDOF_TRY(const daemon::Judged judged, daemon::judged_table(store, table));
  MDOF_CHECK(judge(judged, request, out));
  MDOF_TRY(const std::int64_t generation, generation_of(store, table));
  MDOF_CHECK(judge_active(id, generation, request, out.options.marks));
  MDOF_CHECK(algo::check_limits(table, limits));
  MDOF_TRY(out.files, out.format->volume.write(table, out.options));
  MDOF_TRY(out.check, controllers::check_export(*out.format, table, out.files, out.options));
  return {};
}

Result<Rig> rig_of_run(store::Store& store, std::int64_t id) {
  MDOF_TRY(const Run run, store.run(id));
  return daemon::rig_of(run.header);
}

Status export_square(store::Store& store, const ExportRequest& request, ExportedTables& out) {
  std::optional<std::int64_t> id;
  if (request.squareness != "latest") {
    MDOF_TRY(id, squareness_number(request.squareness));
  }
  MDOF_TRY(const Squareness stored, daemon::find_squareness(store, id));
  const std::string name = "squareness " + std::to_string(stored.id);
  if (stored.axes != AxisPair{})
    return bad_input(name + " is " + squareness_name(stored.axes) +
                     ", but this format contains only EC0Y (squareness of X and Y); give a "
                     "squareness of X and Y");
  MDOF_TRY(const Rig x, rig_of_run(store, stored.run_a));
  MDOF_TRY(const Rig y, rig_of_run(store, stored.run_b));
  if (!(x.machine == y.machine))
    return bad_input(name + ": the rigs of the runs " + std::to_string(stored.run_a) + " and " +
                     std::to_string(stored.run_b) +
                     " describe different machines; measure both runs on one machine");
  for (const Rig* rig : {&x, &y}) {
    const ChainAxis* measured = rig->machine.find(letter(rig->axis));
    if (measured && !fixture_is_with_tool(*measured, rig->sides))
      return bad_input(name +
                       " is the angle at the fixture, but the controller needs the angle at the "
                       "tool. According to the keys \"moves\" and \"chain\" in the rig of axis " +
                       letter(rig->axis) +
                       ", the fixture is on the side of the work. Measure with the fixture in the "
                       "spindle, or correct the key \"moves\" in the rig");
  }
  // The squareness depends on its reference point. Tables of these rigs have the same reference
  // point by default.
  const StatedAt at = default_reference(x);
  if (at != default_reference(y))
    return bad_input(name + ": tool_point_mm differs between the rigs of the runs " +
                     std::to_string(stored.run_a) + " and " + std::to_string(stored.run_b) +
                     "; measure or replay both runs with the same tool_point_mm");
  MDOF_TRY(const daemon::FittedSquareness fitted,
           daemon::stored_squareness(store, stored, {at, at}));
  MDOF_CHECK(judge({daemon::JudgedKind::squareness, std::to_string(stored.id), stored.simulated,
                    daemon::without_information(fitted.notices)},
                   request, out));
  const controllers::SquareAxes axes{stored.id, fitted.squareness.error_rad, fitted.budgets.front(),
                                     x.machine, at};
  out.squareness = stored.id;
  out.angle = axes.budget;
  MDOF_TRY(out.files, out.format->square.write(axes, out.options));
  MDOF_TRY(out.check, controllers::check_export(*out.format, axes, out.files, out.options));
  return {};
}

}  // namespace

Result<const controllers::Format*> format_of(const ExportRequest& request) {
  if (!request.format.empty()) return controllers::format_named(request.format);
  std::string names;
  for (const controllers::Format& format : controllers::formats())
    names += (names.empty() ? "" : ", ") + std::string(format.name);
  return fail(ErrorCode::usage, "missing option --format NAME; the formats are " + names);
}

Result<ExportedTables> exported_tables(const ExportRequest& request) {
  MDOF_CHECK(check_request(request));
  ExportedTables out;
  MDOF_TRY(out.format, format_of(request));
  const bool square = out.format->square.write != nullptr;
  if (square && (request.squareness.empty() || !request.tables.empty()))
    return fail(ErrorCode::usage,
                request.format +
                    " exports only a squareness, not tables; give --squareness with the number of "
                    "a stored squareness or \"latest\", and leave out TABLE");
  if (!square && !request.squareness.empty())
    return fail(ErrorCode::usage,
                request.format + " exports tables, not squareness; leave out --squareness");
  if (!square && request.tables.empty())
    return fail(ErrorCode::usage,
                "missing table number; to list the tables, use: mdof compensation list");
  out.tables = request.tables;
  out.options.tolerance_m = from_um(request.tolerance_um);
  out.options.residual_m = from_um(request.residual_um);
  out.options.residual_share = request.residual_percent / 100;
  out.options.cut_range = request.cut_range;
  out.options.one_approach = request.one_approach;
  MDOF_TRY(const algo::TableLimits limits, request.limits.limits());
  mark_limits(request, limits, out.options.marks);
  MDOF_TRY(out.options.homes, home_positions(request.home_mm));
  MDOF_CHECK(read_joint_options(request, out));
  std::vector<JointSettings::Correction> present;
  MDOF_CHECK(read_ramp_options(request, out, present));
  MDOF_CHECK(take_siemens_limits(request, out));
  MDOF_CHECK(judge_sign(*out.format, request, out.options.marks));
  MDOF_TRY(store::Store store, open_to_read(request.database));
  if (square) {
    MDOF_CHECK(export_square(store, request, out));
  } else {
    MDOF_TRY(const bool volume, exports_volume(store, *out.format, request));
    MDOF_CHECK(volume ? export_volume(store, request, limits, out)
                      : export_axes(store, request, limits, present, out));
  }
  return out;
}

}  // namespace mdof::tools
