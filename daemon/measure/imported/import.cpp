#include "daemon/measure/imported/import.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "algo/compensation/imported_table.h"
#include "daemon/measure/gate/gate.h"
#include "daemon/paths.h"
#include "daemon/version.h"
#include "daemon/words/words.h"
#include "drivers/imported/imported_file.h"
#include "schema/base/json_writer.h"
#include "schema/base/number/number_text.h"
#include "schema/iso230/targets.h"
#include "schema/notice/notice_json.h"
#include "schema/sample.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

std::string options_json(const ImportRequest& request, const ImportedError& error,
                         const ImportedSeries& series) {
  JsonWriter json;
  json.begin_object().key("imported").begin_object();
  json.field("error", error.name).field("format", series.format);
  json.field("readings", static_cast<std::uint64_t>(series.readings.size()));
  json.key(error.angle ? "u_urad" : "u_um");
  const std::optional<double>& u = error.angle ? request.u_urad : request.u_um;
  u ? json.value(*u) : json.null();
  if (!error.named) {
    json.field("sense", to_string(request.sense.value_or(PositioningSense::command)));
    json.key("travel");
    request.against_command ? json.value(*request.against_command ? "-" : "+") : json.null();
  }
  const auto limit = [&](const char* key, double asked, double otherwise, double to_unit) {
    if (asked != otherwise) json.field(key, asked * to_unit);
  };
  const algo::TableLimits plain;
  limit("limit_um", error.angle ? request.limits.angle_rad : request.limits.length_m,
        error.angle ? plain.angle_rad : plain.length_m, 1e6);
  limit("limit_um_per_mm",
        error.angle ? request.limits.angle_slope_rad_per_m : request.limits.length_slope,
        error.angle ? plain.angle_slope_rad_per_m : plain.length_slope, 1e3);
  json.key("about").begin_array();
  for (const std::string& line : series.about) json.value(line);
  json.end_array().end_object().end_object();
  return json.take();
}

MeasuredPoint point_of(const ImportedReading& r, const std::vector<double>& targets,
                       const std::optional<double>& u_si, const ImportedError& error) {
  MeasuredPoint p;
  const std::size_t target = target_at(targets, r.position_m);
  p.target = static_cast<int>(target) + 1;
  p.target_m = targets[target];
  p.run = r.run;
  p.point.position_m = r.position_m;
  p.point.direction = r.direction;
  p.point.samples = 1;
  p.point.probe_m = {r.deviation};
  if (u_si) p.point.probe_u_m = {*u_si};
  p.errors.reason = "imported: " + error.name + " alone";
  return p;
}

// Deviations that are all smaller than this are probably values in mm that were read as µm.
constexpr double kSmallest_m = 0.1e-6;

Notices import_notices(const ImportedSeries& series, const ImportedError& error) {
  std::vector<double> position_m, deviation_m;
  for (const ImportedReading& r : series.readings) {
    position_m.push_back(r.position_m);
    deviation_m.push_back(r.deviation);
  }
  return error.angle ? Notices() : deviation_unit_notices(std::move(position_m), deviation_m);
}

// Checks each reading, and the slopes between the means of targets, with the limits for tables.
Status check_readings(const ImportedSeries& series, const ImportRequest& request,
                      const ImportedError& error, const std::vector<double>& targets) {
  for (const ImportedReading& r : series.readings)
    MDOF_CHECK(algo::check_limits(series.source + ": " + error.name, error.angle, {r.position_m},
                                  {r.deviation}, request.limits));
  for (const int direction : {1, 0, -1}) {
    std::vector<double> sum(targets.size(), 0.0), n(targets.size(), 0.0), mean;
    for (const ImportedReading& r : series.readings) {
      if (r.direction != direction) continue;
      const std::size_t at = target_at(targets, r.position_m);
      sum[at] += r.deviation;
      n[at] += 1;
    }
    for (std::size_t i = 0; i < targets.size(); ++i)
      mean.push_back(n[i] > 0 ? sum[i] / n[i] : kNaN);
    MDOF_CHECK(algo::check_limits(series.source + ": " + error.name, error.angle, targets, mean,
                                  request.limits));
  }
  return {};
}

