#include "daemon/output/report/measured_days.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "schema/imported/series.h"
#include "schema/rig/report_facts.h"
#include "schema/units.h"

namespace mdof::report {
namespace {

using namespace std::chrono;

int number_at(const std::string& text, std::size_t at, std::size_t digits) {
  int number = 0;
  if (text.size() >= at + digits)
    std::from_chars(text.data() + at, text.data() + at + digits, number);
  return number;
}

sys_days day_at(const std::string& date) {
  return year(number_at(date, 0, 4)) / number_at(date, 5, 2) / number_at(date, 8, 2);
}

std::string text_of(year_month_day day) {
  const auto two = [](unsigned x) { return (x < 10 ? "0" : "") + std::to_string(x); };
  return std::to_string(static_cast<int>(day.year())) + "-" +
         two(static_cast<unsigned>(day.month())) + "-" + two(static_cast<unsigned>(day.day()));
}

// The day on which a run ended. `began`: start of the run ("2026-11-26T10:47:33…").
sys_days last_day(const std::string& began, const std::vector<MeasuredPoint>& points) {
  const double took_s =
      points.empty() ? 0 : ns_to_s(points.back().point.end_ns - points.front().point.begin_ns);
  const double of_day_s = 3600 * number_at(began, 11, 2) + 60 * number_at(began, 14, 2) +
                          number_at(began, 17, 2) + took_s;
  return day_at(began) +
         days(static_cast<int>(std::clamp(std::floor(of_day_s / 86400), 0.0, 36500.0)));
}

}  // namespace

std::optional<Days> recorded_days(const ReportRun& run) {
  const RunHeader& header = run.results.run.header;
  const std::string first = header.started_utc.substr(0, 10);
  if (!header.start_known || !is_date(first)) return std::nullopt;
  return Days{first, text_of(last_day(header.started_utc, run.results.run.points))};
}

Status use_stated_date(Report& report, sys_seconds now) {
  const std::string& date = report.facts.date;
  if (date.empty()) return {};
  const sys_days stated = day_at(date);
  if (stated > floor<days>(now) + days(1))
    return fail(ErrorCode::usage, "date " + date + " (date of the measurement) is in the future",
                Remedy::state_in_report, "date");
  for (ReportRun& run : report.runs) {
    RunHeader& header = run.results.run.header;
    if (is_imported(header)) continue;
    const auto recorded = recorded_days(run);
    if (!recorded) {
      if (is_date(header.started_utc)) header.started_utc = date;  // replaces the date of the rig
      std::erase_if(header.notices, [](const Notice& each) {
        return each.code == NoticeCode::calibration_overdue ||
               each.code == NoticeCode::calibrated_after_measurement ||
               each.code == NoticeCode::record_expired || each.code == NoticeCode::log_has_no_date;
      });
      append(header.notices, overdue_calibrations(run.rig, date));
    } else if (stated < day_at(recorded->first) - days(1) ||
               stated > day_at(recorded->last) + days(1)) {
      return fail(ErrorCode::usage,
                  "date " + date + " (date of the measurement) does not match run " +
                      std::to_string(header.id) + ", which was recorded on " + recorded->first,
                  Remedy::state_in_report, "date");
    }
  }
  return {};
}

}  // namespace mdof::report
