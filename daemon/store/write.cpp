// Functions of Store that write runs.
#include <future>
#include <utility>

#include "daemon/store/bytes.h"
#include "daemon/store/ledger.h"
#include "daemon/store/result_hash.h"
#include "daemon/store/store.h"
#include "schema/base/json_writer.h"
#include "schema/base/sha256.h"
#include "schema/notice/notice_json.h"
#include "schema/plausibility/plausibility_json.h"

namespace mdof::store {

using sqlite::Statement;
using sqlite::Transaction;

namespace {

std::string json_array(const std::vector<std::string>& texts) {
  if (texts.empty()) return "[]";
  JsonWriter json;
  json.begin_array();
  for (const std::string& text : texts) json.value(std::string_view(text));
  json.end_array();
  return json.take();
}

std::int64_t integer(std::uint64_t x) {
  return static_cast<std::int64_t>(x);
}

void bind_point(Statement& insert, const MeasuredPoint& point, std::string_view flags) {
  const Point& p = point.point;
  insert.bind(std::int64_t{point.target}).bind(point.target_m).bind(std::int64_t{point.run});
  insert.bind(std::int64_t{p.direction}).bind(p.begin_ns).bind(p.end_ns).bind(p.position_m);
  insert.bind(integer(p.samples)).bind(flags);
  insert.bind_bytes(bytes_of(p.probe_m)).bind_bytes(bytes_of(p.probe_u_m));
}

void bind_errors(Statement& insert, const AxisErrors& errors) {
  if (!errors.valid) {
    insert.bind(std::string_view(errors.reason));
    for (int column = 0; column < kErrorCount + 2; ++column) insert.bind_null();
    return;
  }
  insert.bind_null();
  for (const double x : errors.local) insert.bind(x);
  insert.bind(errors.residual_m).bind_bytes(bytes_of(errors.covariance));
}

RunEnd end_of(const Run& run) {
  const RunHeader& header = run.header;
  return {header.state,     header.scans, header.scans_lost, header.notices,     {},
          run.straightness, run.angles,   run.plausibility,  header.temperature, std::nullopt};
}

}  // namespace

Result<std::int64_t> Store::add_run(const Run& run, const std::optional<HistoryEntry>& action,
                                    const std::optional<RunUncertainty>& uncertainty) {
  assert(run.header.state != RunState::open);
  // The hash of a long run is calculated on another thread while its rows are written. For a short
  // run, a thread would take longer than the hash.
  constexpr std::size_t kLong = 500;
  const auto policy = run.points.size() < kLong ? std::launch::deferred : std::launch::async;
  auto sha256 = std::async(policy, [&run] { return store::result_sha256(run); });
  MDOF_TRY(Transaction transaction, Transaction::begin(connection_));
  MDOF_TRY(const std::int64_t id, insert_complete_run(run, sha256, uncertainty));
  MDOF_CHECK(insert_action("run", id, action));
  MDOF_CHECK(transaction.commit());
  return id;
}

Result<std::int64_t> Store::insert_complete_run(const Run& run, std::future<std::string>& sha256,
                                                const std::optional<RunUncertainty>& uncertainty) {
  MDOF_TRY(const std::int64_t id, insert_run(run.header));
  MDOF_CHECK(insert_points(id, 0, run.points));
  const RunEnd end = end_of(run);
  MDOF_CHECK(insert_figures(id, end));
  MDOF_CHECK(insert_plausibility(id, end));
  MDOF_CHECK(insert_uncertainty(id, uncertainty));
  MDOF_CHECK(insert_end(id, end, sha256.get()));
  return id;
}

Result<std::int64_t> Store::begin_run(const RunHeader& header,
                                      const std::optional<HistoryEntry>& action) {
  MDOF_TRY(Transaction transaction, Transaction::begin(connection_));
  MDOF_TRY(const std::int64_t id, insert_run(header));
  MDOF_CHECK(insert_action("run", id, action));
  MDOF_CHECK(transaction.commit());
  open_runs_[id] = 0;
  return id;
}

Status Store::append_points(std::int64_t run, const std::vector<MeasuredPoint>& points) {
  MDOF_CHECK(check_open(run));
  std::int64_t& next_row = open_runs_[run];
  MDOF_TRY(Transaction transaction, Transaction::begin(connection_));
  MDOF_CHECK(insert_points(run, next_row, points));
  MDOF_CHECK(transaction.commit());
  next_row += static_cast<std::int64_t>(points.size());
  return {};
}

Status Store::end_run(std::int64_t run, const RunEnd& end) {
  assert(end.state != RunState::open);
  MDOF_CHECK(check_open(run));
  MDOF_TRY(Transaction transaction, Transaction::begin(connection_));
  MDOF_CHECK(insert_all_of_end(run, end));
  MDOF_CHECK(insert_uncertainty(run, end.uncertainty));
  MDOF_CHECK(transaction.commit());
  open_runs_.erase(run);
  return {};
}

Status Store::insert_all_of_end(std::int64_t run, const RunEnd& end) {
  MDOF_CHECK(insert_figures(run, end));
  MDOF_CHECK(insert_plausibility(run, end));
  MDOF_TRY(const std::string sha256, result_sha256(run));
  MDOF_CHECK(insert_end(run, end, sha256));
  return insert_action("run", run, end.action);
}

Result<std::int64_t> Store::end_and_supersede(std::int64_t run, const RunEnd& end, Run result,
                                              const std::optional<RunUncertainty>& uncertainty) {
  MDOF_CHECK(check_open(run));
  auto sha256 = std::async(std::launch::deferred, [&] { return store::result_sha256(result); });
  MDOF_TRY(Transaction transaction, Transaction::begin(connection_));
  MDOF_CHECK(insert_all_of_end(run, end));
  RunHeader& header = result.header;
  RunHeader asked = header;
  MDOF_TRY(header, run_header(run));
  header.supersedes = run;
  header.state = asked.state;
  header.notices = std::move(asked.notices);
  MDOF_TRY(const std::int64_t id, insert_complete_run(result, sha256, uncertainty));
  MDOF_CHECK(transaction.commit());
  open_runs_.erase(run);
  return id;
}

Status Store::check_open(std::int64_t run) const {
  if (open_runs_.contains(run)) return {};
  return fail(ErrorCode::conflict,
              "run " + std::to_string(run) +
                  ": this run has ended, or it belongs to another program; start a new run");
}

// The only writer calls this function at its start. Open runs in the database were therefore
// interrupted.
Status Store::end_interrupted_runs() {
  MDOF_TRY(Transaction transaction, Transaction::begin(connection_));
  MDOF_TRY(Statement rows, connection_.prepare("SELECT id FROM run WHERE id NOT IN "
                                               "(SELECT run FROM run_end)"));
  std::vector<std::int64_t> interrupted;
  for (;;) {
    MDOF_TRY(const bool row, rows.step());
    if (!row) break;
    interrupted.push_back(rows.integer(0));
  }
  for (const std::int64_t run : interrupted) {
    MDOF_TRY(const std::string sha256, result_sha256(run));
    MDOF_TRY(Statement insert,
             connection_.prepare("INSERT INTO run_end (run, state, warnings, result_sha256) "
                                 "VALUES (?, 'aborted', ?, ?)"));
    const std::string notices = notices_json({notice(NoticeCode::interrupted)});
    insert.bind(run).bind(std::string_view(notices)).bind(std::string_view(sha256));
    MDOF_CHECK(insert.run());
    MDOF_CHECK(add_link(connection_, Fact::run_end, run));
  }
  return transaction.commit();
}

Result<std::int64_t> Store::insert_run(const RunHeader& header) {
  const Provenance& from = header.provenance;
  if (header.supersedes) MDOF_CHECK(check_exists(RowOf::run, *header.supersedes));
  MDOF_TRY(const std::int64_t recording,
           recording_id(from.recording_sha256, from.recording_kind, from.recording_path));
  MDOF_TRY(const std::int64_t rig, document_id(from.rig_text));
  MDOF_TRY(const std::int64_t options, document_id(from.options_json));
  MDOF_TRY(const std::int64_t configuration, document_id(from.configuration));
  MDOF_TRY(Statement insert,
           connection_.prepare("INSERT INTO run (axis, simulated, started_utc, note, supersedes, "
                               "recording, rig, options, configuration, model, "
                               "software_version, moves, travel, reference, start_known) "
                               "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)"));
  const char axis = letter(header.axis);
  insert.bind(std::string_view(&axis, 1)).bind(std::int64_t{header.simulated});
  insert.bind(std::string_view(header.started_utc)).bind(std::string_view(header.note));
  insert.bind(header.supersedes).bind(recording).bind(rig).bind(options).bind(configuration);
  insert.bind(std::string_view(from.model)).bind(std::string_view(from.software_version));
  insert.bind(std::string_view(header.sides.moves())).bind(std::string_view(header.sides.travel()));
  insert.bind(std::string_view(to_string(header.stated.reference)));
  insert.bind(std::int64_t{header.start_known});
  MDOF_CHECK(insert.run());
  const std::int64_t id = connection_.last_insert_rowid();
  MDOF_CHECK(add_link(connection_, Fact::run, id));
  return id;
}

Result<std::int64_t> Store::document_id(const std::string& text) {
  const std::string sha256 = sha256_hex(text);
  MDOF_TRY(Statement insert,
           connection_.prepare("INSERT INTO document (sha256, text) VALUES (?, ?) "
                               "ON CONFLICT DO NOTHING"));
  MDOF_CHECK(insert.bind(std::string_view(sha256)).bind(std::string_view(text)).run());
  MDOF_TRY(Statement select, connection_.prepare("SELECT id FROM document WHERE sha256 = ?"));
  MDOF_CHECK(select.bind(std::string_view(sha256)).step());
  return select.integer(0);
}

Result<std::int64_t> Store::recording_id(const std::string& sha256, const std::string& kind,
                                         const std::string& path) {
  const auto bind = [&](Statement& statement) -> Statement& {
    return statement.bind(std::string_view(sha256))
        .bind(std::string_view(kind))
        .bind(std::string_view(path));
  };
  MDOF_TRY(Statement insert, connection_.prepare("INSERT INTO recording (sha256, kind, path) "
                                                 "VALUES (?, ?, ?) ON CONFLICT DO NOTHING"));
  MDOF_CHECK(bind(insert).run());
  MDOF_TRY(Statement select, connection_.prepare("SELECT id FROM recording WHERE sha256 = ? AND "
                                                 "kind = ? AND path = ?"));
  MDOF_CHECK(bind(select).step());
  return select.integer(0);
}

Status Store::insert_points(std::int64_t run, std::int64_t first_row,
                            const std::vector<MeasuredPoint>& points) {
  MDOF_TRY(Statement insert,
           connection_.prepare("INSERT INTO point (id, run, row, target, target_m, repetition, "
                               "direction, begin_ns, end_ns, position_m, samples, flags, probe_m, "
                               "probe_u_m, reason, dy_m, dz_m, ex_rad, ey_rad, ez_rad, residual_m, "
                               "covariance_m_rad) VALUES "
                               "((?1 << 32) + ?2, ?1, ?2, "
                               "?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)"));
  for (const MeasuredPoint& point : points) {
    const std::string flags = json_array(flag_texts(point.point.flags));
    insert.bind(run).bind(first_row++);
    bind_point(insert, point, flags);
    bind_errors(insert, point.errors);
    MDOF_CHECK(insert.run());
  }
  return {};
}

Status Store::insert_figures(std::int64_t run, const RunEnd& end) {
  MDOF_TRY(Statement straight,
           connection_.prepare("INSERT INTO straightness VALUES (?,?,?,?,?,?,?,?,?,?,?)"));
  std::int64_t row = 0;
  for (const StraightnessFigure& f : end.straightness) {
    straight.bind(run).bind(row++);
    straight.bind(std::string_view(f.error_key)).bind(std::string_view(f.approach));
    straight.bind(f.slope_least_squares_rad).bind(f.slope_end_point_rad);
    straight.bind(f.form_rad).bind(f.straightness_least_squares_m);
    straight.bind(f.straightness_end_point_m).bind(f.peak_position_m).bind(f.valley_position_m);
    MDOF_CHECK(straight.run());
  }
  MDOF_TRY(Statement angle, connection_.prepare("INSERT INTO angle VALUES (?,?,?,?,?,?,?)"));
  row = 0;
  for (const AngleFigure& f : end.angles) {
    angle.bind(run).bind(row++);
    angle.bind(std::string_view(f.error_key)).bind(std::string_view(f.approach));
    angle.bind(f.start_rad).bind(f.min_rad).bind(f.max_rad);
    MDOF_CHECK(angle.run());
  }
  return {};
}

Status Store::insert_plausibility(std::int64_t run, const RunEnd& end) {
  if (!end.plausibility) return {};
  MDOF_TRY(Statement insert,
           connection_.prepare("INSERT INTO run_plausibility (run, json) VALUES (?, ?)"));
  const std::string json = plausibility_json(*end.plausibility);
  return insert.bind(run).bind(std::string_view(json)).run();
}

// When a live run begins, its row in the table recording has no hash. The end of the run refers to
// a new row with the hash.
Result<std::optional<std::int64_t>> Store::final_recording(std::int64_t run, const RunEnd& end) {
  if (end.recording_sha256.empty()) return std::optional<std::int64_t>();
  MDOF_TRY(Statement row, connection_.prepare("SELECT kind, path FROM recording WHERE id = "
                                              "(SELECT recording FROM run WHERE id = ?)"));
  MDOF_CHECK(row.bind(run).step());
  const std::string kind(row.text(0)), path(row.text(1));
  MDOF_TRY(const std::int64_t id, recording_id(end.recording_sha256, kind, path));
  return std::optional(id);
}

Status Store::insert_end(std::int64_t run, const RunEnd& end, const std::string& sha256) {
  MDOF_TRY(const auto recording, final_recording(run, end));
  MDOF_TRY(Statement insert,
           connection_.prepare("INSERT INTO run_end (run, state, scans, scans_lost, warnings, "
                               "recording, result_sha256) VALUES (?, ?, ?, ?, ?, ?, ?)"));
  const std::string notices = notices_json(end.notices);
  insert.bind(run).bind(std::string_view(to_string(end.state)));
  insert.bind(integer(end.scans)).bind(integer(end.scans_lost));
  insert.bind(std::string_view(notices)).bind(recording).bind(std::string_view(sha256));
  MDOF_CHECK(insert.run());
  MDOF_CHECK(insert_temperature(run, end.temperature));
  return add_link(connection_, Fact::run_end, run);
}

}  // namespace mdof::store
