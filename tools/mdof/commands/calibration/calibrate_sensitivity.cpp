// mdof calibrate sensitivity LOG: calibrates the sensitivity of a probe against the encoder of the
// axis that moves the target towards the probe.
#include <CLI/CLI.hpp>
#include <cmath>

#include "algo/calibration/sensitivity.h"
#include "daemon/measure/stops.h"
#include "schema/base/json_writer.h"
#include "schema/base/number/number_text.h"
#include "schema/uncertainty/covers.h"
#include "schema/units.h"
#include "tools/mdof/commands/calibration/record_file.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/text/notice_lines.h"
#include "tools/mdof/text/run_tables.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

struct SensitivityCommand {
  std::string log, rig, probe;
  RecordOptions record;
  bool reversed = false, json = false;
};

std::string json_of(const SensitivityCalibration& found, const CalibrationRecord& record,
                    const std::string& file, bool rig_declares) {
  JsonWriter json;
  json.begin_object().field("kind", "sensitivity").field("rig", record.rig);
  json.field("date", record.date).field("valid_until", record.valid_until).key("record");
  file.empty() ? json.null() : json.value(file);
  json.field("probe", found.id).field("sensitivity_1", found.sensitivity_1);
  json.field("u_sensitivity_ppm", found.relative_u() * 1e6).field("dof", found.freedom);
  json.key("not_seen").begin_array();
  for (const std::string& what : found.not_seen) json.value(what);
  json.end_array();
  json.field("from_um", to_um(found.from_m)).field("to_um", to_um(found.to_m));
  json.field("stops", static_cast<std::uint64_t>(found.stops));
  json.field("linearity_um", to_um(found.linearity_m));
  json.field("residual_sd_um", to_um(found.residual_sd_m)).key("um_per_V");
  found.um_per_V ? json.value(*found.um_per_V) : json.null();
  json.field("offset_um", found.offset_um).key("linearity").begin_array();
  for (const auto& [reading_um, correction_um] : found.linearity)
    json.begin_array().value(reading_um).value(correction_um).end_array();
  json.end_array().key("calibrated_um").begin_array();
  for (const double reading_um : found.calibrated_um) json.value(reading_um);
  json.end_array()
      .field("u_covers",
             covers_text(Covers{rig_declares ? Covered::noise_declared : Covered::noise_only}))
      .field("noise_only", !rig_declares)
      .end_object();
  return json.take();
}

std::string missing_in_u_text(const SensitivityCalibration& found) {
  std::string text = "\u00b1 is the standard uncertainty u";
  if (std::isfinite(found.freedom))
    text += " with " + plain_number(found.freedom, 3) + " degrees of freedom";
  text += ". It does not include:\n";
  for (const std::string& what : found.not_seen) text += "- " + what + "\n";
  return text;
}

std::string text_of(const SensitivityCalibration& found, bool rig_declares) {
  std::string text = noise_only_notice(!rig_declares) + "probe " + found.id + ": sensitivity " +
                     with_u(found.sensitivity_1, found.u_sensitivity_1, 6) +
                     " (reading per displacement)\n" + std::to_string(found.stops) +
                     " stops, readings from " + fixed(to_um(found.from_m), 3) + " to " +
                     fixed(to_um(found.to_m), 3) + " um; residuals from the fitted line: at most " +
                     fixed(to_um(found.linearity_m), 4) + " um, standard deviation " +
                     fixed(to_um(found.residual_sd_m), 4) + " um\n" + missing_in_u_text(found) +
                     "Lines for the rig file:\n";
  if (found.um_per_V) text += "um_per_V = " + plain_number(*found.um_per_V, 9) + "\n";
  if (found.um_per_V) text += "offset_um = " + plain_number(found.offset_um, 9) + "\n";
  text += "linearity = [";
  for (std::size_t i = 0; i < found.linearity.size(); ++i)
    text += (i > 0 ? ", [" : "[") + fixed(found.linearity[i][0], 3) + ", " +
            fixed(found.linearity[i][1], 4) + "]";
  return text + "]\n";
}

