// Collects the contents of reports and documents of stored runs.
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

// --set, --tolerance, --axis, --reference, --db.
void add_report_options(CLI::App& command, ReportRequest& request);

// Contains results and rigs of the runs, the changes between two runs of an axis, the squareness of
// axes, the decisions on tolerances, and the facts of [report] in the rigs. --set replaces single
// facts. Errors: a run or rig cannot be read; usage: an unknown key or figure, or not exactly two
// runs of each axis for before_after.
Result<report::Report> report_of_runs(const ReportRequest& request);

// Prints the marks of each run (SIMULATED, DOUBTFUL) and the notices of comparisons to the standard
// error.
void print_report_marks(const report::Report& report);

}  // namespace mdof::tools
