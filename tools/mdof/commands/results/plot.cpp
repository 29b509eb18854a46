// mdof plot RUN...: draws charts of stored runs as SVG files.
#include <CLI/CLI.hpp>

#include "daemon/measure/evaluation.h"
#include "daemon/measure/gate/gate.h"
#include "daemon/output/charts/machine/table_maps.h"
#include "daemon/output/charts/plot_files.h"
#include "daemon/output/charts/run/run_charts.h"
#include "schema/base/json_writer.h"
#include "schema/rig/reference.h"
#include "schema/run_json.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/report/stated_results.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/stored/raw_stop.h"
#include "tools/mdof/stored/run_choice.h"

namespace mdof::tools {
namespace {

struct PlotCommand {
  std::string database, axis, out, reference = "fixture", language = "en";
  std::vector<std::string> runs;
  std::vector<std::int64_t> tables;
  std::vector<std::size_t> points;
  bool json = false;
};

// The charts that the command writes, with their folders and file names.
struct PlannedCharts {
  std::vector<charts::NamedChart> charts;
  std::vector<std::string> left_out;

  void take(charts::RunCharts more) {
    for (auto& chart : more.charts) charts.push_back(std::move(chart));
    for (auto& text : more.left_out) left_out.push_back(std::move(text));
  }
};

// Draws the squareness of each pair of axes. If the squareness of a pair cannot be calculated, the
// other charts are drawn.
void draw_squareness(store::Store& store, const std::vector<charts::StatedResults>& runs,
                     output::Language language, PlannedCharts& plotted) {
  std::vector<const charts::StatedResults*> all;
  for (const auto& run : runs) all.push_back(&run);
  for (const charts::SquarenessOfPair& pair : squareness_of_runs(store, all)) {
    if (!pair.results) {
      plotted.left_out.push_back(std::string("no chart of the squareness of ") +
                                 letter(pair.axes.a) + " and " + letter(pair.axes.b) + ": " +
                                 pair.reason);
      continue;
    }
    const Squareness& s = pair.results->squareness;
    const std::string name =
        "squareness-" + std::to_string(s.run_a) + "-" + std::to_string(s.run_b) + ".svg";
    plotted.charts.push_back({name, charts::squareness_svg(*pair.results, language)});
  }
}

Status draw_table(store::Store& store, std::int64_t number, output::Language language,
                  PlannedCharts& plotted) {
  MDOF_TRY(const bool is_volumetric, store.is_volumetric(number));
  if (is_volumetric) {
    MDOF_TRY(const VolumetricTable volume, store.volumetric(number));
    plotted.take(charts::volumetric_table_charts(volume, language));
    return {};
  }
  MDOF_TRY(const CompensationTable table, store.table(number));
  MDOF_TRY(const daemon::Judged judged, daemon::judged_table(store, table));
  const std::string name = "table-" + std::to_string(number);
  if (charts::has_table(table))
    plotted.charts.push_back(
        {name + ".svg",
         charts::table_svg(table, daemon::warning_marks(judged, language), language)});
  else
    plotted.left_out.push_back("table " + std::to_string(number) + " has no values");
  return {};
}

Result<PlannedCharts> draw_all(const PlotCommand& command) {
  Reference reference{};
  output::Language language{};
  reference_from(command.reference, reference);  // the options accept only valid names
  output::language_from(command.language, language);
  MDOF_TRY(store::Store store, open_to_read(command.database));
  MDOF_TRY(const auto numbers, run_numbers(store, command.runs, command.axis));
  PlannedCharts plotted;
  std::vector<charts::StatedResults> runs;
  for (const std::int64_t number : numbers) {
    MDOF_TRY(auto results, stated_results(store, number, reference));
    plotted.take(charts::charts_of_run(results, language));
    for (const std::size_t row : command.points) {
      MDOF_TRY(const auto raw, raw_stop(results.run, row));
      plotted.charts.push_back(
          {"run-" + std::to_string(number) + "-point-" + std::to_string(row) + ".svg",
           charts::raw_stop_svg(results, row, raw, language)});
    }
    runs.push_back(std::move(results));
  }
  draw_squareness(store, runs, language, plotted);
  for (const std::int64_t table : command.tables)
    MDOF_CHECK(draw_table(store, table, language, plotted));
  return plotted;
}

Status plot(const PlotCommand& command) {
  MDOF_TRY(const PlannedCharts plotted, draw_all(command));
  if (plotted.charts.empty() && plotted.left_out.empty())
    return fail(ErrorCode::usage, "missing run or table; give RUN or --table NUMBER");
  if (plotted.charts.empty())
    return fail(ErrorCode::bad_input, plotted.left_out.front() + "; mdof writes no file");
  MDOF_TRY(const auto files, charts::write_charts(plotted.charts, command.out));
  for (const std::string& text : plotted.left_out) warn(text);
  std::string lines;
  for (const std::string& file : files) lines += file + "\n";
  if (!command.json) return write_out(lines);
  JsonWriter json;
  json.begin_object();
  write_strings(json, "files", files);
  write_strings(json, "left_out", plotted.left_out);
  json.end_object();
  return write_line(json.take());
}

Action declare_plot(CLI::App& command) {
  const auto o = std::make_shared<PlotCommand>();
  auto* runs =
      add_run_arguments(command, o->runs, "Numbers of the runs (see mdof runs), or \"latest\"");
  runs->required(false);
  command
      .add_option("--table", o->tables,
                  "Number of a compensation table (see mdof compensation list)")
      ->type_name("NUMBER")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command
      .add_option("--point", o->points,
                  "Also draw the raw readings of this point. Points are numbered in the order of "
                  "measurement; the first point has number 0")
      ->check(CLI::Range(0, 999'999'999).description(""))
      ->type_name("NUMBER")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command.add_option("--out", o->out, "Folder for the files (created if missing)")
      ->required()
      ->type_name("DIR");
  add_latest_axis_option(command, o->axis);
  add_reference_option(command, o->reference)->capture_default_str();
  add_language_option(command, o->language);
  add_database_option(command, o->database);
  add_json_flag(command, o->json);
  return [o] { return plot(*o); };
}

}  // namespace

Command plot_command() {
  return {
      .name = "plot",
      .summary = "Draw charts of stored runs as SVG files",
      .footer =
          "Files of run N: run-N-five-errors.svg, run-N-straightness.svg,\n"
          "run-N-repeatability.svg, run-N-drift.svg, and run-N-budget-FIGURE.svg for each figure.\n"
          "For an imported run, run-N-ERROR.svg replaces the first four files; it contains the\n"
          "readings and the means of both approaches.\n"
          "Option --point K adds run-N-point-K.svg with the raw readings of point K. If two axes\n"
          "have one run each, mdof adds squareness-A-B.svg (A and B: numbers of the runs).\n"
          "Option --table N adds table-N.svg. For a table over a plane or volume, it adds\n"
          "table-N-XY.svg, table-N-XZ.svg and table-N-YZ.svg: the planes through the middle node\n"
          "of the third axis, with the corrections as arrows.\n"
          "If one file cannot be written, mdof writes no file. Each drawing contains the drawn\n"
          "values as data- attributes, in the units of mdof show --json. The same results give\n"
          "the same bytes.\n"
          "\n"
          "Examples:\n"
          "  mdof plot 12 --out plots\n"
          "  mdof plot 1 2 --table 1 --out plots\n"
          "  mdof plot latest --axis X --out plots --language de",
      .declare = declare_plot};
}

}  // namespace mdof::tools
