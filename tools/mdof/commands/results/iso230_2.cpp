// mdof iso230-2 FILE.csv, mdof iso230-2 --run RUN: calculates the parameters of ISO 230-2 from
// positioning readings in a file or in an imported run, or from the errors of a stored run.
#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

#include "algo/compensation/imported_table.h"
#include "algo/iso230/positioning/positioning.h"
#include "algo/iso230/positioning/positioning_uncertainty.h"
#include "algo/iso230/positioning/run_readings.h"
#include "daemon/measure/evaluation.h"
#include "daemon/measure/gate/gate.h"
#include "daemon/measure/imported/import.h"
#include "daemon/measure/imported/positioning_figures.h"
#include "daemon/output/charts/analysis/analysis_charts.h"
#include "daemon/output/charts/plot_files.h"
#include "daemon/output/charts/run/points.h"
#include "daemon/words/words.h"
#include "drivers/csv/positioning_csv.h"
#include "schema/imported/series.h"
#include "schema/iso230/iso230_json.h"
#include "schema/run_json.h"
#include "schema/uncertainty/budget_json.h"
#include "schema/units.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/stored/run_choice.h"
#include "tools/mdof/stored/run_positioning.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/analyses/positioning_text.h"
#include "tools/mdof/text/notice_lines.h"
#include "tools/mdof/text/run_tables.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

struct Iso230Command {
  std::string file, run, axis, database, reference = "fixture", plots;
  RunPositioningRequest of_run;
  double scale_period_mm = 0;
  std::optional<double> device_limit_um, drift_um;
  bool json = false, all_warnings = false;
};

// The measurement uncertainty that the options declare; nullopt: no contribution is declared.
std::optional<PositioningUncertainty> uncertainty_of(const Iso230Command& command) {
  if (!command.device_limit_um && !command.drift_um) return std::nullopt;
  return algo::positioning_uncertainty({from_um(command.device_limit_um.value_or(kNoFigure)),
                                        from_um(command.drift_um.value_or(kNoFigure))});
}

std::string uncertainty_text(const std::optional<PositioningUncertainty>& U) {
  if (!U) return "uncertainty: not declared; give --device-limit-um and --drift-um\n";
  const std::string missing = !std::isfinite(U->device)  ? "--device-limit-um"
                              : !std::isfinite(U->drift) ? "--drift-um"
                                                         : "";
  return "U (k = 2): " + um_to_place(U->E_M_A, U->E_M_A) + " µm for E, M and A, " +
         um_to_place(U->B, U->B) + " µm for B\n" +
         (missing.empty() ? "" : "\"-\": unknown, because " + missing + " is not given\n") +
         "U contains the measuring device and the drift, but not the temperature of the\n"
         "machine and the alignment\n";
}

Status draw_file(const drivers::PositioningCsv& csv, const Positioning& figures,
                 const std::string& folder) {
  if (folder.empty()) return {};
  const auto language = words::Language::english;
  charts::PositioningPicture picture;
  picture.title = output::phrase(output::Phrase::positioning_of_run, language);
  picture.about = std::filesystem::path(csv.source).filename().string();
  if (csv.simulated)
    picture.warnings = {output::phrase(output::Phrase::simulated_machine, language)};
  picture.series = {{"deviation_um", figures, csv.readings}};
  return write_plots({{"iso230-2.svg", charts::positioning_svg(picture, language)}}, folder);
}

// The U of the readings' scatter and of the uncertainty that the import declared.
std::string uncertainty_text(const StatedFigures& figures) {
  std::string text;
  for (const Budget& budget : figures.budgets)
    text += (text.empty() ? "U (95 %): " : ", ") +
            budget.figure.substr(0, budget.figure.rfind('_')) + " " +
            um_to_place(budget.U, budget.U) + " µm";
  return text + "\nu covers " + covers_text(figures.budgets) + "\n";
}