CalibratedProbe as_record(const SensitivityCalibration& found, const Probe& probe) {
  CalibratedProbe kept;
  kept.id = found.id;
  kept.um_per_V = found.um_per_V;
  kept.linearity = found.linearity;
  kept.calibrated_um = found.calibrated_um;
  kept.u_sensitivity_1 = found.relative_u();
  kept.sensitivity_freedom = found.freedom;
  if (!found.um_per_V) return kept;
  kept.offset_um = found.offset_um;
  kept.u_offset_m = probe.uncertainty.calibration.u;
  return kept;
}

Status calibrate(const SensitivityCommand& command) {
  MDOF_TRY(Rig rig, load_rig(command.rig));
  const auto at = rig.probe_index(command.probe);
  if (!at)
    return fail(ErrorCode::usage, command.rig + ": the rig has no probe \"" + command.probe +
                                      "\"; the probes of the rig are " + probe_ids(rig));
  Calibration& calibration = rig.probes[*at].calibration;
  calibration.linearity.clear();  // this command determines it
  calibration.polynomial_um.clear();
  MDOF_TRY(const Axis axis, algo::approaching_axis(rig, *at));
  MDOF_TRY(const auto log, daemon::read_stops(command.log, axis, rig));
  show_notices(log.notices, true);
  if (log.units[*at] != Unit::volt) calibration.um_per_V.reset();  // only used for voltages
  const double own = axis == rig.axis ? rig.sides.target_travel_m(1) : 1;
  algo::Traverse traverse{axis, {}};
  for (const Point& stop : log.stops)
    traverse.stops.push_back(
        {(command.reversed ? -own : own) * stop.position_m, stop.probe_m, stop.probe_u_m});
  MDOF_TRY(auto record, begin_record("sensitivity", rig, command.record, log.started_utc));
  MDOF_TRY(const auto found, algo::fit_sensitivity(rig, *at, traverse));
  record.sources = {{command.log, log.sha256}};
  record.not_seen = found.not_seen;
  record.probes = {as_record(found, rig.probes[*at])};
  const bool declares = rig.declares_uncertainty();
  if (!command.record.out.empty())
    MDOF_CHECK(write_record(command.record.out, record_text(record)));
  return command.json ? write_line(json_of(found, record, command.record.out, declares))
                      : write_out(text_of(found, declares));
}

Action declare_sensitivity(CLI::App& command) {
  const auto o = std::make_shared<SensitivityCommand>();
  command
      .add_option(
          "LOG", o->log,
          "Log recorded while an axis moved the target along the measuring direction of the probe")
      ->required()
      ->type_name("");
  command.add_option("--rig", o->rig, "Rig file, which describes the probes and the encoder")
      ->required()
      ->type_name("RIG.toml");
  command.add_option("--probe", o->probe, "Probe to calibrate")->required()->type_name("ID");
  command.add_flag("--reversed", o->reversed,
                   "Use the opposite direction of the target motion, because mdof calculates the "
                   "wrong direction from the rig and the encoder");
  add_record_options(command, o->record);
  add_json_flag(command, o->json);
  return [o] { return calibrate(*o); };
}

}  // namespace

Command calibrate_sensitivity_command() {
  return {.name = "calibrate sensitivity",
          .summary = "Calibrate the sensitivity of a probe against the encoder of an axis",
          .footer =
              "HAZARD: the target moves towards the probe. First use \"mdof clearance RIG.toml\"\n"
              "and \"mdof live\" to see where the range of the probe ends. Use small steps and\n"
              "stay within the range.\n"
              "Move the target towards the probe in steps over its range, and stop at each step.\n"
              "A scale error of the encoder is part of the result.\n"
              "Example:\n"
              "  mdof calibrate sensitivity z.csv --rig rig_X.toml --probe A --out A.toml",
          .declare = declare_sensitivity};
}

}  // namespace mdof::tools
