// mdof form scan RUN...: builds a height map of a part on a spindle from runs in which a probe
// scanned the part.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include "algo/form/map_figures.h"
#include "schema/base/json_writer.h"
#include "schema/units.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/commands/form/map_file.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/run_choice.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

constexpr const char* kScanU =
    "the noise between neighbouring heights, u of the subtracted axis errors at the targets, and "
    "u of their linear interpolation between the targets. u does not contain: noise that is common "
    "to neighbouring heights; errors of the probe calibration, the "
    "encoder, the spindle and the spindle angle; undeclared delays of the readings";

struct FormScanCommand {
  std::vector<std::string> runs;
  std::optional<double> pixel_mm;
  std::string database, out, plots;
  bool json = false;
};

std::string scan_json(const daemon::RadialScan& scan, const std::vector<std::int64_t>& runs) {
  const algo::MapFigures figures = algo::figures_of(scan.map);
  JsonWriter json;
  json.begin_object().key("runs").begin_array();
  for (const std::int64_t run : runs) json.value(run);
  json.end_array()
      .field("simulated", scan.simulated)
      .field("pv_um", to_um(figures.pv_m))
      .field("rms_um", to_um(figures.rms_m))
      .field("pixels", static_cast<std::uint64_t>(figures.pixels))
      .field("pixel_mm", to_mm(scan.pixel_m))
      .field("heights", static_cast<std::uint64_t>(scan.points))
      .field("heights_beyond_targets", static_cast<std::uint64_t>(scan.beyond_targets))
      .field("heights_in_other_direction", static_cast<std::uint64_t>(scan.other_direction))
      .field("heights_without_place", static_cast<std::uint64_t>(scan.unplaced_heights))
      .field("motion_taken_out_pv_um", to_um(scan.motion_pv_m))
      .field("u_um", to_um(std::hypot(scan.u_noise_m, scan.u_motion_m, scan.u_between_m)))
      .key("u_parts_um")
      .begin_object()
      .field("noise", to_um(scan.u_noise_m))
      .field("motion", to_um(scan.u_motion_m))
      .field("between_targets", to_um(scan.u_between_m))
      .end_object()
      .field("u_covers", kScanU)
      .end_object();
  return json.take();
}

std::string scan_text(const daemon::RadialScan& scan) {
  const algo::MapFigures figures = algo::figures_of(scan.map);
  return scan.map.name + ": PV " + in_um(figures.pv_m) + " µm, RMS " + in_um(figures.rms_m) +
         " µm about the mean, " + std::to_string(figures.pixels) + " pixels of " +
         in_mm(scan.pixel_m) + " mm from " + std::to_string(scan.points) +
         " heights\n"
         "subtracted error motion of the axis at the probe: " +
         in_um(scan.motion_pv_m) + " µm PV\nu of a height " +
         in_um(std::hypot(scan.u_noise_m, scan.u_motion_m, scan.u_between_m)) + " µm (noise " +
         in_um(scan.u_noise_m) + " µm, motion " + in_um(scan.u_motion_m) + " µm, between targets " +
         in_um(scan.u_between_m) + " µm). u contains " + kScanU + "\n";
}

Status form_scan(const FormScanCommand& o) {
  const auto pixel_m = o.pixel_mm ? std::optional(from_mm(*o.pixel_mm)) : std::nullopt;
  std::vector<std::int64_t> runs;
  for (const std::string& run : o.runs) {
    MDOF_TRY(const std::int64_t number, run_number(o.database, run));
    if (std::find(runs.begin(), runs.end(), number) != runs.end())
      return fail(ErrorCode::usage, "run " + std::to_string(number) +
                                        " is given twice, so its heights would count twice; give "
                                        "each run once");
    runs.push_back(number);
  }
  MDOF_TRY(const auto scan, load_scan(runs, pixel_m, o.database));
  MDOF_CHECK(save_maps(scan.map, o.out, {{"map", scan.map.name, scan.map}}, o.plots));
  return o.json ? write_line(scan_json(scan, runs)) : write_out(scan_text(scan));
}

Action declare_form_scan(CLI::App& command) {
  const auto o = std::make_shared<FormScanCommand>();
  add_run_arguments(command, o->runs,
                    "Numbers of the runs of one part (see mdof runs), or \"latest\"");
  command
      .add_option("--pixel-mm", o->pixel_mm,
                  "Pixel size of the map [default: a hundredth of the diameter]")
      ->check(positive_number());
  command.add_option("--out", o->out, "Write the height map to this file (CSV)")->type_name("FILE");
  add_database_option(command, o->database);
  add_plot_option(command, o->plots);
  add_json_flag(command, o->json);
  return [o] { return form_scan(*o); };
}

}  // namespace

Command form_scan_command() {
  return {.name = "form scan",
          .summary = "Build a height map of a part on a spindle from a scanning probe",
          .footer =
              "The table [scan] in the rig of the run gives the probe, the probe position, and the "
              "log column of the spindle angle.\n"
              "The other form commands accept the number of such a run instead of a map file.\n"
              "Examples:\n"
              "  mdof form scan 12 --out before.csv\n"
              "  mdof form compare 12 13",
          .declare = declare_form_scan};
}

}  // namespace mdof::tools