// `declared`: the figures of a run whose import declared u; otherwise no figures.
Status iso230_of_readings(const Iso230Command& command, const drivers::PositioningCsv& csv,
                          const StatedFigures& declared = {}) {
  auto figures = algo::positioning(csv.readings);
  if (!figures) return in_context(csv.source, std::move(figures.error()));
  Notices notices = algo::plan_notices(*figures, from_mm(command.scale_period_mm));
  append(notices, algo::slope_notices(*figures));
  std::vector<double> target_m, deviation_m;
  for (const PositioningReading& reading : csv.readings) {
    target_m.push_back(reading.target_m);
    deviation_m.push_back(reading.deviation);
  }
  append(notices, daemon::deviation_unit_notices(std::move(target_m), deviation_m));
  show_notices(notices, command.all_warnings);
  MDOF_CHECK(draw_file(csv, *figures, command.plots));
  const auto U = uncertainty_of(command);
  if (!command.json) {
    const PositioningColumn column{"deviation", false, std::move(*figures)};
    return write_out(simulated_notice(csv.simulated) +
                     parameters_text({column}, terminal_columns()) + "\n" +
                     targets_text(column, terminal_columns()) + "\n" +
                     (declared.budgets.empty() ? uncertainty_text(U) : uncertainty_text(declared)));
  }
  JsonWriter json;
  json.begin_object().field("simulated", csv.simulated);
  write_positioning(json, *figures, false);
  if (!declared.budgets.empty()) {
    write_stated(json, declared);
    write_covers(json, declared.budgets);
  } else {
    json.key("uncertainty");
    U ? write_positioning_uncertainty(json, *U) : static_cast<void>(json.null());
  }
  json.end_object();
  return write_line(with_notices(json.take(), notices, words::text));
}

// The readings of an imported run of positioning errors, with the sign of the command.
Result<drivers::PositioningCsv> readings_of_imported(const Run& run) {
  const std::string name = "run " + std::to_string(run.header.id);
  if (run.header.provenance.model != positioning_name(run.header.axis))
    return bad_input(
        name + " was imported as " + run.header.provenance.model +
        "; mdof can calculate the parameters of ISO 230-2 only if a run was imported as "
        "positioning errors (" +
        positioning_name(run.header.axis) + ")");
  if (daemon::has_unknown_approach(run))
    return bad_input(name +
                     ": the file does not state the approach of each reading, which ISO 230-2 "
                     "needs; import a file with a column direction (1 or -1)");
  MDOF_TRY(const double sign, algo::command_sign(run.header));
  drivers::PositioningCsv csv{
      name + " (" + run.header.provenance.recording_path + ")", run.header.simulated, {}};
  for (const MeasuredPoint& p : run.points)
    csv.readings.push_back({p.target_m, p.point.direction, p.run, sign * deviation(p)});
  return csv;
}

Status draw_run(const Run& run, const RunPositioning& found, const std::string& folder) {
  if (folder.empty()) return {};
  const auto language = words::Language::english;
  charts::PositioningPicture picture;
  picture.title = charts::run_title(
      run.header, output::phrase(output::Phrase::positioning_of_run, language), language);
  picture.about = charts::about_run(run.header, language);
  picture.warnings = daemon::warning_marks(run);
  for (const PositioningColumn& column : found.columns)
    for (std::size_t k = 0; k < kErrorCount; ++k)
      if (column.name == error_names(run.header.axis)[k].name)
        picture.series.push_back({error_names(run.header.axis)[k].key, column.figures,
                                  algo::readings_of_run(run, k, found.keep_slope).readings});
  const std::string name = "run-" + std::to_string(run.header.id) + "-iso230-2.svg";
  return write_plots({{name, charts::positioning_svg(picture, language)}}, folder);
}

