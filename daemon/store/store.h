// The database of runs, squareness, compensation tables and sensitivity studies. Its schema is in
// schema/sql/*.sql. Rows are only added and do not change. When a function returns ok, its data are
// on the disk, according to the durability.
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
  read_only,   // the file must exist; any number of readers, also while a writer writes
  read_write,  // a missing file is created; an older schema is migrated; only one writer at a time
};

struct StoreOptions {
  Durability durability = Durability::full;
  int busy_timeout_ms = 5000;  // longest time to wait for the end of another writer
};

// Data of a run that are known only at its end.
struct RunEnd {
  RunState state = RunState::complete;  // must not be RunState::open
  std::uint64_t scans = 0, scans_lost = 0;
  Notices notices;
  // SHA-256 of the recording, if the recording was not complete when the run began.
  std::string recording_sha256;
  std::vector<StraightnessFigure> straightness;
  std::vector<AngleFigure> angles;
  std::optional<Plausibility> plausibility = std::nullopt;
  std::optional<Temperature> temperature = std::nullopt;
  std::optional<HistoryEntry> action = std::nullopt;  // the user who ended the run
  // Uncertainty of the points, for users who read the database with SQL.
  std::optional<RunUncertainty> uncertainty = std::nullopt;
};

// The tables of the axis of a run and the volumetric tables that were active during the run.
struct TablesOfRun {
  std::vector<std::int64_t> tables;  // at the start and later, in increasing order
  bool changed = false;              // a table was activated or deactivated during the run
};

// An active table of an axis.
struct ActiveTable {
  CompensationTable table;
  std::int64_t generation = 0;
  std::string actor;
  std::string activated_utc;
  // Whether the runs of the table are doubtful. The store does not set this member.
  bool doubtful = false;
};

struct ActiveVolumetric {
  VolumetricTable table;
  std::int64_t generation = 0;
  std::string actor;
  std::string activated_utc;
  bool doubtful = false;  // as in ActiveTable
};

// Warnings about a table that a controller receives.
struct Marks {
  bool simulated = false, doubtful = false;
};

// Result of activate() or deactivate().
struct Activation {
  std::int64_t generation = 0;
  bool changed = false;  // false: the table was in this state already, with this generation
  std::optional<Marks> marks = std::nullopt;  // marks of the activated table
};

// {`members`,"generation":7,"changed":true}. If `activation` has marks, "simulated" and "doubtful"
// are added. `members`: JSON members that state the table or the axis.
std::string activation_json(const std::string& members, const Activation& activation);

// Thread-bound. Error messages name the file; the error not_found names the missing run or table.
// If a user requests a change, the parameter `action` states the user; the change and the action
// are stored in one transaction, and action.detail is stored as the reason. Stored doubles are read
// bit-identical; NaN is read as NaN.
class Store {
 public:
  static Result<Store> open(const std::filesystem::path& file, Access access,
                            StoreOptions options = {});

  // ---- runs ----

  // Stores a complete run in one transaction. The state in the header must not be "open", and the
  // id in the header is ignored. Returns the id of the stored run.
  Result<std::int64_t> add_run(const Run& run,
                               const std::optional<HistoryEntry>& action = std::nullopt,
                               const std::optional<RunUncertainty>& uncertainty = std::nullopt);
  // Functions for a run in progress: begin, append, end. After each call the data are on the disk.
  // Only the store object that began the run can append to it. If this object is destroyed before
  // the run ends, the state of the run becomes "aborted", with the notice "interrupted".
  Result<std::int64_t> begin_run(const RunHeader& header,
                                 const std::optional<HistoryEntry>& action = std::nullopt);
  Status append_points(std::int64_t run, const std::vector<MeasuredPoint>& points);
  Status end_run(std::int64_t run, const RunEnd& end);
  // Ends the run and stores its result as a new run that supersedes it, in one transaction. Only
  // the state and the notices in the header of `result` are used. Returns the id of the new run.
  Result<std::int64_t> end_and_supersede(
      std::int64_t run, const RunEnd& end, Run result,
      const std::optional<RunUncertainty>& uncertainty = std::nullopt);

