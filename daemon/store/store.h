// The database of runs, squareness, compensation tables and sensitivity studies: typed calls for
// schema/sql/*.sql. Append only. Everything that returns ok is on the disk, according to the
// durability.
#pragma once

#include <cstdint>
#include <filesystem>
#include <future>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "daemon/store/file/writer_lock.h"
#include "daemon/store/ledger.h"
#include "daemon/store/study/study_record.h"
#include "schema/base/result.h"
#include "schema/base/sqlite/sqlite.h"
#include "schema/compensation_table.h"
#include "schema/encoder_datum.h"
#include "schema/history_entry.h"
#include "schema/iso230/squareness.h"
#include "schema/notice/notice.h"
#include "schema/run.h"
#include "schema/uncertainty/run_uncertainty.h"
#include "schema/volumetric/volumetric_table.h"

namespace mdof::store {

using sqlite::Durability;

enum class Access {
  read_only,   // the file must exist; any number of readers, also during writing
  read_write,  // created if missing, migrated to the newest schema; one writer at a time
};

struct StoreOptions {
  Durability durability = Durability::full;
  int busy_timeout_ms = 5000;  // longest wait for the end of another writer
};

// Data of a run that are known only after its end.
struct RunEnd {
  RunState state = RunState::complete;  // not open
  std::uint64_t scans = 0, scans_lost = 0;
  Notices notices;
  std::string recording_sha256;  // SHA-256 of a recording that was not yet complete at the start
  std::vector<StraightnessFigure> straightness;
  std::vector<AngleFigure> angles;
  std::optional<Plausibility> plausibility = std::nullopt;
  std::optional<Temperature> temperature = std::nullopt;
  std::optional<HistoryEntry> action = std::nullopt;         // the user who ended it
  std::optional<RunUncertainty> uncertainty = std::nullopt;  // uncertainty of its points, for SQL
                                                             // users
};

// An active table.
struct ActiveTable {
  CompensationTable table;
  std::int64_t generation = 0;
  std::string actor;
  std::string activated_utc;
  bool doubtful = false;  // whether its runs are doubtful; readers for clients set it
};

struct ActiveVolumetric {
  VolumetricTable table;
  std::int64_t generation = 0;
  std::string actor;
  std::string activated_utc;
  bool doubtful = false;  // as in ActiveTable
};

// Information that a controller needs about a table.
struct Marks {
  bool simulated = false, doubtful = false;
};

// Result of activate() or deactivate().
struct Activation {
  std::int64_t generation = 0;
  bool changed = false;  // false: it already was in this state, with this generation
  std::optional<Marks> marks = std::nullopt;  // marks of the activated table
};

// {`members`,"generation":7,"changed":true}, with "simulated" and "doubtful" for a table. `members`
// is JSON that names the object.
std::string activation_json(const std::string& members, const Activation& activation);

// Thread-bound. Messages name the file; not_found names the missing run or table. A requested
// action takes a `HistoryEntry` with its user; it is stored in the same transaction, with its
// `detail` as the reason. Doubles are read back bit-identical; a NaN is read back as a NaN.
class Store {
 public:
  static Result<Store> open(const std::filesystem::path& file, Access access,
                            StoreOptions options = {});

  // ---- runs ----
  // Stores a whole run or nothing, in one transaction. The header's id is ignored; its state must
  // not be open. Returns the run's id.
  Result<std::int64_t> add_run(const Run& run,
                               const std::optional<HistoryEntry>& action = std::nullopt,
                               const std::optional<RunUncertainty>& uncertainty = std::nullopt);
  // For a run in progress: begin, append, end; each call is durable on return. Only this store can
  // append to it. If the store is closed before the run ends, the run becomes `aborted` with the
  // notice "interrupted".
  Result<std::int64_t> begin_run(const RunHeader& header,
                                 const std::optional<HistoryEntry>& action = std::nullopt);
  Status append_points(std::int64_t run, const std::vector<MeasuredPoint>& points);
  Status end_run(std::int64_t run, const RunEnd& end);
  // Ends the run and stores its final result as a run that supersedes it, in one transaction. From
  // the header of `result` only state and notices are used. Returns the new run's id.
  Result<std::int64_t> end_and_supersede(
      std::int64_t run, const RunEnd& end, Run result,
      const std::optional<RunUncertainty>& uncertainty = std::nullopt);