Status iso230_of_run(const Iso230Command& command) {
  Reference reference{};
  reference_from(command.reference, reference);  // the option accepts only valid names
  MDOF_TRY(store::Store store, open_to_read(command.database));
  MDOF_TRY(const auto id, run_number(store, command.run, axis_from(command.axis)));
  MDOF_TRY(const Run run, daemon::restated_run(store, id, reference));
  if (is_imported(run.header)) {
    MDOF_TRY(const auto readings, readings_of_imported(run));
    const StatedFigures figures = daemon::positioning_figures(run);
    const bool declares_u =
        !figures.budgets.empty() && figures.budgets.front().not_declared.empty();
    if (!declares_u || uncertainty_of(command)) return iso230_of_readings(command, readings);
    return iso230_of_readings(command, readings, figures);
  }
  if (uncertainty_of(command))
    return fail(ErrorCode::usage,
                "--device-limit-um and --drift-um apply to files and imported runs only; leave "
                "them out, because mdof takes the uncertainties of run " +
                    std::to_string(id) + " from its rig");
  MDOF_TRY(const RunPositioning found,
           run_positioning(run, command.of_run, from_mm(command.scale_period_mm)));
  show_notices(found.notices, command.all_warnings);
  MDOF_CHECK(draw_run(run, found, command.plots));
  return command.json ? write_line(run_positioning_json(run, found))
                      : write_out(run_positioning_text(run, found, terminal_columns()));
}

Status iso230(const Iso230Command& command) {
  if (!command.file.empty()) {
    MDOF_TRY(const auto csv, drivers::read_positioning_csv(command.file));
    return iso230_of_readings(command, csv);
  }
  if (!command.run.empty()) return iso230_of_run(command);
  return fail(ErrorCode::usage, "missing input; give FILE.csv, or --run RUN for a stored run");
}

Action declare_iso230_2(CLI::App& command) {
  const auto o = std::make_shared<Iso230Command>();
  auto* file = command
                   .add_option("FILE", o->file,
                               "CSV, CSV.gz, or - for standard input, with the columns target_mm, "
                               "direction (1 or -1), run, deviation_um")
                   ->type_name("");
  auto* run =
      command
          .add_option("--run", o->run,
                      "Number of the stored run, or \"latest\"; mdof evaluates the errors of the "
                      "run, or its readings if the run was imported (such as a laser file)")
          ->type_name("RUN")
          ->check(run_argument_error)
          ->excludes(file);
  command
      .add_option("--error", o->of_run.errors,
                  "Evaluate this error of the run, such as EYX [default: all five errors]")
      ->type_name("NAME")
      ->needs(run);
  add_latest_axis_option(command, o->axis);
  command.get_option("--axis")->needs(run);
  add_reference_option(command, o->reference)->capture_default_str()->needs(run);
  command
      .add_flag("--keep-slope", o->of_run.keep_slope,
                "Keep the slope of straightness errors; this slope depends on the alignment of the "
                "target")
      ->needs(run);
  command.add_flag("--partial", o->of_run.partial, "Also accept a partial run")->needs(run);
  command
      .add_option("--scale-period-mm", o->scale_period_mm,
                  "Signal period of the scale; mdof warns if all target intervals are whole "
                  "multiples of this period")
      ->check(positive_number());
  command
      .add_option(
          "--device-limit-um", o->device_limit_um,
          "Error limit (±) of the measuring device over the travel, needed for U (ISO/TR 230-9)")
      ->check(not_negative_number());
  command
      .add_option(
          "--drift-um", o->drift_um,
          "Drift E_VE (ISO/TR 230-9): range of the readings with the axis at rest, over the "
          "duration of the test")
      ->check(not_negative_number());
  add_database_option(command, o->database);
  add_plot_option(command, o->plots);
  add_json_flag(command, o->json);
  add_all_warnings_flag(command, o->all_warnings);
  return [o] { return iso230(*o); };
}

}  // namespace

Command iso230_2_command() {
  return {.name = "iso230-2",
          .summary = "Calculate the parameters of ISO 230-2 from a file or a run",
          .footer =
              "Examples:\n"
              "  mdof iso230-2 positioning_X.csv --device-limit-um 0.8 --drift-um 1.5\n"
              "  mdof iso230-2 --run 12 --error EYX",
          .declare = declare_iso230_2};
}

}  // namespace mdof::tools