  Result<RunHeader> run_header(std::int64_t run);
  // The newest run comes first. `axis`: only runs of this axis. Listed::results: without runs that
  // end_and_supersede() ended, because their result is in another run.
  enum class Listed { all, results };
  Result<std::vector<RunHeader>> list_runs(std::int64_t offset, std::int64_t count,
                                           std::optional<Axis> axis = std::nullopt,
                                           Listed listed = Listed::all);
  // The runs from the recording with this hash, in ascending order.
  Result<std::vector<std::int64_t>> runs_of_recording(const std::string& sha256);
  Result<std::int64_t> count_runs(std::optional<Axis> axis = std::nullopt,
                                  Listed listed = Listed::all);
  // The newest run that supersedes the run.
  Result<std::optional<std::int64_t>> superseded_by(std::int64_t run);
  // The points with the indices offset to offset + count - 1, in the order of measurement. If a run
  // has ended, its points are checked with the stored hash. The first call for a run therefore
  // reads all points.
  Result<std::vector<MeasuredPoint>> points(std::int64_t run, std::int64_t offset,
                                            std::int64_t count);
  Result<std::int64_t> count_points(std::int64_t run);
  Result<Run> run(std::int64_t run);
  // Calculates the hash of the stored result (result_hash.h).
  Result<std::string> result_sha256(std::int64_t run);

  // ---- squareness ----
  Result<std::int64_t> add_squareness(const Squareness& squareness,
                                      const std::optional<HistoryEntry>& action = std::nullopt);
  Result<std::vector<Squareness>> list_squareness(std::int64_t offset, std::int64_t count);
  // All squareness results from these two runs, newest first.
  Result<std::vector<Squareness>> squareness_of(std::int64_t run_a, std::int64_t run_b);

  // ---- compensation tables ----
  Result<std::int64_t> add_table(const CompensationTable& table,
                                 const std::optional<HistoryEntry>& action = std::nullopt);
  Result<CompensationTable> table(std::int64_t id);
  Result<std::vector<CompensationTable>> list_tables(std::int64_t offset, std::int64_t count,
                                                     std::optional<Axis> axis = std::nullopt);
  // Activates a table on its axis. Each change of any active table gets a larger generation. One
  // number therefore shows whether an active table has changed. `expected`: the generation() that
  // the user knew. Error (conflict): generation() is another number now. The message names the
  // active tables. The check and the activation are in one transaction.
  Result<Activation> activate(std::int64_t table, const std::string& actor, const std::string& utc,
                              const std::optional<HistoryEntry>& action = std::nullopt,
                              std::optional<std::int64_t> expected = std::nullopt);
  // Deactivates the active table of the axis.
  Result<Activation> deactivate(Axis axis, const std::string& actor, const std::string& utc,
                                const std::optional<HistoryEntry>& action = std::nullopt,
                                std::optional<std::int64_t> expected = std::nullopt);
  Result<ActiveTable> active(Axis axis);  // not_found if no table is active
  // The tables that were active while this run was measured: from its start to its last scan. If
  // its start is not known: on the day that its rig states, or at its evaluation. `continued`: the
  // run that this run continues; its time is not included. Does not check the ledger; active() and
  // active_volumetric() do.
  Result<TablesOfRun> active_during(const RunHeader& run,
                                    std::optional<std::int64_t> continued = std::nullopt);
  Result<std::int64_t> generation();  // the largest generation; 0: no table was ever active
  Status check_generation(std::optional<std::int64_t> expected);  // error as for activate()

  // ---- volumetric tables ----

  // A volumetric table never has the same id or generation as a compensation table.
  Result<std::int64_t> add_volumetric(const VolumetricTable& table,
                                      const std::optional<HistoryEntry>& action = std::nullopt);
  Result<VolumetricTable> volumetric(std::int64_t id);
  // false: the table is unknown, or is a table of an axis.
  Result<bool> is_volumetric(std::int64_t id);
  Result<std::vector<VolumetricTable>> list_volumetric(std::int64_t offset, std::int64_t count);
  // Activates `table`. If `table` is nullopt, deactivates the active volumetric table.
  Result<Activation> change_volumetric(std::optional<std::int64_t> table, const std::string& actor,
                                       const std::string& utc,
                                       const std::optional<HistoryEntry>& action = std::nullopt,
                                       std::optional<std::int64_t> expected = std::nullopt);
  Result<ActiveVolumetric> active_volumetric();  // not_found if no table is active

  // ---- axis positions that users set ----
  Result<std::int64_t> add_datum(const DatumSetting& setting,  // setting.id is ignored
                                 const std::optional<HistoryEntry>& action = std::nullopt);
  Result<std::optional<DatumSetting>> last_datum(Axis axis);

  // ---- history ----

  // Actions on a run and on the runs that it supersedes, in the order of time.
  Result<std::vector<HistoryEntry>> run_actions(std::int64_t run);
  Result<std::vector<HistoryEntry>> list_actions(std::int64_t offset,
                                                 std::int64_t count);  // newest first
  Result<std::int64_t> count_actions();

  // ---- sensitivity studies ----

