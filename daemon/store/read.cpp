// Functions of Store that read runs.
#include <algorithm>

#include "daemon/store/bytes.h"
#include "daemon/store/ledger.h"
#include "daemon/store/result_hash.h"
#include "daemon/store/store.h"
#include "schema/encoder_datum.h"
#include "schema/imported/series.h"
#include "schema/notice/notice_json.h"
#include "schema/rig/calibrated.h"

namespace mdof::store {

using sqlite::Statement;

namespace {

constexpr std::string_view kHeader =
    "SELECT run.id, run.axis, run.simulated, run.started_utc, run.note, run.supersedes, "
    "recording.kind, recording.path, recording.sha256, rig.text, run.model, run.software_version, "
    "options.text, configuration.text, run_end.state, run_end.scans, run_end.scans_lost, "
    "run_end.warnings, run.moves, run.travel, run.reference, "
    "iif(json_valid(options.text), json_extract(options.text, '$.encoder_datum.kind'), NULL), "
    "iif(json_valid(options.text), json_extract(options.text, '$.encoder_datum.device'), NULL), "
    "run.start_known "
    "FROM run LEFT JOIN run_end ON run_end.run = run.id "
    "JOIN recording ON recording.id = coalesce(run_end.recording, run.recording) "
    "JOIN document AS rig ON rig.id = run.rig "
    "JOIN document AS options ON options.id = run.options "
    "JOIN document AS configuration ON configuration.id = run.configuration ";

constexpr std::string_view kPoints =
    "SELECT target, target_m, repetition, direction, begin_ns, end_ns, position_m, samples, flags, "
    "probe_m, probe_u_m, reason, dy_m, dz_m, ex_rad, ey_rad, ez_rad, residual_m, covariance_m_rad "
    "FROM point WHERE id BETWEEN (?1 << 32) + ?2 AND (?1 << 32) + 4294967295 ORDER BY id LIMIT ?3";

// Excludes runs that end_and_supersede() ended. Such a run is superseded, has the state "failed",
// and has the same start time as the run that supersedes it.
constexpr const char* kResults =
    " AND run.id NOT IN (SELECT given_up.id FROM run AS later "
    "JOIN run AS given_up ON given_up.id = later.supersedes "
    "JOIN run_end ON run_end.run = given_up.id "
    "WHERE run_end.state = 'failed' AND later.started_utc = given_up.started_utc)";

std::string wanted(const char* of_axis, bool results) {
  return std::string(of_axis) + (results ? kResults : "") + " ";
}

std::uint64_t natural(std::int64_t x) {
  return static_cast<std::uint64_t>(x);
}

RunState state_from(std::string_view name) {
  for (const RunState state : {RunState::complete, RunState::partial, RunState::aborted})
    if (name == to_string(state)) return state;
  return RunState::failed;
}

Provenance provenance_of(const Statement& row) {
  Provenance from;
  from.recording_kind = row.text(6);
  from.recording_path = row.text(7);
  from.recording_sha256 = row.text(8);
  from.rig_text = row.text(9);
  from.model = row.text(10);
  from.software_version = row.text(11);
  from.options_json = row.text(12);
  from.configuration = row.text(13);
  return from;
}

// For a run that was stored before the column start_known existed. Then only a CSV log that stated
// its start had a start in whole seconds.
bool was_start_known(const RunHeader& run) {
  constexpr std::string_view kWholeSeconds = "2026-11-20T10:11:12Z";
  const std::string& kind = run.provenance.recording_kind;
  return kind == "csv" ? run.started_utc.size() == kWholeSeconds.size() : !is_imported(run);
}

// Adds notices that are calculated from other columns. Runs of older versions and open runs have
// not stored these notices.
void add_missing(Notices& notices, Notices derived) {
  for (Notice& each : derived)
    if (std::find(notices.begin(), notices.end(), each) == notices.end())
      notices.push_back(std::move(each));
}

AxisErrors errors_of(const Statement& row, int first) {
  AxisErrors errors;
  errors.valid = row.is_null(first);  // the column contains the reason if the point has no errors
  errors.reason = row.text(first);
  if (!errors.valid) return errors;
  for (int k = 0; k < kErrorCount; ++k)
    errors.local[static_cast<std::size_t>(k)] = row.real(first + 1 + k);
  errors.residual_m = row.real(first + 6);
  doubles_from(row.bytes(first + 7), errors.covariance);
  return errors;
}

}  // namespace

Result<std::vector<std::string>> Store::texts(std::string_view json_array) {
  std::vector<std::string> list;
  if (json_array == "[]") return list;
  MDOF_TRY(Statement rows, connection_.prepare("SELECT value FROM json_each(?)"));
  rows.bind(json_array);
  for (;;) {
    const auto row = rows.step();
    if (!row)
      return bad_input("a list of texts is damaged (" + std::string(json_array.substr(0, 40)) +
                       "); restore the database from a backup");
    if (!*row) return list;
    list.emplace_back(rows.text(0));
  }
}

Status Store::check_exists(RowOf table, std::int64_t id) {
  struct Known {
    const char* sql;
    const char* what;
    Remedy remedy;
  };
  static constexpr Known kTables[] = {
      {"SELECT 1 FROM run WHERE id = ?", "run", Remedy::list_runs},
      {"SELECT 1 FROM compensation_table WHERE id = ?", "compensation table", Remedy::list_tables},
      {"SELECT 1 FROM volumetric_table WHERE id = ?", "volumetric table", Remedy::list_tables},
      {"SELECT 1 FROM study WHERE id = ?", "study", Remedy::list_studies}};
  const Known& known = kTables[static_cast<std::size_t>(table)];
  MDOF_TRY(Statement row, connection_.prepare(known.sql));
  MDOF_TRY(const bool found, row.bind(id).step());
  if (found) return {};
  return fail(ErrorCode::not_found,
              file().string() + ": no " + known.what + " " + std::to_string(id), known.remedy);
}

Result<RunHeader> Store::header_of(Statement& row) {
  RunHeader header;
  header.id = row.integer(0);
  header.axis = axis_from(row.text(1)).value_or(Axis::x);
  header.simulated = row.integer(2) != 0;
  header.started_utc = row.text(3);
  header.note = row.text(4);
  if (!row.is_null(5)) header.supersedes = row.integer(5);
  header.provenance = provenance_of(row);
  header.sides = {row.text(18) == "fixture", row.text(19) == "-"};
  header.stated = row.text(20) == "carriage" ? kAtCarriage : kAtFixture;
  if (!row.is_null(14)) {
    header.state = state_from(row.text(14));
    header.scans = natural(row.integer(15));
    header.scans_lost = natural(row.integer(16));
    MDOF_TRY(header.notices, read_notices(row.text(17)));
    MDOF_TRY(header.temperature, temperature(header.id));
  } else if (!open_runs_.contains(header.id) && !WriterLock::open_runs_claimed(file())) {
    header.state = RunState::aborted;  // the next writer stores this state
    header.notices = {notice(NoticeCode::interrupted)};
  }
  EncoderDatum datum;
  datum_kind_from(std::string(row.text(21)), datum.kind);
  datum.device = row.text(22);
  header.start_known = row.is_null(23) ? was_start_known(header) : row.integer(23) != 0;
  add_missing(header.notices, datum_notices(datum));
  add_missing(header.notices, calibration_notices(header.provenance.rig_text));
  return header;
}

// The hash of the result that was stored at the end of the run. Empty: the run has not ended.
Result<std::string> Store::stored_sha256(std::int64_t run) {
  MDOF_TRY(Statement row, connection_.prepare("SELECT result_sha256 FROM run_end WHERE run = ?"));
  MDOF_TRY(const bool found, row.bind(run).step());
  return found ? std::string(row.text(0)) : std::string();
}

Status Store::check_run(std::int64_t run) {
  MDOF_CHECK(check_link(connection_, Fact::run, run));
  MDOF_TRY(const std::string ended, stored_sha256(run));
  return ended.empty() ? Status() : check_link(connection_, Fact::run_end, run);
}

// If the stored facts of a run do not match their hashes, sets the state to failed and adds the
// reason.
Status Store::mark_damage(RunHeader& header) {
  Status whole = check_run(header.id);
  if (whole) return {};
  if (whole.error().code != ErrorCode::bad_input) return whole;
  header.state = RunState::failed;
  header.notices.insert(header.notices.begin(),
                        notice(NoticeCode::row_damaged, "", {{"reason", whole.error().message}}));
  return {};
}

Result<std::vector<RunHeader>> Store::headers(std::string_view where, std::int64_t a,
                                              std::int64_t b, std::optional<Axis> axis) {
  MDOF_TRY(Statement rows, connection_.prepare(std::string(kHeader) + std::string(where)));
  const char letter_of_axis = axis ? letter(*axis) : ' ';
  rows.bind(a).bind(b);
  if (axis) rows.bind(std::string_view(&letter_of_axis, 1));
  std::vector<RunHeader> list;
  for (;;) {
    MDOF_TRY(const bool row, rows.step());
    if (!row) return list;
    MDOF_TRY(RunHeader header, header_of(rows));
    MDOF_CHECK(mark_damage(header));
    list.push_back(std::move(header));
  }
}

Result<RunHeader> Store::run_header(std::int64_t run) {
  MDOF_CHECK(check_exists(RowOf::run, run));
  MDOF_CHECK(check_run(run));
  MDOF_TRY(auto list, headers("WHERE run.id BETWEEN ?1 AND ?2", run, run, std::nullopt));
  if (list.empty())
    return bad_input(file().string() + ": run " + std::to_string(run) +
                     " refers to a row that is missing; restore the database from a backup");
  return std::move(list.front());
}

Result<std::vector<RunHeader>> Store::list_runs(std::int64_t offset, std::int64_t count,
                                                std::optional<Axis> axis, Listed listed) {
  return headers("WHERE " + wanted(axis ? "run.axis = ?3" : "true", listed == Listed::results) +
                     "ORDER BY run.id DESC LIMIT ?2 OFFSET ?1",
                 offset, count, axis);
}

Result<std::vector<std::int64_t>> Store::runs_of_recording(const std::string& sha256) {
  MDOF_TRY(Statement row,
           connection_.prepare("SELECT run.id FROM run LEFT JOIN run_end ON run_end.run = run.id "
                               "JOIN recording ON recording.id = coalesce(run_end.recording, "
                               "run.recording) WHERE recording.sha256 = ? ORDER BY run.id"));
  row.bind(std::string_view(sha256));
  std::vector<std::int64_t> runs;
  for (;;) {
    MDOF_TRY(const bool found, row.step());
    if (!found) return runs;
    runs.push_back(row.integer(0));
  }
}

Result<std::int64_t> Store::count_runs(std::optional<Axis> axis, Listed listed) {
  MDOF_TRY(Statement row,
           connection_.prepare("SELECT count(*) FROM run WHERE " +
                               wanted(axis ? "axis = ?1" : "true", listed == Listed::results)));
  const char letter_of_axis = axis ? letter(*axis) : ' ';
  if (axis) row.bind(std::string_view(&letter_of_axis, 1));
  MDOF_CHECK(row.step());
  return row.integer(0);
}

Result<std::optional<std::int64_t>> Store::superseded_by(std::int64_t run) {
  MDOF_TRY(Statement row, connection_.prepare("SELECT max(id) FROM run WHERE supersedes = ?"));
  MDOF_CHECK(row.bind(run).step());
  return row.is_null(0) ? std::nullopt : std::optional(row.integer(0));
}

Result<MeasuredPoint> Store::point_of(Statement& row) {
  MeasuredPoint point;
  point.target = static_cast<int>(row.integer(0));
  point.target_m = row.real(1);
  point.run = static_cast<int>(row.integer(2));
  Point& p = point.point;
  p.direction = static_cast<int>(row.integer(3));
  p.begin_ns = row.integer(4);
  p.end_ns = row.integer(5);
  p.position_m = row.real(6);
  p.samples = natural(row.integer(7));
  MDOF_TRY(const auto flags, texts(row.text(8)));
  for (const std::string& text : flags) {
    MDOF_TRY(PointFlag flag, point_flag_from(text));
    p.flags.push_back(std::move(flag));
  }
  p.probe_m = doubles_from(row.bytes(9));
  p.probe_u_m = doubles_from(row.bytes(10));
  point.errors = errors_of(row, 11);
  return point;
}

Result<std::vector<MeasuredPoint>> Store::points(std::int64_t run, std::int64_t offset,
                                                 std::int64_t count) {
  MDOF_TRY(auto list, read_points(run, offset, count));
  MDOF_CHECK(check_points(run, std::max<std::int64_t>(offset, 0), list));
  return list;
}

// The database stores one hash for all points of a run, so it cannot check some points alone.
// Therefore the first call checks the whole run and keeps a hash of each point in memory. Later
// calls compare the points with these hashes.
Status Store::check_points(std::int64_t run, std::int64_t offset,
                           const std::vector<MeasuredPoint>& points) {
  MDOF_TRY(const std::string stored, stored_sha256(run));
  if (stored.empty()) return {};  // the run is being measured
  MDOF_CHECK(check_link(connection_, Fact::run_end, run));
  if (checked_.run != run || checked_.sha256 != stored) {
    CheckedRows now{run, stored, {}};
    MDOF_TRY(const std::string sha256, hash_rows(run, &now.rows));
    if (sha256 != stored) return other_rows(run);
    checked_ = std::move(now);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t row = static_cast<std::size_t>(offset) + i;
    if (row < checked_.rows.size() && row_hash(points[i]) == checked_.rows[row]) continue;
    checked_ = {};
    return other_rows(run);
  }
  return {};
}

tl::unexpected<Error> Store::other_rows(std::int64_t run) const {
  return bad_input(file().string() + ": the results of run " + std::to_string(run) +
                   " were changed after they were stored; replay the recording of this run");
}

Result<std::vector<MeasuredPoint>> Store::read_points(std::int64_t run, std::int64_t offset,
                                                      std::int64_t count) {
  MDOF_CHECK(check_exists(RowOf::run, run));
  MDOF_TRY(Statement rows, connection_.prepare(kPoints));
  rows.bind(run).bind(std::max<std::int64_t>(offset, 0)).bind(count);
  std::vector<MeasuredPoint> list;
  for (;;) {
    MDOF_TRY(const bool row, rows.step());
    if (!row) return list;
    MDOF_TRY(MeasuredPoint point, point_of(rows));
    list.push_back(std::move(point));
  }
}

Result<std::int64_t> Store::count_points(std::int64_t run) {
  MDOF_CHECK(check_exists(RowOf::run, run));
  MDOF_TRY(Statement row,
           connection_.prepare(
               "SELECT count(*) FROM point WHERE id BETWEEN ?1 << 32 AND (?1 << 32) + 4294967295"));
  MDOF_CHECK(row.bind(run).step());
  return row.integer(0);
}

Result<std::vector<StraightnessFigure>> Store::straightness(std::int64_t run) {
  MDOF_TRY(Statement rows,
           connection_.prepare("SELECT * FROM straightness WHERE run = ? ORDER BY row"));
  rows.bind(run);
  std::vector<StraightnessFigure> list;
  for (;;) {
    MDOF_TRY(const bool row, rows.step());
    if (!row) return list;
    list.push_back({std::string(rows.text(2)), std::string(rows.text(3)), rows.real(4),
                    rows.real(5), rows.real(6), rows.real(7), rows.real(8), rows.real(9),
                    rows.real(10)});
  }
}

Result<std::vector<AngleFigure>> Store::angles(std::int64_t run) {
  MDOF_TRY(Statement rows, connection_.prepare("SELECT * FROM angle WHERE run = ? ORDER BY row"));
  rows.bind(run);
  std::vector<AngleFigure> list;
  for (;;) {
    MDOF_TRY(const bool row, rows.step());
    if (!row) return list;
    list.push_back({std::string(rows.text(2)), std::string(rows.text(3)), rows.real(4),
                    rows.real(5), rows.real(6)});
  }
}

Result<Run> Store::run(std::int64_t run) {
  Run whole;
  MDOF_TRY(whole.header, run_header(run));
  MDOF_TRY(whole.points, read_points(run, 0, -1));  // a negative limit means no limit
  MDOF_TRY(whole.straightness, straightness(run));
  MDOF_TRY(whole.angles, angles(run));
  MDOF_TRY(whole.plausibility, plausibility(run));
  MDOF_TRY(const std::string stored, stored_sha256(run));
  if (stored.empty() || stored == store::result_sha256(whole)) return whole;
  return other_rows(run);
}

Result<std::string> Store::result_sha256(std::int64_t run) {
  return hash_rows(run, nullptr);
}

Result<std::string> Store::hash_rows(std::int64_t run, std::vector<std::uint64_t>* rows) {
  MDOF_CHECK(check_exists(RowOf::run, run));
  ResultHash hash;
  constexpr std::int64_t kPage = 4096;
  for (std::int64_t offset = 0;; offset += kPage) {
    MDOF_TRY(const auto page, read_points(run, offset, kPage));
    for (const MeasuredPoint& point : page) {
      hash.add(point);
      if (rows) rows->push_back(row_hash(point));
    }
    if (page.size() < kPage) break;
  }
  MDOF_TRY(const auto straight, straightness(run));
  for (const StraightnessFigure& figure : straight) hash.add(figure);
  MDOF_TRY(const auto angular, angles(run));
  for (const AngleFigure& figure : angular) hash.add(figure);
  return hash.hex();
}

}  // namespace mdof::store