// Standard uncertainty of each deviation, in m or rad.
Result<std::optional<double>> standard_uncertainty(const ImportRequest& request,
                                                   const ImportedError& error) {
  if (error.angle ? request.u_um : request.u_urad)
    return fail(ErrorCode::usage,
                error.name + (error.angle ? " is an angle: give u_urad, not u_um"
                                          : " is a length: give u_um, not u_urad"));
  const std::optional<double>& u = error.angle ? request.u_urad : request.u_um;
  if (!u) return std::nullopt;
  if (!(*u >= 0 && std::isfinite(*u)))
    return fail(ErrorCode::usage, "the standard uncertainty must be a finite number, 0 or more");
  return error.angle ? from_urad(*u) : from_um(*u);
}

}  // namespace

Notices deviation_unit_notices(std::vector<double> position_m,
                               const std::vector<double>& deviation_m) {
  if (deviation_m.empty()) return {};
  double largest = 0, step = std::numeric_limits<double>::infinity();
  for (const double deviation : deviation_m) largest = std::max(largest, std::abs(deviation));
  const std::vector<double> targets = distinct_targets(std::move(position_m));
  for (std::size_t i = 1; i < targets.size(); ++i)
    step = std::min(step, targets[i] - targets[i - 1]);
  if (largest < kSmallest_m)
    return {notice(NoticeCode::deviation_too_small, "", {{"deviation_um", to_um(largest)}})};
  if (largest < step) return {};
  return {notice(NoticeCode::deviation_too_large, "",
                 {{"deviation_um", to_um(largest)}, {"interval_mm", to_mm(step)}})};
}

Result<Run> imported_run(const ImportRequest& request) {
  const std::string name = request.error.empty() ? positioning_name(request.axis) : request.error;
  MDOF_TRY(const ImportedError error, imported_error(request.axis, name));
  MDOF_TRY(const std::optional<double> u_si, standard_uncertainty(request, error));
  if (error.named && (request.sense || request.against_command))
    return fail(ErrorCode::usage, "\"sense\" and \"travel\" apply only to positioning (" +
                                      positioning_name(request.axis) + "); leave both out for " +
                                      error.name);
  MDOF_TRY(const ImportedSeries series,
           drivers::read_imported_file(request.file, request.format,
                                       {error.angle, !request.error.empty()}, request.opened));
  Run run;
  RunHeader& header = run.header;
  header.axis = request.axis;
  header.state = RunState::complete;
  header.simulated = series.simulated;
  header.started_utc = utc_now();
  header.note = request.note;
  header.scans = series.readings.size();
  std::error_code ec;
  header.provenance = {"imported " + series.format,
                       std::filesystem::absolute(request.file, ec).string(),
                       series.sha256,
                       "",
                       error.name,
                       kVersion,
                       options_json(request, error, series),
                       ""};
  const std::vector<double> targets = algo::imported_targets(series.readings);
  MDOF_CHECK(check_readings(series, request, error, targets));
  header.notices = import_notices(series, error);
  append(header.notices, series.notices);
  for (const ImportedReading& r : series.readings)
    run.points.push_back(point_of(r, targets, u_si, error));
  MDOF_CHECK(
      check_gate({JudgedKind::file, request.file, false, without_information(header.notices)},
                 {.simulated = false, .despite_warnings = request.despite_warnings},
                 "the file is not stored as a run"));
  return run;
}

std::string import_document(const RunHeader& header, std::size_t readings) {
  const Provenance& from = header.provenance;
  JsonWriter json;
  json.begin_object().field("run", header.id).field("axis", std::string(1, letter(header.axis)));
  json.field("error", from.model);
  json.field("format", from.recording_kind.substr(std::string("imported ").size()));
  json.field("readings", static_cast<std::uint64_t>(readings));
  json.field("file", from.recording_path).field("sha256", from.recording_sha256);
  json.field("simulated", header.simulated);
  write_notices(json, "notices", header.notices, words::text);
  return json.end_object().take();
}

}  // namespace mdof::daemon
