// A report of stored runs for a customer: one self-contained HTML file without scripts, for
// printing on A4. Pure: equal results make equal bytes, because the file does not contain the time
// when it was made.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "daemon/measure/several_runs/comparison.h"
#include "daemon/output/charts/run/run_charts.h"
#include "daemon/output/phrases.h"
#include "schema/rig/rig.h"
#include "schema/uncertainty/budget.h"
#include "schema/uncertainty/conformity.h"

namespace mdof::report {

using output::Language;

struct Decided {
  std::string figure;
  Decision decision;
};

struct ReportRun {
  charts::StatedResults results;
  Rig rig;
  std::vector<Decided> decided;  // decisions on the figures that have a tolerance
  std::string result_sha256;
  std::optional<std::int64_t> superseded_by;
  // Why conformity cannot be decided for this run; empty: it can be decided.
  std::string undecidable_reason;
};

// A file inside the report that a reader can save.
struct Attachment {
  std::string file_name, media_type, bytes;
};

struct Report {
  ReportFacts facts;
  std::string head;  // HTML of the company at the top of the report; empty: none
  std::vector<ReportRun> runs;
  // One for each axis: the runs before and after a change.
  std::vector<daemon::Comparison> comparisons;
  // One for each pair of axes (XY, XZ, YZ), if the report has a measured run of each of the two.
  std::vector<charts::SquarenessOfPair> squareness;
  std::vector<Decided> decided;  // decisions on squareness that has a tolerance
  std::vector<Attachment> attachments;
  std::string software_version;  // version of mdof that made the report
  Language language = Language::english;
};

std::string report_html(const Report& report);

}  // namespace mdof::report
