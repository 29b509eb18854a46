// Collects the contents of reports and documents of stored runs.
#include "tools/mdof/report/report_of_runs.h"

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <map>
#include <set>

#include "algo/uncertainty/conformity/decision.h"
#include "daemon/measure/evaluation.h"
#include "daemon/measure/gate/gate.h"
#include "daemon/output/report/measured_days.h"
#include "daemon/version.h"
#include "schema/imported/series.h"
#include "schema/rig/reference.h"
#include "schema/units.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/report/stated_results.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/stored/run_choice.h"
#include "tools/mdof/text/notice_lines.h"

namespace mdof::tools {
namespace {

// Splits "KEY=VALUE" at its first "=".
Result<std::pair<std::string, std::string>> key_and_value(const std::string& text,
                                                          const std::string& option) {
  const std::size_t at = text.find('=');
  if (at == std::string::npos || at == 0)
    return fail(ErrorCode::usage, option + " " + text + ": give KEY=VALUE");
  return std::pair(text.substr(0, at), text.substr(at + 1));
}

// The facts for the report, from the rigs and from --set. A value from --set replaces the facts in
// the rigs, also if the rigs contradict each other.
Result<ReportFacts> facts_of(const std::vector<report::ReportRun>& runs,
                             const std::vector<std::string>& set) {
  ReportFacts given, facts;
  std::vector<std::string> keys;
  for (const std::string& text : set) {
    MDOF_TRY(const auto pair, key_and_value(text, "--set"));
    if (Status known = set_fact(given, pair.first, pair.second); !known)
      return in_context("--set " + text, known.error());
    keys.push_back(pair.first);
  }
  for (const report::ReportRun& run : runs) {
    ReportFacts stated = run.rig.report;
    for (const std::string& key : keys) MDOF_CHECK(set_fact(stated, key, ""));
    MDOF_TRY(facts, joined(facts, stated));
  }
  return joined(given, facts);
}

// The tolerances from --tolerance: figure and value, in the unit of the figure.
Result<std::vector<std::pair<std::string, double>>> parse_tolerances(
    const std::vector<std::string>& texts) {
  std::vector<std::pair<std::string, double>> found;
  for (const std::string& text : texts) {
    MDOF_TRY(auto pair, key_and_value(text, "--tolerance"));
    double value = 0;
    if (!CLI::detail::lexical_cast(pair.second, value) || !std::isfinite(value) || value < 0)
      return fail(ErrorCode::usage, "--tolerance " + text + ": \"" + pair.second +
                                        "\" must be a finite number, 0 or greater");
    found.emplace_back(std::move(pair.first), value);
  }
  return found;
}

Result<report::ReportRun> report_run(store::Store& store, std::int64_t number,
                                     Reference reference) {
  report::ReportRun run;
  MDOF_TRY(run.results, stated_results(store, number, reference));
  run.rig.axis = run.results.run.header.axis;
  if (!is_imported(run.results.run.header)) {
    MDOF_TRY(run.rig, daemon::rig_of(run.results.run.header));
  }
  MDOF_TRY(run.result_sha256, store.result_sha256(number));
  MDOF_TRY(run.superseded_by, store.superseded_by(number));
  run.undecidable_reason = daemon::undecidable_reason(store, run.results.run);
  return run;
}

// Compares the two runs of each axis, the earlier run first.
Result<std::vector<daemon::Comparison>> compare_pairs(store::Store& store,
                                                      const std::vector<report::ReportRun>& runs,
                                                      Reference reference) {
  std::map<Axis, std::vector<std::int64_t>> numbers;
  for (const report::ReportRun& run : runs)
    numbers[run.results.run.header.axis].push_back(run.results.run.header.id);
  std::vector<daemon::Comparison> found;
  for (const auto& [axis, pair] : numbers) {
    if (pair.size() != 2)
      return fail(
          ErrorCode::usage,
          std::string("--before-after: axis ") + letter(axis) + " has " +
              std::to_string(pair.size()) +
              " runs in this report; give two runs of each axis, the run before the change first");
    MDOF_TRY(auto comparison, daemon::compare_runs(store, {pair[0], pair[1], reference}));
    found.push_back(std::move(comparison));
  }
  return found;
}

// Why no decision is possible for the squareness, because of one of its two runs; empty: a decision
// is possible.
std::string undecided_reason(const report::Report& all, const Squareness& of) {
  for (const report::ReportRun& run : all.runs) {
    const std::int64_t id = run.results.run.header.id;
    if ((id == of.run_a || id == of.run_b) && !run.undecidable_reason.empty())
      return run.undecidable_reason;
  }
  return "";
}

// Decides on the squareness with the name `figure`. False: no pair of runs has this figure, or the
// squareness is unknown; `why` is then the reason why it is unknown.
bool decide_squareness(report::Report& all, const std::string& figure, double tolerance,
                       std::string& why) {
  for (const charts::SquarenessOfPair& pair : all.squareness) {
    if (figure != std::string(squareness_name(pair.axes)) + "_urad") continue;
    if (!pair.results) {
      why = pair.reason;
      return false;
    }
    all.decided.push_back(
        {figure, algo::decision(pair.results->budget, from_um(tolerance),
                                undecided_reason(all, pair.results->squareness))});
    return true;
  }
  return false;
}

// "EYX_slope_urad, EYX_straightness_um, ...": the figures of the report that have an uncertainty.
std::string figure_names(const report::Report& all) {
  std::set<std::string> names;
  for (const report::ReportRun& run : all.runs)
    for (const Budget& budget : run.results.figures.budgets) names.insert(budget.figure);
  for (const charts::SquarenessOfPair& pair : all.squareness)
    if (pair.results) names.insert(std::string(squareness_name(pair.axes)) + "_urad");
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

// Decides on all tolerances. Error: a tolerance is for no figure of a run and for no squareness.
Status decide(report::Report& all, const std::vector<std::pair<std::string, double>>& tolerances) {
  for (const auto& [figure, tolerance] : tolerances) {
    const std::string names = figure_names(all);
    std::string why = "no run of the report has this figure with an uncertainty" +
                      (names.empty() ? "" : "; give one of: " + names);
    bool found = decide_squareness(all, figure, tolerance, why);
    for (report::ReportRun& run : all.runs)
      if (const Budget* budget = find_budget(run.results.figures.budgets, figure)) {
        run.decided.push_back(
            {figure, algo::decision(*budget, from_um(tolerance), run.undecidable_reason)});
        found = true;
      }
    if (!found) return fail(ErrorCode::usage, "--tolerance " + figure + ": " + why);
  }
  return {};
}

}  // namespace

void add_report_options(CLI::App& command, ReportRequest& request) {
  std::string keys;
  for (const ReportKey& key : report_keys())
    keys += (keys.empty() ? "" : ", ") + std::string(key.name);
  command
      .add_option(
          "--set", request.set,
          "Entry of the report; replaces the entry in [report] of the rig. KEY is one of: " + keys)
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command
      .add_option("--tolerance", request.tolerances,
                  "Tolerance (largest permitted value) of a figure, in the unit of the figure (ISO "
                  "14253-1:2017), such as EYX_straightness_um=0.5 or EC0Y_urad=20")
      ->type_name("NAME=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  add_latest_axis_option(command, request.axis);
  add_reference_option(command, request.reference)->capture_default_str();
  add_database_option(command, request.database);
}

Result<report::Report> report_of_runs(const ReportRequest& request) {
  report::Report all;
  Reference reference{};
  reference_from(request.reference, reference);  // the option accepts only valid names
  MDOF_TRY(const auto tolerances, parse_tolerances(request.tolerances));
  all.software_version = daemon::kVersion;
  MDOF_TRY(store::Store store, open_to_read(request.database));
  MDOF_TRY(const auto numbers, run_numbers(store, request.runs, request.axis));
  for (const std::int64_t number : numbers) {
    MDOF_TRY(auto run, report_run(store, number, reference));
    all.runs.push_back(std::move(run));
  }
  MDOF_TRY(all.facts, facts_of(all.runs, request.set));
  MDOF_CHECK(report::use_stated_date(
      all, std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now())));
  std::vector<const charts::StatedResults*> results;
  for (const report::ReportRun& run : all.runs) results.push_back(&run.results);
  all.squareness = squareness_of_runs(store, results);
  MDOF_CHECK(decide(all, tolerances));
  if (request.before_after) {
    MDOF_TRY(all.comparisons, compare_pairs(store, all.runs, reference));
  }
  return all;
}

void print_report_marks(const report::Report& report) {
  for (const report::ReportRun& run : report.runs)
    for (const std::string& mark : daemon::warning_marks(run.results.run)) warn(mark);
  for (const daemon::Comparison& comparison : report.comparisons)
    show_notices(comparison.notices, true);
}

}  // namespace mdof::tools
