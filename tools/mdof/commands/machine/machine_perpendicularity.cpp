// mdof machine perpendicularity FILE.csv: calculates the tilt of a rotary table relative to the XY
// plane, from readings while X, Y and the table move together on a circle.
#include <CLI/CLI.hpp>
#include <cmath>
#include <numbers>

#include "algo/machine/geometric_tests/perpendicularity.h"
#include "drivers/csv/csv_table.h"
#include "schema/base/json_writer.h"
#include "schema/sample.h"
#include "schema/units.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/run_tables.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

struct PerpendicularityCommand {
  std::string file;
  double radius_mm = 0;
  int harmonics = 5;
  bool json = false;
};

std::vector<double> scaled(const std::vector<double>& values, double by) {
  std::vector<double> out;
  for (const double v : values) out.push_back(v * by);
  return out;
}

std::string counted_text(const algo::Perpendicularity& p) {
  std::string text;
  if (!p.tilt_known)
    text +=
        "EA0C and EB0C contain a part of the tilt error motion of the table (2 cycles per turn), "
        "because the column EAC_urad or EBC_urad (or both) is missing.\n";
  if (!p.axes_known)
    text +=
        "EA0C and EB0C contain a part of the errors of X and Y (1 cycle per turn), because the "
        "column axes_um is missing.\n";
  if (!p.drift_fitted)
    text +=
        "The readings do not cover enough of a second turn. Therefore EA0C and EB0C contain the "
        "drift of the height, but u does not. To separate the drift, measure at least two "
        "turns, with the readings in the order of time.\n";
  return text;
}

std::string perpendicularity_json(const algo::Perpendicularity& p, double radius_mm,
                                  bool simulated) {
  JsonWriter json;
  json.begin_object()
      .field("EA0C_urad", to_urad(p.EA0C_rad))
      .field("EB0C_urad", to_urad(p.EB0C_rad))
      .field("u_urad", to_urad(p.u_rad))
      .field("U_urad", to_urad(p.U_rad))
      .field("k", p.k)
      .field("nu", p.freedom)
      .field("size_urad", to_urad(p.size_rad))
      .field("sense",
             "EA0C, EB0C: rotation of the table axis about X and Y, relative to the normal of the "
             "XY plane")
      .field("u_covers", "noise of the readings only")
      .field("noise_only", true)
      .field("radius_mm", radius_mm)
      .field("mean_um", to_um(p.mean_m))
      .field("residual_sd_um", to_um(p.residual_sd_m))
      .field("tilt_taken_away", p.tilt_known)
      .field("axes_taken_away", p.axes_known)
      .field("turns", p.turns)
      .field("drift_taken_away", p.drift_fitted)
      .field("drift_um", p.drift_fitted ? to_um(p.drift_m) : kNaN)
      .field("u_drift_um", p.drift_fitted ? to_um(p.u_drift_m) : kNaN)
      .field("simulated", simulated)
      .key("harmonics")
      .begin_array();
  for (const algo::Harmonic& h : p.harmonics)
    json.begin_object()
        .field("order", h.order)
        .field("cosine_um", to_um(h.cosine_m))
        .field("sine_um", to_um(h.sine_m))
        .field("u_um", to_um(h.u_m))
        .end_object();
  json.end_array().end_object();
  return json.take();
}

std::string perpendicularity_text(const algo::Perpendicularity& p, bool simulated) {
  TextTable table({"harmonic", "cosine/µm", "sine/µm", "u/µm"});
  for (const algo::Harmonic& h : p.harmonics)
    table.add({std::to_string(h.order), um_to_place(h.cosine_m, h.u_m),
               um_to_place(h.sine_m, h.u_m), um_to_place(h.u_m, h.u_m)});
  const std::string drift =
      p.drift_fitted
          ? "drift from the first to the last reading (subtracted): " +
                with_u(um_to_place(p.drift_m, p.u_drift_m), um_to_place(p.u_drift_m, p.u_drift_m)) +
                " µm\n"
          : "";
  const auto tilt = [&p](double tilt_rad) {
    return with_u(urad_to_place(tilt_rad, p.U_rad), urad_to_place(p.u_rad, p.u_rad));
  };
  return noise_only_notice(true) + simulated_notice(simulated) + "EA0C = " + tilt(p.EA0C_rad) +
         " µrad, EB0C = " + tilt(p.EB0C_rad) +
         " µrad, expanded U of each angle = " + urad_to_place(p.U_rad, p.U_rad) +
         " (k = " + fixed(p.k, 2) + ", 95 %)\n" +
         "angle between the table axis and the normal of the XY plane: " +
         urad_to_place(p.size_rad, p.U_rad) + " µrad\n" + table.text(terminal_columns()) +
         "residual " + in_um(p.residual_sd_m) +
         " µm; ± is the standard uncertainty u, which contains the noise of the readings only\n" +
         drift + counted_text(p);
}

Status machine_perpendicularity(const PerpendicularityCommand& o) {
  if (!std::isfinite(o.radius_mm))
    return fail(ErrorCode::usage, "--radius-mm must be a finite number");
  MDOF_TRY(const auto csv, drivers::read_csv_table(o.file, {"angle_deg", "height_um"},
                                                   {"EAC_urad", "EBC_urad", "axes_um", "time_s"}));
  algo::CircleReadings readings{from_mm(o.radius_mm),
                                scaled(csv.columns[0], std::numbers::pi / 180),
                                scaled(csv.columns[1], from_um(1)),
                                csv.columns[5],
                                scaled(csv.columns[2], from_urad(1)),
                                scaled(csv.columns[3], from_urad(1)),
                                scaled(csv.columns[4], from_um(1))};
  auto p = algo::perpendicularity(readings, o.harmonics);
  if (!p) return in_context(csv.source, std::move(p.error()));
  if (o.json) {
    if (const std::string text = counted_text(*p); !text.empty())
      warn(text.substr(0, text.size() - 1));
    return write_line(perpendicularity_json(*p, o.radius_mm, csv.simulated));
  }
  return write_out(perpendicularity_text(*p, csv.simulated));
}

Action declare_machine_perpendicularity(CLI::App& command) {
  const auto o = std::make_shared<PerpendicularityCommand>();
  command
      .add_option("FILE", o->file,
                  "CSV with the columns angle_deg (angle of the spot about the table axis, from +X "
                  "to +Y) and height_um (height of the table, positive towards +Z). Optional "
                  "columns: EAC_urad, EBC_urad (tilt error motion of the table), axes_um (height "
                  "error of X and Y), time_s. The rows must be in the order of time; with more "
                  "than 7/6 of a turn, mdof subtracts a linear drift")
      ->required()
      ->type_name("");
  command.add_option("--radius-mm", o->radius_mm, "Radius of the circle")
      ->required()
      ->check(positive_number());
  command.add_option("--harmonics", o->harmonics, "Number of harmonics in the fit")
      ->check(CLI::Range(1, 50))
      ->capture_default_str();
  add_json_flag(command, o->json);
  return [o] { return machine_perpendicularity(*o); };
}

}  // namespace

Command machine_perpendicularity_command() {
  return {.name = "machine perpendicularity",
          .summary = "Find the squareness of a rotary table's axis to the XY plane from a circle",
          .footer = "Example:\n  mdof machine perpendicularity circle.csv --radius-mm 100",
          .declare = declare_machine_perpendicularity};
}

}  // namespace mdof::tools
