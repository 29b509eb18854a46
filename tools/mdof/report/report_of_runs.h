// Collects the contents of reports, DCC and QIF documents on stored runs.
#pragma once

#include <string>
#include <vector>

#include "daemon/output/report/report.h"
#include "daemon/store/store.h"
#include "schema/base/result.h"

namespace CLI {
class App;
}  // namespace CLI

namespace mdof::tools {

struct ReportRequest {
  std::string database, axis, reference = "fixture";
  std::vector<std::string> runs, set, tolerances;
  bool before_after = false;
};

// Adds --set, --tolerance, --axis, --reference and --db.
void add_report_options(CLI::App& command, ReportRequest& request);

// The report contains:
// - results and rig of each run
// - the changes between two runs of an axis
// - the squareness of axes
// - the decisions on tolerances
// - the facts in [report] of the rigs; a fact from --set replaces the fact of the rigs
// Errors: a run or a rig cannot be read. Errors (usage): a key or figure is unknown; before_after
// is true, but an axis does not have exactly two runs.
Result<report::Report> report_of_runs(const ReportRequest& request);

// Prints the warnings of each run (SIMULATED, DOUBTFUL) and the notices of the comparisons to the
// standard error.
void print_report_marks(const report::Report& report);

}  // namespace mdof::tools
