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

// Applies the date that the user stated for the report to runs without a date: notices on expired
// calibrations then refer to this date, not to the date of the evaluation. `now` is a UTC time.
// Errors (usage): the date is in the future, or it differs by more than a day from the recorded
// days of a run. One day is allowed because local dates differ from UTC by up to a day.
Status use_stated_date(Report& report, std::chrono::sys_seconds now);

}  // namespace mdof::report