  // A study begins, stores checkpoints while it calculates, and ends. A study ends as complete, or
  // as interrupted with a checkpoint from which it can continue. After each call the data are on
  // the disk. Each call can use another store object, so a long study need not keep the database
  // open.
  Result<std::int64_t> begin_study(const StudyRecord& study);  // study.id is ignored
  Status save_checkpoint(std::int64_t study, const StudyCheckpoint& checkpoint);
  // nullopt: removes the stored checkpoint.
  Status end_study(std::int64_t study, const StudyOutcome& outcome,
                   const std::optional<StudyCheckpoint>& checkpoint);
  Result<StudyRecord> study(std::int64_t id);
  Result<std::vector<StudyRecord>> list_studies(std::int64_t offset, std::int64_t count);
  Result<std::int64_t> count_studies();
  Result<std::optional<StudyOutcome>> study_outcome(std::int64_t study);  // the newest outcome
  Result<std::optional<StudyCheckpoint>> study_checkpoint(std::int64_t study);

  // ---- integrity ----

  // Checks the file, its references, the chain of hashes (ledger.h), and the hashes of all texts,
  // results of runs, figures of studies and checkpoints. Returns one sentence for each fault;
  // empty: no damage.
  Result<std::vector<std::string>> verify();
  // Compares the tables, indexes, views and triggers with those of a new database. A trigger that
  // is not in a new database could change data; other objects may have been added by a user.
  Result<std::vector<std::string>> verify_definitions();
  // chain_head(): the head of the chain of hashes. has_hash(): whether the chain contains a link
  // with this hash.
  Result<ChainHead> chain_head() { return store::chain_head(connection_); }
  Result<bool> has_hash(const std::string& sha256) { return store::has_hash(connection_, sha256); }
  // Error (bad_input): the chain does not contain the head that mdofd announced last
  // (file/announced_head.h).
  Status check_announced_head();
  Status check_head(const ChainHead& reported);

  const std::filesystem::path& file() const { return connection_.file(); }
  // For a store with write access: the reason why this store stores no data any more. Another
  // program has changed the -wal or -shm file (schema/base/database/journal_watch.h). Empty: no
  // fault.
  std::string journal_fault() { return connection_.journal_fault(); }
  // The last message of SQLite about a damaged file. Empty: no damage was found.
  const std::string& damage() const { return connection_.damage(); }
  // Number of rows that this object has written.
  std::int64_t changes() const { return connection_.changes(); }

 private:
  Result<double> measured_s(std::int64_t run);
  Store(WriterLock lock, sqlite::Connection connection, Access access)
      : lock_(std::move(lock)), connection_(std::move(connection)), access_(access) {}

  // Functions in write.cpp:
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
  // Functions in read.cpp:
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
  // Error (not_found): the row does not exist. The message states the command that lists the
  // existing rows.
  Status check_exists(RowOf table, std::int64_t id);
  // Functions in plausibility_read.cpp:
  Result<std::optional<Plausibility>> plausibility(std::int64_t run);
  // Functions in tables.cpp:
  Result<CompensationTable> table_of(sqlite::Statement& row);
  Result<std::vector<std::int64_t>> integers(std::string_view sql, std::int64_t of);
  Result<std::int64_t> next_generation(const std::string& utc);
  std::string active_text();
  // Functions in volumetric.cpp:
  Result<std::int64_t> next_table();
  Result<VolumetricTable> volumetric_of(sqlite::Statement& row);
  // Functions in history.cpp:
  Status insert_action(std::string_view subject, std::int64_t row,
                       const std::optional<HistoryEntry>& action);
  Status insert_reason(std::int64_t action, std::string_view text);
  Result<std::vector<HistoryEntry>> read_actions(sqlite::Statement& rows);
  Status add_detail(HistoryEntry& action);
  // Functions in encoder_data.cpp:
  Result<std::optional<DatumSetting>> read_datum(sqlite::Statement& row);
  Result<std::optional<DatumSetting>> datum(std::int64_t id);
  // Functions in study_write.cpp:
  Status replace_checkpoint(std::int64_t study, const StudyCheckpoint& checkpoint);
  Status insert_outcome(std::int64_t study, const StudyOutcome& outcome);
  // Functions in study_read.cpp:
  Status verify_studies(std::vector<std::string>& findings);
  // Functions in verify.cpp:
  Status verify_ledger(std::vector<std::string>& findings);
  Status verify_file(std::vector<std::string>& findings);
  Status verify_documents(std::vector<std::string>& findings);
  Status verify_runs(std::vector<std::string>& findings);

  WriterLock lock_;  // first member, so that it is destroyed last
  sqlite::Connection connection_;
  Access access_;
  // Run that this object began -> index of the next point.
  std::map<std::int64_t, std::int64_t> open_runs_;
  // For the run of the last call of points(): the stored hash of the run (checked), and row_hash()
  // of each point.
  struct CheckedRows {
    std::int64_t run = 0;
    std::string sha256;
    std::vector<std::uint64_t> rows;
  } checked_;
};

}  // namespace mdof::store
