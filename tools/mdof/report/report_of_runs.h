// What reports and documents of stored runs are made from, as their commands ask for it.
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

// Results and rigs of the runs, what changed between two of an axis, their squareness, what is
// decided of them, and the facts of [report] of their rigs, of which --set replaces each. Errors:
// those of runs and rigs; usage: a key or figure that is not there, not two runs of each axis for
// before and after.
Result<report::Report> report_of_runs(const ReportRequest& request);

// SIMULATED, DOUBTFUL of each run, on the standard error.
void warn_of(const report::Report& report);

}  // namespace mdof::tools
