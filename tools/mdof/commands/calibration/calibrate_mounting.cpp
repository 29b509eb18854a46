// mdof calibrate mounting CLAMPING...: calculates the positions of the probes in a fixture from
// readings on a tilted target.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <sstream>

#include "algo/calibration/mounting.h"
#include "daemon/measure/stops.h"
#include "tools/mdof/commands/calibration/record_file.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/analyses/mounting_text.h"
#include "tools/mdof/text/notice_lines.h"

namespace mdof::tools {
namespace {

struct MountingCommand {
  std::vector<std::string> clampings, reversed;
  std::string rig;
  RecordOptions record;
  bool json = false;
};

struct NamedLog {
  Axis axis = Axis::x;
  std::string file;
};

// Reads "X=one.csv,Y=other.csv": the log files of one clamping, by axis.
Result<std::vector<NamedLog>> parse_log_names(const std::string& clamping) {
  std::vector<NamedLog> logs;
  std::istringstream words(clamping);
  for (std::string word; std::getline(words, word, ',');) {
    const auto axis = axis_from(word.substr(0, 1));
    if (!axis || word.size() < 3 || word[1] != '=')
      return fail(ErrorCode::usage, "\"" + word + "\" in \"" + clamping +
                                        "\" does not have the form AXIS=FILE; give the logs of "
                                        "each clamping as X=FILE,Y=FILE");
    logs.push_back({*axis, word.substr(2)});
  }
  return logs;
}

struct Sources {
  std::vector<algo::Clamping> clampings;
  std::vector<CalibrationRecord::Source> files;
  std::string started_utc;  // start of the newest log
};

// The direction in which the target moves along the axis if the encoder value increases: +1 or -1.
double target_sign(const MountingCommand& command, const Rig& rig, Axis axis) {
  const std::string name(1, letter(axis));
  const auto& all = command.reversed;
  const bool reversed = std::find(all.begin(), all.end(), name) != all.end();
  const double own = axis == rig.axis ? rig.sides.target_travel_m(1) : 1;
  return reversed ? -own : own;
}

Result<algo::Traverse> read_traverse(const MountingCommand& command, const Rig& rig,
                                     const NamedLog& log, Sources& sources) {
  MDOF_TRY(const auto found, daemon::read_stops(log.file, log.axis, rig));
  show_notices(found.notices, true);
  const auto same = [&](const auto& file) { return file.sha256 == found.sha256; };
  const auto again = std::find_if(sources.files.begin(), sources.files.end(), same);
  if (again != sources.files.end())
    return bad_input(log.file + ": this log is the same as " + again->file +
                     "; give the log of each traverse only once");
  sources.files.push_back({log.file, found.sha256});
  sources.started_utc = std::max(sources.started_utc, found.started_utc);
  algo::Traverse traverse{log.axis, {}};
  const double sign = target_sign(command, rig, log.axis);
  for (const Point& stop : found.stops)
    traverse.stops.push_back({sign * stop.position_m, stop.probe_m, stop.probe_u_m});
  if (traverse.stops.size() < 2)
    return bad_input(
        log.file +
        ": the axis stops at only one position in this log, but the calibration needs two or more "
        "positions. " +
        clearance_warning(rig, log.axis) +
        "Record the log again with two or more stops, as far apart as the clearance allows");
  return traverse;
}

Result<Sources> read_all(const MountingCommand& command, const Rig& rig) {
  Sources sources;
  for (const std::string& clamping : command.clampings) {
    MDOF_TRY(const auto logs, parse_log_names(clamping));
    sources.clampings.emplace_back();
    for (const NamedLog& log : logs) {
      MDOF_TRY(auto traverse, read_traverse(command, rig, log, sources));
      sources.clampings.back().traverses.push_back(std::move(traverse));
    }
  }
  return sources;
}

CalibratedProbe as_record(const MountedProbe& found, const Probe& probe) {
  CalibratedProbe kept;
  kept.id = found.id;
  if (found.position_seen) {
    kept.position_m = found.position_m;
    kept.u_position_m = found.u_position_m;
  }
  if (found.direction_seen) {
    kept.direction = found.direction;
    kept.u_direction_rad = found.u_direction_rad;
  }
  if (found.zero_seen) {
    kept.offset_um = new_offset_um(probe, found.zero_m);
    kept.u_offset_m = found.u_zero_m;
  }
  return kept;
}

void fill(CalibrationRecord& record, const MountingCalibration& found, const Rig& rig,
          const std::vector<CalibrationRecord::Source>& files) {
  record.sources = files;
  record.chi_square = found.chi_square;
  record.freedom = found.freedom;
  record.not_seen = found.not_seen;
  record.sensitivities.emplace();
  for (const CalibrationRecord& used : rig.records) record.sensitivities->push_back(used.id);
  record.covariance = found.covariance;
  const Vec3& together = found.u_together_m;
  if (std::all_of(together.begin(), together.end(), [](double u) { return std::isfinite(u); }))
    record.u_together_m = together;
  for (std::size_t k = 0; k < rig.probes.size(); ++k)
    record.probes.push_back(as_record(found.probes[k], rig.probes[k]));
}

Status calibrate(const MountingCommand& command) {
  MDOF_TRY(const Rig rig, load_rig(command.rig));
  MDOF_TRY(const Sources sources, read_all(command, rig));
  MDOF_TRY(auto record, begin_record("mounting", rig, command.record, sources.started_utc));
  MDOF_TRY(const auto fit, algo::fit_mounting(rig, sources.clampings));
  const MountingCalibration& found = fit.found;
  if (!found.explained)
    warn(
        "chi-square is larger than expected from the noise of the readings. Possible causes: a "
        "probe has a wrong sensitivity, and the rig does not declare its u_sensitivity_ppm; the "
        "target is not flat; the target moved in its clamp; the axis is not straight. Therefore "
        "mdof has increased the uncertainties. They still do not contain an error that all "
        "clampings have in common. Runs with this record are doubtful");
  fill(record, found, rig, sources.files);
  if (!command.record.out.empty())
    MDOF_CHECK(write_record(command.record.out, record_text(record)));
  if (command.json)
    return write_line(mounting_json(found, record, command.record.out, rig.declares_uncertainty()));
  MDOF_CHECK(write_out(mounting_text(found, rig, terminal_columns())));
  return command.record.out.empty()
             ? Status()
             : write_line(command.record.out +
                          " is written; add this line to the rig file: calibration = \"" +
                          command.record.out + "\"");
}

Action declare_mounting(CLI::App& command) {
  const auto o = std::make_shared<MountingCommand>();
  command
      .add_option("CLAMPING", o->clampings,
                  "Logs of one clamping, each with the axis that moved: X=FILE,Y=FILE")
      ->required()
      ->type_name("");
  command.add_option("--rig", o->rig, "Rig file with the nominal mounting of the probes")
      ->required()
      ->type_name("RIG.toml");
  command
      .add_option("--reversed", o->reversed,
                  "Axes along which mdof calculates the wrong direction of the target motion from "
                  "the rig and the encoder; mdof then uses the opposite direction")
      ->delimiter(',')
      ->type_name("X,Y,Z")
      ->check(CLI::IsMember({"X", "Y", "Z"}));
  add_record_options(command, o->record);
  add_json_flag(command, o->json);
  return [o] { return calibrate(*o); };
}

}  // namespace

Command calibrate_mounting_command() {
  return {
      .name = "calibrate mounting",
      .summary = "Find the positions and directions of the probes from a target at several tilts",
      .footer =
          "HAZARD: a traverse along the measuring direction of a probe drives the target into\n"
          "the probe. On a rig for X, a traverse of Y drives the target into the probes D\n"
          "and E; the range of these probes may end after 100 um. A tilt of 1 mrad reduces a\n"
          "gap by 1 um for each mm of distance from the axis of the tilt.\n"
          "First run \"mdof clearance RIG.toml\" for each rig. Retract the probes that this\n"
          "command lists, or leave out the traverses that drive the target into these probes.\n"
          "Clamp the target at three or more tilts of some mrad about different axes, each\n"
          "tilt also in the opposite direction. At each tilt, move each axis that does not\n"
          "drive the target towards a probe. Move it by some mm, with five or more stops, and\n"
          "record each of these traverses as a separate log.\n"
          "Example:\n"
          "  mdof calibrate mounting X=x1.csv,Y=y1.csv X=x2.csv,Y=y2.csv X=x3.csv,Y=y3.csv \\\n"
          "    --rig rig_X.toml --out mounting.toml",
      .declare = declare_mounting};
}

}  // namespace mdof::tools
