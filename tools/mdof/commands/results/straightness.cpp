// mdof straightness FILE.csv: calculates straightness from a measured series, for each reference
// line.
#include <CLI/CLI.hpp>

#include <filesystem>

#include "algo/iso230/reference_lines.h"
#include "daemon/output/charts/analysis/analysis_charts.h"
#include "daemon/output/charts/plot_files.h"
#include "drivers/csv/csv_table.h"
#include "schema/iso230/iso230_json.h"
#include "schema/units.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/text/run_tables.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

struct StraightnessCommand {
  std::string file, plots;
  bool json = false;
};

std::vector<double> converted(std::vector<double> values, double (*convert)(double)) {
  for (double& v : values) v = convert(v);
  return values;
}

Result<ReferenceLines> lines_of(const drivers::CsvTable& series) {
  auto lines = algo::reference_lines(converted(series.columns[0], from_mm),
                                     converted(series.columns[1], from_um));
  if (!lines) return in_context(series.source, std::move(lines.error()));
  return lines;
}

std::string straightness_json(const ReferenceLines& lines, bool simulated) {
  JsonWriter json;
  json.begin_object()
      .field("readings", static_cast<std::uint64_t>(lines.readings))
      .field("positions", static_cast<std::uint64_t>(lines.positions))
      .field("first_mm", to_mm(lines.first_m))
      .field("last_mm", to_mm(lines.last_m))
      .field("simulated", simulated);
  write_reference_lines(json, lines);
  json.end_object();
  return json.take();
}

std::string straightness_table(const ReferenceLines& lines) {
  TextTable table({"line", "slope/(µm/m)", "at 0/µm", "zone/µm", "residual/µm"});
  const auto add = [&](const char* name, const ReferenceLine& line) {
    table.add({name, in_urad(line.slope_rad), in_um(line.intercept_m), in_um(line.zone_m),
               in_um(line.residual_m)});
  };
  add("end points", lines.end_point);
  add("least squares", lines.least_squares);
  add("minimum zone", lines.minimum_zone);
  return std::to_string(lines.readings) + " readings at " + std::to_string(lines.positions) +
         " positions from " + in_mm(lines.first_m) + " to " + in_mm(lines.last_m) + " mm\n" +
         table.text() +
         "at 0: value of the line at position 0\n"
         "zone: peak to valley about the line; residual: RMS distance from the line\n";
}

Status draw_lines(const StraightnessCommand& command, const drivers::CsvTable& series,
                  const ReferenceLines& lines) {
  if (command.plots.empty()) return {};
  charts::StraightnessPicture picture;
  picture.about = std::filesystem::path(series.source).filename().string();
  picture.position_m = converted(series.columns[0], from_mm);
  picture.deviation_m = converted(series.columns[1], from_um);
  picture.lines = lines;
  const auto language = words::Language::english;
  if (series.simulated)
    picture.warnings = {output::phrase(output::Phrase::simulated_machine, language)};
  return write_plots({{"straightness.svg", charts::reference_lines_svg(picture, language)}},
                     command.plots);
}

Status straightness(const StraightnessCommand& command) {
  MDOF_TRY(const auto series,
           drivers::read_csv_table(command.file, {"position_mm", "deviation_um"}));
  MDOF_TRY(const ReferenceLines lines, lines_of(series));
  if (lines.positions < lines.readings)
    warn(
        "several readings have the same position: mdof uses all readings, and the end-point line "
        "goes through the mean readings at the two ends");
  MDOF_CHECK(draw_lines(command, series, lines));
  if (command.json) return write_line(straightness_json(lines, series.simulated));
  return write_out(simulated_notice(series.simulated) + straightness_table(lines));
}

Action declare_straightness(CLI::App& command) {
  const auto o = std::make_shared<StraightnessCommand>();
  command
      .add_option(
          "FILE", o->file,
          "CSV, CSV.gz, or - for standard input, with the columns position_mm, deviation_um")
      ->required()
      ->type_name("");
  add_plot_option(command, o->plots);
  add_json_flag(command, o->json);
  return [o] { return straightness(*o); };
}

}  // namespace

Command straightness_command() {
  return {.name = "straightness",
          .summary = "Calculate straightness from a file, for each reference line",
          .footer = "Example:\n  mdof straightness deviations.csv --json",
          .declare = declare_straightness};
}

}  // namespace mdof::tools
