// mdof plot RUN...: charts of stored runs as SVG files.
#include <CLI/CLI.hpp>
#include <filesystem>

#include "daemon/output/charts/plot_files.h"
#include "daemon/output/charts/run/run_charts.h"
#include "schema/base/json_writer.h"
#include "schema/base/output/output_files.h"
#include "schema/rig/reference.h"
#include "schema/run_json.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/stored/run_choice.h"
#include "tools/mdof/stored/stated_results.h"

namespace mdof::tools {
namespace {

struct PlotCommand {
  std::string database, axis, out, reference = "fixture", language = "en";
  std::vector<std::string> runs;
  bool json = false;
};

// Folder and names as they are written.
struct Plotted {
  std::vector<charts::NamedChart> charts;
  std::vector<std::string> left_out;

  void take(charts::RunCharts more) {
    for (auto& chart : more.charts) charts.push_back(std::move(chart));
    for (auto& text : more.left_out) left_out.push_back(std::move(text));
  }
};

Result<Plotted> draw_all(const PlotCommand& command) {
  Reference reference{};
  output::Language language{};
  reference_from(command.reference, reference);  // the options take no others
  output::language_from(command.language, language);
  MDOF_TRY(store::Store store, open_to_read(command.database));
  MDOF_TRY(const auto numbers, run_numbers(store, command.runs, command.axis));
  Plotted plotted;
  for (const std::int64_t number : numbers) {
    MDOF_TRY(const auto results, stated_results(store, number, reference));
    plotted.take(charts::charts_of_run(results, language));
  }
  return plotted;
}

Status write_charts(const std::vector<charts::NamedChart>& charts,
                    const std::filesystem::path& folder) {
  MDOF_CHECK(charts::make_plot_folder(folder));
  OutputFiles files(Existing::replace);
  for (const auto& chart : charts) {
    MDOF_TRY(const std::size_t file, files.add(folder / chart.file));
    MDOF_CHECK(files.write(file, chart.svg));
  }
  return files.publish();
}

Status plot(const PlotCommand& command) {
  MDOF_TRY(const Plotted plotted, draw_all(command));
  if (plotted.charts.empty())
    return fail(ErrorCode::bad_input, plotted.left_out.front() + "; no file is written");
  MDOF_CHECK(write_charts(plotted.charts, command.out));
  for (const std::string& text : plotted.left_out) warn(text);
  std::vector<std::string> files;
  std::string lines;
  for (const auto& chart : plotted.charts) {
    files.push_back((std::filesystem::path(command.out) / chart.file).string());
    lines += files.back() + "\n";
  }
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
  add_run_arguments(command, o->runs, "Numbers of runs, see mdof runs; or latest");
  command.add_option("--out", o->out, "Folder of the files, made where it is missing")
      ->required()
      ->type_name("DIR");
  add_axis_of_latest(command, o->axis);
  add_reference_option(command, o->reference)->capture_default_str();
  add_language_option(command, o->language);
  add_database_option(command, o->database);
  add_json_flag(command, o->json);
  return [o] { return plot(*o); };
}

}  // namespace

Command plot_command() {
  return {.name = "plot",
          .summary = "Draw charts of stored runs as SVG files",
          .footer =
              "Writes run-N-five-errors.svg, run-N-straightness.svg and a run-N-budget-FIGURE.svg\n"
              "for each figure. All files are written or none. What is drawn carries its numbers\n"
              "as data- attributes, in the units of mdof show --json. The same results give the\n"
              "same bytes.\n\n"
              "Examples:\n"
              "  mdof plot 12 --out plots\n"
              "  mdof plot latest --axis X --out plots --language de",
          .declare = declare_plot};
}

}  // namespace mdof::tools
