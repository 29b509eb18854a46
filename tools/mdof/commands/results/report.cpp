// mdof report RUN...: a report of stored runs as one HTML file.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include "algo/uncertainty/conformity/decision.h"
#include "daemon/measure/evaluation.h"
#include "daemon/output/report/report.h"
#include "daemon/version.h"
#include "schema/base/output/output_files.h"
#include "schema/rig/reference.h"
#include "schema/units.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/stored/run_choice.h"
#include "tools/mdof/stored/stated_results.h"

namespace mdof::tools {
namespace {

struct ReportCommand {
  std::string database, axis, out, reference = "fixture", language = "en";
  std::vector<std::string> runs, set, tolerances;
  bool json = false;
};

// "KEY=VALUE" at its first "=".
Result<std::pair<std::string, std::string>> key_and_value(const std::string& text,
                                                          const std::string& option) {
  const std::size_t at = text.find('=');
  if (at == std::string::npos || at == 0)
    return fail(ErrorCode::usage, option + " " + text + ": give KEY=VALUE");
  return std::pair(text.substr(0, at), text.substr(at + 1));
}

Result<report::Title> title_of(const std::vector<std::string>& set) {
  report::Title title;
  const std::pair<const char*, std::string*> keys[] = {{"customer", &title.customer},
                                                       {"machine", &title.machine},
                                                       {"serial", &title.serial},
                                                       {"operator", &title.operator_name}};
  for (const std::string& text : set) {
    MDOF_TRY(const auto pair, key_and_value(text, "--set"));
    const auto found = std::find_if(std::begin(keys), std::end(keys),
                                    [&](const auto& key) { return pair.first == key.first; });
    if (found == std::end(keys))
      return fail(ErrorCode::usage, "--set " + text + ": the key \"" + pair.first +
                                        "\" is not known; give customer, machine, serial or "
                                        "operator");
    *found->second = pair.second;
  }
  return title;
}

// Tolerances by figure, in its unit.
Result<std::vector<std::pair<std::string, double>>> tolerances_of(
    const std::vector<std::string>& texts) {
  std::vector<std::pair<std::string, double>> found;
  for (const std::string& text : texts) {
    MDOF_TRY(auto pair, key_and_value(text, "--tolerance"));
    double value = 0;
    if (!CLI::detail::lexical_cast(pair.second, value) || !std::isfinite(value) || value < 0)
      return fail(ErrorCode::usage, "--tolerance " + text + ": \"" + pair.second +
                                        "\" is no finite number that is not negative");
    found.emplace_back(std::move(pair.first), value);
  }
  return found;
}

Result<report::ReportRun> report_run(store::Store& store, std::int64_t number,
                                     Reference reference) {
  report::ReportRun run;
  MDOF_TRY(run.results, stated_results(store, number, reference));
  MDOF_TRY(run.rig, daemon::rig_of(run.results.run.header));
  MDOF_TRY(run.result_sha256, store.result_sha256(number));
  MDOF_TRY(run.superseded_by, store.superseded_by(number));
  return run;
}

// Each tolerance has to be that of a figure of some run: one that decides nothing is a mistake.
Status decide(report::Report& all, const std::vector<std::pair<std::string, double>>& tolerances) {
  for (const auto& [figure, tolerance] : tolerances) {
    bool found = false;
    for (report::ReportRun& run : all.runs)
      if (const Budget* budget = find_budget(run.results.figures.budgets, figure)) {
        run.decided.push_back({figure, algo::decision(*budget, from_um(tolerance))});
        found = true;
      }
    if (!found)
      return fail(ErrorCode::usage, "--tolerance " + figure +
                                        ": no run of the report has this figure with its "
                                        "uncertainty; mdof budget RUN lists the figures");
  }
  return {};
}

Status write_report(const ReportCommand& command) {
  report::Report all;
  Reference reference{};
  reference_from(command.reference, reference);  // the options take no others
  output::language_from(command.language, all.language);
  MDOF_TRY(all.title, title_of(command.set));
  MDOF_TRY(const auto tolerances, tolerances_of(command.tolerances));
  all.software_version = daemon::kVersion;
  MDOF_TRY(store::Store store, open_to_read(command.database));
  MDOF_TRY(const auto numbers, run_numbers(store, command.runs, command.axis));
  for (const std::int64_t number : numbers) {
    MDOF_TRY(auto run, report_run(store, number, reference));
    all.runs.push_back(std::move(run));
  }
  MDOF_CHECK(decide(all, tolerances));
  std::vector<const charts::StatedResults*> results;
  for (const report::ReportRun& run : all.runs) results.push_back(&run.results);
  auto squareness = squareness_of_runs(store, results);
  if (squareness)
    all.squareness = std::move(*squareness);
  else
    all.why_no_squareness = squareness.error().message;
  MDOF_CHECK(write_file(command.out, report::report_html(all), Existing::replace));
  for (const report::ReportRun& run : all.runs)
    for (const std::string& mark : run.results.marks) warn(mark);
  return command.json ? write_line("{\"file\":" + JsonWriter().value(command.out).take() + "}")
                      : write_line(command.out);
}

Action declare_report(CLI::App& command) {
  const auto o = std::make_shared<ReportCommand>();
  add_run_arguments(command, o->runs, "Numbers of runs, see mdof runs; or latest");
  command.add_option("--out", o->out, "The report; a file of this name is replaced")
      ->required()
      ->type_name("FILE.html");
  command.add_option("--set", o->set, "customer=, machine=, serial=, operator= of the title")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command
      .add_option("--tolerance", o->tolerances,
                  "Most that a figure may be, in its unit, such as EYX_straightness_um=0.5: "
                  "decided by ISO 14253-1:2017")
      ->type_name("NAME=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  add_axis_of_latest(command, o->axis);
  add_reference_option(command, o->reference)->capture_default_str();
  add_language_option(command, o->language);
  add_database_option(command, o->database);
  add_json_flag(command, o->json);
  return [o] { return write_report(*o); };
}

}  // namespace

Command report_command() {
  return {.name = "report",
          .summary = "Write a report of stored runs as one HTML file that prints to A4",
          .footer =
              "The file needs nothing else and has no script. Title, results with u, U and k,\n"
              "decisions, conditions, fixture, calibrations, notices, charts, points, and how to\n"
              "replay the recording. The same results give the same bytes.\n\n"
              "Examples:\n"
              "  mdof report 12 --out report.html --set customer=\"Muster AG\" --set serial=17\n"
              "  mdof report 1 2 --out bericht.html --language de\n"
              "  mdof report 12 --out report.html --tolerance EYX_straightness_um=0.5",
          .declare = declare_report};
}

}  // namespace mdof::tools
