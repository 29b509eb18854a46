// mdof trend: shows figures of the stored runs against time, with control limits.
#include <CLI/CLI.hpp>
#include <limits>
#include <optional>
#include <tuple>

#include "daemon/measure/several_runs/trends_json.h"
#include "daemon/output/charts/plot_files.h"
#include "daemon/output/charts/run/control_chart.h"
#include "daemon/words/words.h"
#include "schema/base/append_new.h"
#include "schema/notice/notice_json.h"
#include "schema/sample.h"
#include "schema/uncertainty/run_uncertainty.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/csv/csv_text.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/notice_lines.h"
#include "tools/mdof/text/run_tables.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

// With fewer values than this, the control limits are provisional.
constexpr std::size_t kFirmBaseline = 8;

struct TrendCommand {
  std::string database, axis, figure, plots;
  std::size_t baseline = 0;
  bool mixed = false, all = false, csv = false, json = false;
  std::vector<std::int64_t> without;
};

std::string runs_of(const daemon::TrendValue& value) {
  std::string text;
  for (const std::int64_t run : value.runs) text += (text.empty() ? "" : " ") + std::to_string(run);
  return text;
}

// The unit of the figure: "µm" for "EYX_straightness_um".
std::string unit_of(const daemon::Trend& trend) {
  return trend.figure.ends_with("_um") ? "µm" : "µrad";
}

std::string shown(const daemon::Trend& trend, double si) {
  return fixed(to_key_unit(si), trend.figure.ends_with("_um") ? 4 : 3);
}

std::string with_u(const daemon::Trend& trend, double si, double u) {
  return trend.figure.ends_with("_um") ? um_with_u(si, u) : urad_with_u(si, u);
}

std::string sentence_of(const daemon::Trend& trend) {
  const auto& [figure, values, chart] = std::tie(trend.figure, trend.values, trend.chart);
  if (!chart)
    return figure + ": " + std::to_string(values.size()) +
           (values.size() == 1 ? " value is" : " values are") +
           " too few for control limits (needed: a baseline of " +
           (trend.baseline > 0 ? std::to_string(trend.baseline) + " values)"
                               : "at least " + std::to_string(algo::kLeastBaselineValues) +
                                     " values, and at least one value after it)");
  const std::string provisional =
      chart->baseline < kFirmBaseline
          ? "; the limits are provisional, because their baseline has only " +
                std::to_string(chart->baseline) + " values"
          : "";
  if (chart->moved) {
    const auto& since = values[chart->moved->since];
    return figure + " has moved by " + with_u(trend, chart->moved->by, chart->moved->u) + " " +
           unit_of(trend) + " since run " + runs_of(since) + " (" + since.started_utc +
           "): the value of run " + runs_of(values.back()) +
           (daemon::trend_signal(*chart, values.size() - 1) == "outside"
                ? " is outside the control limits (Shewhart, 3 sigma)"
                : " is at least the eighth value in a row on one side of the centre (Western "
                  "Electric)") +
           provisional;
  }
  if (!chart->outside.empty())
    return figure + ": the value of run " + runs_of(values[chart->outside.back()]) +
           " is outside the control limits; the values of later runs are inside" + provisional;
  return figure + " has not moved" + provisional;
}

std::string text_of(const daemon::Trend& trend) {
  TextTable table(
      {"runs", "started", "value/" + unit_of(trend), "lower limit", "upper limit", "signal"});
  for (std::size_t i = 0; i < trend.values.size(); ++i) {
    const auto& v = trend.values[i];
    const bool has = trend.chart.has_value();
    table.add({runs_of(v), v.started_utc, with_u(trend, v.stated.value, v.stated.u),
               has ? shown(trend, trend.chart->low[i]) : "-",
               has ? shown(trend, trend.chart->high[i]) : "-",
               has ? daemon::trend_signal(*trend.chart, i) : ""});
  }
  std::string out = trend.figure + "\n";
  if (trend.chart)
    out += "centre " + shown(trend, trend.chart->centre) + ", sigma " +
           shown(trend, trend.chart->sigma) + " " + unit_of(trend) +
           " (moving range), both from the first " + std::to_string(trend.chart->baseline) +
           " values\n";
  out += table.text(terminal_columns());
  if (!trend.values.empty())
    out += wrapped("± is the standard uncertainty u (" + covers_text(trend.u_covers) +
                       "). The control limits contain noise and repeatability only.",
                   terminal_columns()) +
           "\n";
  for (const std::string& why : trend.left_out)
    out += wrapped("left out: " + why, terminal_columns()) + "\n";
  return out + wrapped(sentence_of(trend), terminal_columns()) + "\n";
}

// Whether u contains noise only: in all figures that have values, in some of them, or in none.
NoiseOnly noise_only_of(const std::vector<daemon::Trend>& trends) {
  std::optional<NoiseOnly> all;
  for (const daemon::Trend& trend : trends)
    if (!trend.values.empty()) all = joined(all.value_or(trend.noise_only), trend.noise_only);
  return all.value_or(NoiseOnly::none);
}

