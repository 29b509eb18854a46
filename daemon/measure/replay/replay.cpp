#include "daemon/measure/replay/replay.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <ctime>
#include <filesystem>

#include "daemon/measure/configuration/config.h"
#include "daemon/measure/corrections/air_series.h"
#include "daemon/measure/replay/on_the_fly_run.h"
#include "daemon/paths.h"
#include "daemon/version.h"
#include "daemon/words/words.h"
#include "drivers/calibration.h"
#include "schema/rig/calibrated.h"
#include "schema/rig/check/rig_check.h"
#include "schema/rig/report_facts.h"

namespace mdof::daemon {
namespace {

using drivers::ReadState;

constexpr std::chrono::milliseconds kReadTimeout{1000};

std::string column_name(const Channel& channel) {
  const std::string unit = suffix(channel.unit);
  return unit.empty() ? channel.id : channel.id + "_" + unit;
}

bool has_channel(const std::vector<Channel>& channels, const std::string& id) {
  return std::any_of(channels.begin(), channels.end(),
                     [&](const Channel& c) { return c.id == id; });
}

Status check_unit(const std::string& source, const std::vector<Channel>& channels,
                  const std::string& probe) {
  for (const Channel& c : channels) {
    if (c.id != probe || (c.unit != Unit::other && c.unit != Unit::deg_c)) continue;
    return bad_input(source + ": column \"" + column_name(c) +
                     "\" contains the readings of the probe \"" + probe + "\", but " +
                     (c.unit == Unit::other ? "the name of the column states no unit"
                                            : "the name of the column states the unit °C") +
                     "; rename the column to " + probe + "_um, " + probe + "_mm or " + probe +
                     "_V, according to the unit of its values");
  }
  return {};
}

// Error: the encoder is in volts, and the rig does not declare its scale.
Status check_encoder(const std::string& source, const std::vector<Channel>& channels,
                     const Rig& rig) {
  for (const Channel& c : channels) {
    if (c.id != kEncoderChannel || c.unit != Unit::volt || rig.encoder_um_per_V) continue;
    return bad_input(source + ": column \"" + column_name(c) +
                     "\" is the axis position in volts, and " + rig.source +
                     " does not state the scale; add [encoder] um_per_V to this rig, or convert "
                     "the values to mm and rename the column to encoder_mm");
  }
  return {};
}

// Checks the ambient quantities that a correction needs. If the rig does not declare a quantity,
// the log must contain it.
Status check_air(const std::string& source, const std::vector<Channel>& channels, const Rig& rig) {
  const auto columns = air_columns(rig);
  for (std::size_t q = 0; q < kAirQuantities; ++q) {
    const std::string key = air_quantities()[q].key;
    if (std::find(columns.begin(), columns.end(), key) == columns.end()) continue;
    if (std::any_of(channels.begin(), channels.end(),
                    [q](const Channel& c) { return has_air_quantity(c, q); }))
      continue;
    return bad_input(source + ": the column " + key +
                     " is missing, but the correction \"dielectric\" ([corrections] of " +
                     rig.source + ") needs this quantity; add the column to the log, or set " +
                     key + " in [air] of the rig");
  }
  return {};
}

// Returns "X" for the key "axis:" if a comment is "axis: X". Returns "" if no comment has the key.
std::string stated(std::string_view key, const std::vector<std::string>& comments) {
  for (const std::string& comment : comments) {
    if (!comment.starts_with(key)) continue;
    const auto begin = comment.find_first_not_of(" \t", key.size());
    if (begin == std::string::npos) continue;
    return comment.substr(begin, comment.find_first_of(" \t", begin) - begin);
  }
  return "";
}

// Returns an ISO 8601 time as UTC in whole seconds, "2026-11-20T10:11:12Z". The text must contain
// the date, hours, minutes, and Z or the offset from UTC. It may contain seconds and their
// fraction. Returns "" for other texts.
std::string utc_from(std::string_view text) {
  bool valid = is_date(text.substr(0, 10));
  const auto skip = [&](char c) {
    if (!text.starts_with(c)) return false;
    text.remove_prefix(1);
    return true;
  };
  const auto number = [&](std::size_t digits, int end) {
    int value = -1;
    const bool all = text.size() >= digits && text.find_first_not_of("0123456789") >= digits;
    if (all) std::from_chars(text.data(), text.data() + digits, value);
    text.remove_prefix(std::min(digits, text.size()));
    valid = valid && value >= 0 && value < end;
    return value;
  };
  std::tm utc{};
  utc.tm_year = number(4, 9999) - 1900;
  skip('-');
  utc.tm_mon = number(2, 13) - 1;
  skip('-');
  utc.tm_mday = number(2, 32);
  valid = skip('T') && valid;
  utc.tm_hour = number(2, 24);
  valid = skip(':') && valid;
  utc.tm_min = number(2, 60);
  if (skip(':')) {
    utc.tm_sec = number(2, 60);
    if (skip('.')) {
      const std::size_t digits = std::min(text.find_first_not_of("0123456789"), text.size());
      valid = valid && digits > 0;
      text.remove_prefix(digits);
    }
  }
  if (!skip('Z')) {
    const int ahead = skip('+') ? 1 : -1;
    valid = (ahead > 0 || skip('-')) && valid;
    utc.tm_hour -= ahead * number(2, 24);
    skip(':');
    if (!text.empty()) utc.tm_min -= ahead * number(2, 60);
  }
  if (!valid || !text.empty() || utc.tm_year < 70) return "";
  timegm(&utc);  // brings all members into their ranges
  std::array<char, 32> out{};
  std::strftime(out.data(), out.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return out.data();
}

// A CSV log may state its start as mdof export does: "started: 2026-11-20T10:11:12.345Z".
std::string stated_start(const std::vector<std::string>& comments) {
  return utc_from(stated("started:", comments));
}

template <class Measuring>
Status read_through(ReplayLog& log, Measuring& pipeline, const ProgressCallback& progress) {
  SampleBlock block;
  for (;;) {
    MDOF_TRY(const ReadState state, log.driver().read(block, kReadTimeout));
    if (block.scans() > 0) {
      if (const Status taken = pipeline.push(block); !taken)
        return in_context(log.path(), taken.error());
    }
    if (progress && !progress(log.progress()))
      return io_error(log.path() +
                      ": the replay was cancelled before the end of the log; replay the log again");
    if (state == ReadState::end) return {};
  }
}

// The place of an error: a column without any value, which is probably the cause, otherwise the
// log.
std::string place_of_error(const ReplayLog& log) {
  for (const Notice& each : log.notices())
    if (each.code == NoticeCode::log_values_missing &&
        *value(each, "missing") == *value(each, "rows"))
      return words::text(each);
  return log.path();
}

template <class Measuring>
Result<Run> measured(ReplayLog& log, const Rig& rig, const PipelineOptions& options,
                     const ProgressCallback& progress) {
  MDOF_TRY(Measuring measuring, Measuring::create(rig, options));
  MDOF_CHECK(read_through(log, measuring, progress));
  auto run = measuring.finish();
  if (!run) return in_context(place_of_error(log), run.error());
  return run;
}

Provenance provenance_of(const ReplayLog& log, const Rig& rig, const PipelineOptions& options) {
  Provenance from;
  from.recording_kind = log.kind();
  std::error_code ec;
  from.recording_path =
      log.path() == "-" ? log.path() : std::filesystem::absolute(log.path(), ec).string();
  from.recording_sha256 = log.sha256();
  from.rig_text = rig.text;
  from.model = to_string(options.model);
  from.software_version = kVersion;
  from.options_json = options.json();
  from.configuration = log.configuration();
  return from;
}

// The day of the measurement is in the recording; for a CSV log, the rig may state it.
Notices overdue_on_day_of(const ReplayLog& log, const Rig& rig) {
  const std::string day = log.started_utc().empty() ? rig.report.date : log.started_utc();
  if (!day.empty()) return overdue_calibrations(rig, day);
  const std::string today = utc_now().substr(0, 10);
  Notices overdue = overdue_calibrations(rig, today);
  if (!overdue.empty())
    overdue.push_back(notice(NoticeCode::log_has_no_date, "", {{"today", today}}));
  return overdue;
}

}  // namespace

Result<ReplayLog> ReplayLog::open(const std::string& path, Descriptors opened) {
  ReplayLog log(path);
  const bool recorded = opened.file >= 0 ? drivers::is_recording(opened.file)
                                         : path != "-" && drivers::is_recording(path);
  if (recorded) {
    auto recording = std::make_unique<drivers::RecordingLog>("recording", path, opened);
    log.recording_ = recording.get();
    log.driver_ = std::move(recording);
  } else {
    drivers::CsvRowsOptions options;
    options.descriptor = opened.file;
    auto csv = std::make_unique<drivers::CsvLog>(path, options);
    log.csv_ = csv.get();
    log.driver_ = std::move(csv);
  }
  MDOF_CHECK(log.driver_->open());
  return log;
}

std::string ReplayLog::rig_text() const {
  return recording_ ? recording_->rig_text() : "";
}

std::string ReplayLog::started_utc() const {
  return recording_ ? recording_->header().started_utc : stated_start(comments());
}

Result<RecordedRequest> ReplayLog::asked_for() const {
  if (!recording_) return RecordedRequest{};
  MDOF_TRY(const auto measure, measure_options(recording_->header().configuration));
  auto asked = read_request_json(recording_->header().request, measure);
  if (!asked) return in_context(path_ + ": stored request of the run", asked.error());
  return asked;
}

std::string ReplayLog::configuration() const {
  return recording_ ? recording_->header().configuration : "";
}

std::vector<std::string> ReplayLog::comments() const {
  return csv_ ? csv_->comments() : std::vector<std::string>();
}

Progress ReplayLog::progress() const {
  if (recording_) return recording_->progress();
  return {static_cast<double>(csv_->bytes()), static_cast<double>(csv_->bytes_total()), "B"};
}

std::string ReplayLog::sha256() const {
  return recording_ ? recording_->sha256() : csv_->sha256();
}

Notices ReplayLog::notices() const {
  return recording_ ? recording_->notices() : csv_->notices();
}

Status check_axis(const std::string& source, const std::vector<std::string>& comments,
                  const Rig& rig) {
  const std::string axis = stated("axis:", comments), of_rig(1, letter(rig.axis));
  if (axis.empty() || axis == of_rig) return {};
  return bad_input(source + ": the log is for axis " + axis + ", but the rig " + rig.source +
                   " is for axis " + of_rig + "; give the rig of axis " + axis);
}

Status check_channels(const std::string& source, const std::vector<Channel>& channels,
                      const Rig& rig) {
  std::string columns;
  for (const Channel& c : channels) columns += (columns.empty() ? "" : ", ") + column_name(c);
  for (const Probe& probe : rig.probes) {
    MDOF_CHECK(check_unit(source, channels, probe.id));
    if (has_channel(channels, probe.id)) continue;
    return bad_input(source + ": the column of the probe \"" + probe.id + "\" of " + rig.source +
                     " is missing (its name must be " + probe.id + "_um, " + probe.id + "_mm or " +
                     probe.id + "_V); the columns of the log are " + columns +
                     "; correct the rig or the header");
  }
  MDOF_CHECK(check_air(source, channels, rig));
  if (has_channel(channels, kEncoderChannel)) return check_encoder(source, channels, rig);
  return bad_input(source +
                   ": the column encoder_mm (axis position) is missing; add this column, or rename "
                   "the column that contains the axis position; the columns of the log are " +
                   columns);
}

Result<Run> replay(ReplayLog& log, const Rig& rig, const PipelineOptions& options,
                   const ProgressCallback& progress) {
  MDOF_CHECK(check_axis(log.path(), log.comments(), rig));
  MDOF_CHECK(check_channels(log.path(), log.driver().info().channels, rig));
  MDOF_TRY(const RecordedRequest asked, log.asked_for());
  auto run = options.on_the_fly ? measured<OnTheFlyRun>(log, rig, options, progress)
                                : measured<Pipeline>(log, rig, options, progress);
  if (!run) return tl::unexpected(run.error());
  run->header.simulated = log.driver().info().simulated;
  run->header.started_utc = log.started_utc();
  run->header.start_known = !run->header.started_utc.empty();
  run->header.provenance = provenance_of(log, rig, options);
  run->header.note = asked.note;
  append(run->header.notices, log.notices());
  append(run->header.notices, asked.notices);
  if (const std::string text = stated("started:", log.comments());
      !text.empty() && log.started_utc().empty())
    run->header.notices.push_back(notice(NoticeCode::log_start_unread, "", {{"text", text}}));
  append(run->header.notices, overdue_on_day_of(log, rig));
  append(run->header.notices, calibration_notices(rig));
  append(run->header.notices, drivers::unused_scales(rig, log.driver().info().channels));
  append(run->header.notices, drivers::unused_channels(rig, log.driver().info().channels));
  append(run->header.notices, unusual_values(rig));
  return run;
}

}  // namespace mdof::daemon
