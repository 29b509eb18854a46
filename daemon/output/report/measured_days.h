// The days on which runs were measured.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "daemon/output/report/report.h"

namespace mdof::report {

struct Days {
  std::string first, last;  // UTC, YYYY-MM-DD
};

// The days on which a run was recorded. nullopt if they are unknown (a CSV log has no date).
std::optional<Days> recorded_days(const ReportRun& run);

// Uses the stated date of the report for runs without a date: calibrations must have been valid on
// that day, not on the day of the evaluation. `now` is a UTC time. Errors: usage, if the date is in
// the future, or more than a day outside the recorded days of a run (local dates differ from UTC by
// up to a day).
Status use_stated_date(Report& report, std::chrono::sys_seconds now);

}  // namespace mdof::report