  Result<RunHeader> run_header(std::int64_t run);
  // Newest first; `axis` selects the runs of one axis. `results`: without runs that
  // end_and_supersede() ended, because their result is another run.
  enum class Listed { all, results };
  Result<std::vector<RunHeader>> list_runs(std::int64_t offset, std::int64_t count,
                                           std::optional<Axis> axis = std::nullopt,
                                           Listed listed = Listed::all);
  Result<std::int64_t> count_runs(std::optional<Axis> axis = std::nullopt,
                                  Listed listed = Listed::all);
  Result<std::optional<std::int64_t>> superseded_by(std::int64_t run);  // the last run that
                                                                        // supersedes it
  // Rows offset ... offset + count - 1 in the order of measurement, as far as they exist. For a
  // finished run each row is checked by the run's hash; the first call reads all rows.
  Result<std::vector<MeasuredPoint>> points(std::int64_t run, std::int64_t offset,
                                            std::int64_t count);
  Result<std::int64_t> count_points(std::int64_t run);
  Result<Run> run(std::int64_t run);
  // The hash of the result rows as stored now; see result_hash.h for the bytes.
  Result<std::string> result_sha256(std::int64_t run);

  // ---- squareness ----
  Result<std::int64_t> add_squareness(const Squareness& squareness,
                                      const std::optional<HistoryEntry>& action = std::nullopt);
  Result<std::vector<Squareness>> list_squareness(std::int64_t offset, std::int64_t count);
  // Squareness of these two runs, newest first.
  Result<std::vector<Squareness>> squareness_of(std::int64_t run_a, std::int64_t run_b);

  // ---- compensation tables ----
  Result<std::int64_t> add_table(const CompensationTable& table,
                                 const std::optional<HistoryEntry>& action = std::nullopt);
  Result<CompensationTable> table(std::int64_t id);
  Result<std::vector<CompensationTable>> list_tables(std::int64_t offset, std::int64_t count,
                                                     std::optional<Axis> axis = std::nullopt);
  // Activates a table on its axis; returns the new generation. Generations increase strictly over
  // all axes, so that one number shows whether anything has changed. `expected`: the generation()
  // on which the decision was based, checked in the same transaction. Error (conflict) if it
  // differs: the message names the active tables, and nothing changes.
  Result<Activation> activate(std::int64_t table, const std::string& actor, const std::string& utc,
                              const std::optional<HistoryEntry>& action = std::nullopt,
                              std::optional<std::int64_t> expected = std::nullopt);
  // After this call no table is active on the axis.
  Result<Activation> deactivate(Axis axis, const std::string& actor, const std::string& utc,
                                const std::optional<HistoryEntry>& action = std::nullopt,
                                std::optional<std::int64_t> expected = std::nullopt);
  Result<ActiveTable> active(Axis axis);  // not_found if none is active
  Result<std::int64_t> generation();      // the highest; 0: no activation so far
  Status check_generation(std::optional<std::int64_t> expected);  // see activate()

  // ---- volumetric tables ----
  // Their ids and generations share one sequence with those of compensation tables.
  Result<std::int64_t> add_volumetric(const VolumetricTable& table,
                                      const std::optional<HistoryEntry>& action = std::nullopt);
  Result<VolumetricTable> volumetric(std::int64_t id);
  Result<bool> is_volumetric(std::int64_t id);  // false: unknown table, or table of an axis
  Result<std::vector<VolumetricTable>> list_volumetric(std::int64_t offset, std::int64_t count);
  // Activates a table; without a table it deactivates the active one.
  Result<Activation> change_volumetric(std::optional<std::int64_t> table, const std::string& actor,
                                       const std::string& utc,
                                       const std::optional<HistoryEntry>& action = std::nullopt,
                                       std::optional<std::int64_t> expected = std::nullopt);
  Result<ActiveVolumetric> active_volumetric();  // not_found if none is active

