#include "tools/mdof/commands/calibration/record_file.h"

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>

#include "algo/model/clearance.h"
#include "daemon/paths.h"
#include "daemon/version.h"
#include "schema/base/output/output_files.h"
#include "schema/units.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

constexpr int kMostDays = 36'500;

Result<std::chrono::sys_days> day_of(const std::string& date) {
  int year = 0;
  unsigned month = 0, day = 0;
  const bool read = date.size() == 10 &&
                    std::sscanf(date.c_str(), "%4d-%2u-%2u", &year, &month, &day) == 3;  // NOLINT
  const auto ymd = std::chrono::year{year} / std::chrono::month{month} / std::chrono::day{day};
  if (!read || !ymd.ok())
    return fail(ErrorCode::usage, "\"" + date +
                                      "\" is not a date; give the date of the calibration with "
                                      "--date YYYY-MM-DD");
  return std::chrono::sys_days(ymd);
}

// One day is added, because the local date can be later than the date in UTC.
Status check_not_in_future(std::chrono::sys_days day, const std::string& date) {
  const auto today = std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now());
  if (day <= today + std::chrono::days(1)) return {};
  return fail(ErrorCode::usage,
              "--date " + date + " is in the future; give the date of the calibration");
}

std::string text_of(std::chrono::sys_days day) {
  const std::chrono::year_month_day ymd(day);
  char text[16];
  std::snprintf(text, sizeof text, "%04d-%02u-%02u", static_cast<int>(ymd.year()),
                static_cast<unsigned>(ymd.month()), static_cast<unsigned>(ymd.day()));
  return text;
}

// Error: the rig uses a mounting record. The u of such a record is small, so a new mounting
// calibration would change almost nothing. New sensitivities do not fit a mounting that was
// calibrated with the earlier sensitivities.
Status check_no_mounting(const std::string& kind, const Rig& rig) {
  for (const CalibrationRecord& record : rig.records)
    if (record.kind == "mounting")
      return bad_input(rig.source + ": the rig already uses the mounting calibration \"" +
                       record.id +
                       "\"; remove this record from the key \"calibration\" of the rig file, "
                       "calibrate, and then add the new record to this key" +
                       (kind == "mounting" ? "" : " and repeat mdof calibrate mounting"));
  return {};
}

}  // namespace

void add_record_file_options(CLI::App& command, RecordOptions& options) {
  command.add_option("--out", options.out, "Write the calibration record for the rig to this file")
      ->type_name("FILE.toml");
  command
      .add_option("--valid-days", options.valid_days,
                  "Number of days for which the calibration is valid")
      ->check(CLI::Range(1, kMostDays))
      ->capture_default_str();
}

void add_record_options(CLI::App& command, RecordOptions& options) {
  add_record_file_options(command, options);
  command
      .add_option("--date", options.date,
                  "Date of the calibration [default: date of the log, else today]")
      ->type_name("YYYY-MM-DD");
}

std::string probe_ids(const Rig& rig) {
  std::vector<std::string> ids;
  for (const Probe& probe : rig.probes) ids.push_back(probe.id);
  return joined(ids);
}

Result<CalibrationRecord> begin_record(const std::string& kind, const Rig& rig,
                                       const RecordOptions& options,
                                       const std::string& started_utc) {
  MDOF_CHECK(check_no_mounting(kind, rig));
  CalibrationRecord record;
  record.kind = kind;
  record.rig = rig.name;
  record.axis = letter(rig.axis);
  const std::string now = started_utc.empty() ? daemon::utc_now() : started_utc;
  record.date = options.date.empty() ? now.substr(0, 10) : options.date;
  MDOF_TRY(const auto day, day_of(record.date));
  if (!options.date.empty()) MDOF_CHECK(check_not_in_future(day, record.date));
  record.valid_until = text_of(day + std::chrono::days(options.valid_days));
  record.software = daemon::kVersion;
  return record;
}

Status write_record(const std::string& file, const std::string& text) {
  std::error_code ec;
  if (std::filesystem::exists(std::filesystem::symlink_status(file, ec)))
    return fail(ErrorCode::usage, file +
                                      ": the file exists already, and a record is never "
                                      "overwritten; give another name with --out");
  return write_file(file, text, Existing::refuse);
}

std::string clearance_warning(const Rig& rig, Axis axis) {
  const auto motions = algo::motion_clearances(rig);
  if (!motions) return "";
  return algo::clearance_text((*motions)[static_cast<std::size_t>(axis)]) + ". ";
}

double new_offset_um(const Probe& probe, double zero_m) {
  const double zero_um = to_um(zero_m);
  return probe.calibration.offset_um + (probe.calibration.reads_gap ? -zero_um : zero_um);
}

}  // namespace mdof::tools