// One row for each figure: its last value, and whether it is within the control limits.
std::string brief_text(const std::vector<daemon::Trend>& trends) {
  TextTable table(
      {"figure", "unit", "values", "last value", "lower limit", "upper limit", "state"});
  std::size_t left_out = 0;
  std::string sentences;
  for (const daemon::Trend& trend : trends) {
    left_out += trend.left_out.size();
    const bool has = trend.chart.has_value() && !trend.values.empty();
    const bool moved = has && trend.chart->moved.has_value();
    const std::string name = trend.figure.substr(0, trend.figure.rfind('_'));
    table.add({name, unit_of(trend), std::to_string(trend.values.size()),
               trend.values.empty()
                   ? "-"
                   : with_u(trend, trend.values.back().stated.value, trend.values.back().stated.u),
               has ? shown(trend, trend.chart->low.back()) : "-",
               has ? shown(trend, trend.chart->high.back()) : "-",
               !has    ? "too few values"
               : moved ? "MOVED"
                       : "not moved"});
    if (moved || (has && !trend.chart->outside.empty()))
      sentences += wrapped(sentence_of(trend), terminal_columns()) + "\n";
  }
  return table.text(terminal_columns()) + "± is the standard uncertainty u.\n" + sentences +
         (left_out > 0 ? "values left out: " + std::to_string(left_out) + "\n" : "") +
         "--all shows the values of all runs, the contributions to u, and the runs that were left "
         "out.\n";
}

std::string text_of(const std::vector<daemon::Trend>& trends, bool all) {
  if (trends.empty()) return "no stored run gives a value for a control chart\n";
  std::string out;
  if (all || trends.size() == 1)
    for (const daemon::Trend& trend : trends) out += (out.empty() ? "" : "\n") + text_of(trend);
  else
    out = brief_text(trends);
  return noise_only_notice(noise_only_of(trends)) + out;
}

std::string csv_of(const std::vector<daemon::Trend>& trends) {
  CsvText csv;
  csv.cells({"figure", "runs", "started_utc", "value", "u", "u_random", "k", "U", "centre", "low",
             "high", "signal", "u_covers", "not_declared"});
  csv.end_row();
  for (const daemon::Trend& trend : trends)
    for (std::size_t i = 0; i < trend.values.size(); ++i) {
      const auto& v = trend.values[i];
      const auto& chart = trend.chart;
      csv.cells({trend.figure, runs_of(v), v.started_utc});
      for (const double x : {v.stated.value, v.stated.u, v.stated.u_random})
        csv.cell(to_key_unit(x));
      csv.cell(v.stated.coverage_factor).cell(to_key_unit(v.stated.U));
      csv.cell(chart ? to_key_unit(chart->centre) : kNaN);
      csv.cell(chart ? to_key_unit(chart->low[i]) : kNaN);
      csv.cell(chart ? to_key_unit(chart->high[i]) : kNaN);
      csv.cells({chart ? daemon::trend_signal(*chart, i) : "", covers_text(trend.u_covers),
                 joined(trend.u_not_declared, " ")});
      csv.end_row();
    }
  return noise_only_comment(noise_only_of(trends)) + csv.take();
}

Status trend(const TrendCommand& command) {
  MDOF_TRY(store::Store store, open_to_read(command.database));
  MDOF_TRY(const auto found,
           daemon::trends(store, {axis_from(command.axis), command.figure, command.baseline,
                                  command.mixed, command.without}));
  Notices notices;  // those of several figures only once
  for (const daemon::Trend& of : found) append_new(notices, of.notices);
  show_notices(notices, true);
  if (command.csv)
    for (const daemon::Trend& of : found)
      for (const std::string& why : of.left_out) warn(of.figure + ": left out: " + why);
  std::vector<charts::NamedChart> drawn;
  for (const daemon::Trend& of : found)
    if (!of.values.empty())
      drawn.push_back({"trend-" + charts::file_name(of.figure) + ".svg",
                       charts::control_chart_svg(of, words::Language::english)});
  MDOF_CHECK(write_plots(drawn, command.plots));
  MDOF_CHECK(command.csv    ? write_out(csv_of(found))
             : command.json ? write_line(daemon::trends_json(found))
                            : write_out(text_of(found, command.all)));
  std::string moved;
  for (const daemon::Trend& of : found)
    if (of.chart && of.chart->moved) moved += (moved.empty() ? "" : "; ") + sentence_of(of);
  return moved.empty() ? Status() : fail(ErrorCode::check, moved);
}

Action declare_trend(CLI::App& command) {
  const auto o = std::make_shared<TrendCommand>();
  add_only_axis_option(command, o->axis);
  command
      .add_option("--figure", o->figure,
                  "Show only this figure, such as EYX_straightness_um or EC0Y_urad")
      ->type_name("NAME");
  command
      .add_option(
          "--baseline", o->baseline,
          "Calculate the limits from the first N values [default: all values except the last]")
      ->check(CLI::Range(algo::kLeastBaselineValues, std::size_t{100'000}));
  command.add_flag("--all", o->all, "Show the values of all runs, not only the last value");
  command.add_flag("--mixed", o->mixed,
                   "Combine runs even if they differ in rig, model or evaluation options");
  command
      .add_option("--without", o->without,
                  "Leave out these runs, for example a run with a known fault of the set-up")
      ->type_name("RUN")
      ->delimiter(',')
      ->check(CLI::Range(std::int64_t{1}, std::numeric_limits<std::int64_t>::max()));
  add_database_option(command, o->database);
  add_plot_option(command, o->plots);
  add_csv_and_json_flags(command, o->csv, o->json);
  return [o] { return trend(*o); };
}

}  // namespace

Command trend_command() {
  return {
      .name = "trend",
      .summary = "Draw control charts of squareness and other figures over the stored runs",
      .footer =
          "The squareness values are the results that \"mdof squareness\" has stored.\n"
          "Exit code 1: a figure has moved. This means that its last value is outside the\n"
          "control limits, or is at least the eighth value in a row on one side of the centre.\n"
          "Examples:\n"
          "  mdof trend --figure EC0Y_urad\n"
          "  mdof trend --axis X --without 7\n"
          "  mdof trend --axis X --csv > trend_X.csv",
      .declare = declare_trend};
}

}  // namespace mdof::tools