  // ---- set positions of an axis ----
  Result<std::int64_t> add_datum(const DatumSetting& setting,  // its id is ignored
                                 const std::optional<HistoryEntry>& action = std::nullopt);
  Result<std::optional<DatumSetting>> last_datum(Axis axis);

  // ---- history ----
  // Actions on a run and on the runs that it supersedes, in order.
  Result<std::vector<HistoryEntry>> run_actions(std::int64_t run);
  Result<std::vector<HistoryEntry>> list_actions(std::int64_t offset,
                                                 std::int64_t count);  // newest first
  Result<std::int64_t> count_actions();

  // ---- sensitivity studies ----
  // A study begins, replaces its checkpoint while it runs, and ends: complete, or interrupted with
  // a checkpoint from which it can continue. Each call is durable on return. Any store may make it,
  // so that a study of hours need not keep its database open.
  Result<std::int64_t> begin_study(const StudyRecord& study);  // its id is ignored
  Status save_checkpoint(std::int64_t study, const StudyCheckpoint& checkpoint);
  Status end_study(std::int64_t study, const StudyOutcome& outcome,
                   const std::optional<StudyCheckpoint>& checkpoint);  // nullopt: removes the last
                                                                       // one
  Result<StudyRecord> study(std::int64_t id);
  Result<std::vector<StudyRecord>> list_studies(std::int64_t offset, std::int64_t count);
  Result<std::int64_t> count_studies();
  Result<std::optional<StudyOutcome>> study_outcome(std::int64_t study);  // the last
  Result<std::optional<StudyCheckpoint>> study_checkpoint(std::int64_t study);

  // ---- integrity ----
  // Checks the file, its references, the chain of hashes (ledger.h), and the hashes of all texts,
  // of the result rows of all runs, and of the figures and checkpoints of all studies. One sentence
  // for each finding; empty: no damage.
  Result<std::vector<std::string>> verify();
  // The head of the chain of hashes, and whether an earlier head is still in the chain.
  Result<ChainHead> chain_head() { return store::chain_head(connection_); }
  Result<bool> has_hash(const std::string& sha256) { return store::has_hash(connection_, sha256); }
  // Error (bad_input): the chain no longer contains the head that mdofd announced last
  // (file/announced_head.h).
  Status check_announced_head();
  Status check_head(const ChainHead& reported);

  const std::filesystem::path& file() const { return connection_.file(); }
  // For a writing store: why nothing is stored any more, because -wal or -shm has changed
  // (schema/base/database/journal_watch.h); empty: no fault.
  std::string journal_fault() { return connection_.journal_fault(); }
  // The last SQLite message about a damaged file; empty: none.
  const std::string& damage() const { return connection_.damage(); }
  std::int64_t changes() const { return connection_.changes(); }  // rows written by this store

 private:
  Store(WriterLock lock, sqlite::Connection connection, Access access)
      : lock_(std::move(lock)), connection_(std::move(connection)), access_(access) {}

  // write.cpp
  Status end_interrupted_runs();
  Result<std::int64_t> insert_run(const RunHeader& header);
  Result<std::int64_t> document_id(const std::string& text);
  Result<std::int64_t> recording_id(const std::string& sha256, const std::string& kind,
                                    const std::string& path);
  Status insert_points(std::int64_t run, std::int64_t first_row,
                       const std::vector<MeasuredPoint>& points);
  Status insert_figures(std::int64_t run, const RunEnd& end);
  Result<std::optional<std::int64_t>> final_recording(std::int64_t run, const RunEnd& end);
  Status insert_plausibility(std::int64_t run, const RunEnd& end);
  Status insert_temperature(std::int64_t run, const std::optional<Temperature>& read);
  Result<std::optional<Temperature>> temperature(std::int64_t run);
  Status insert_end(std::int64_t run, const RunEnd& end, const std::string& sha256);
  Status insert_uncertainty(std::int64_t run, const std::optional<RunUncertainty>& known);
  Result<std::int64_t> insert_complete_run(const Run& run, std::future<std::string>& sha256,
                                           const std::optional<RunUncertainty>& uncertainty);
  Status insert_all_of_end(std::int64_t run, const RunEnd& end);
  Status check_open(std::int64_t run) const;
  // read.cpp
  Result<std::vector<RunHeader>> headers(std::string_view where, std::int64_t a, std::int64_t b,
                                         std::optional<Axis> axis);
  Result<RunHeader> header_of(sqlite::Statement& row);
  Result<MeasuredPoint> point_of(sqlite::Statement& row);
  Result<std::vector<StraightnessFigure>> straightness(std::int64_t run);
  Result<std::vector<AngleFigure>> angles(std::int64_t run);
  Result<std::vector<std::string>> texts(std::string_view json_array);
  Result<std::string> stored_sha256(std::int64_t run);
  Status check_run(std::int64_t run);
  Result<std::vector<MeasuredPoint>> read_points(std::int64_t run, std::int64_t offset,
                                                 std::int64_t count);
  Result<std::string> hash_rows(std::int64_t run, std::vector<std::uint64_t>* rows);
  tl::unexpected<Error> other_rows(std::int64_t run) const;
  Status check_points(std::int64_t run, std::int64_t offset,
                      const std::vector<MeasuredPoint>& points);
  Status mark_damage(RunHeader& header);
  Result<std::vector<Squareness>> checked_squareness(sqlite::Statement& rows);
  enum class RowOf { run, compensation_table, volumetric_table, study };
  // Error (not_found) with the command that lists the existing rows.
  Status check_exists(RowOf table, std::int64_t id);
  // plausibility_read.cpp
  Result<std::optional<Plausibility>> plausibility(std::int64_t run);
  // tables.cpp
  Result<CompensationTable> table_of(sqlite::Statement& row);
  Result<std::vector<std::int64_t>> integers(std::string_view sql, std::int64_t of);
  Result<std::int64_t> next_generation(const std::string& utc);
  std::string active_text();
  // volumetric.cpp
  Result<std::int64_t> next_table();
  Result<VolumetricTable> volumetric_of(sqlite::Statement& row);
  // history.cpp
  Status insert_action(std::string_view subject, std::int64_t row,
                       const std::optional<HistoryEntry>& action);
  Status insert_reason(std::int64_t action, std::string_view text);
  Result<std::vector<HistoryEntry>> read_actions(sqlite::Statement& rows);
  Status add_detail(HistoryEntry& action);
  // encoder_data.cpp
  Result<std::optional<DatumSetting>> read_datum(sqlite::Statement& row);
  Result<std::optional<DatumSetting>> datum(std::int64_t id);
  // study_write.cpp
  Status replace_checkpoint(std::int64_t study, const StudyCheckpoint& checkpoint);
  Status insert_outcome(std::int64_t study, const StudyOutcome& outcome);
  // study_read.cpp
  Status verify_studies(std::vector<std::string>& findings);
  // verify.cpp
  Status verify_ledger(std::vector<std::string>& findings);
  Status verify_file(std::vector<std::string>& findings);
  Status verify_documents(std::vector<std::string>& findings);
  Status verify_runs(std::vector<std::string>& findings);

  WriterLock lock_;  // created first, destroyed last
  sqlite::Connection connection_;
  Access access_;
  std::map<std::int64_t, std::int64_t> open_runs_;  // runs that began here -> next row
  // For the run of the last points(): its stored hash, which matched its rows, and the first bytes
  // of the hash of each row.
  struct CheckedRows {
    std::int64_t run = 0;
    std::string sha256;
    std::vector<std::uint64_t> rows;
  } checked_;
};

}  // namespace mdof::store
