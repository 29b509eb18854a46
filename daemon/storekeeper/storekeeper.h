// The thread "store". Only this thread writes to the database and to recordings. Each write is a
// job in the queue of the thread. The measurement does not wait for writes.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "daemon/store/file/file_watch.h"
#include "daemon/store/recording_writer.h"
#include "daemon/store/store.h"
#include "schema/base/bounded_queue.h"
#include "schema/base/result.h"
#include "schema/run.h"
#include "schema/sample.h"

namespace mdof::daemon {

// Data of a new run.
struct NewRun {
  RunHeader header;
  std::filesystem::path recording;  // empty: the run is not recorded (a replay)
  RecordingHeader recording_header;
  // The recording if it exists already, with the samples of a continued run.
  std::optional<store::RecordingWriter> begun;
  std::optional<HistoryEntry> action = std::nullopt;  // the requesting user
};

// Further data for the end of a run.
struct RunEnding {
  bool differs = false;  // true: the points of the result differ from the stored points
  std::optional<HistoryEntry> action = std::nullopt;
  // Uncertainty of the points of the result.
  std::optional<RunUncertainty> uncertainty = std::nullopt;
};

// The state of the storage:
//   ok
//   lost: a file of the database (also -wal, -shm) or its chain of hashes was deleted, replaced
//     or cut while mdofd used it
//   damaged: SQLite has found damage in the file
//   full: the disk accepts no data (it is full or read-only)
//   held: another program locks the database, and data are pending
struct StorageState {
  std::string state = "ok";
  std::string reason;  // cause and remedy; empty if the state is "ok"
  bool operator==(const StorageState&) const = default;
};

class Storekeeper {
 public:
  struct Options {
    std::filesystem::path database;
    store::Durability durability = store::Durability::full;
    std::chrono::milliseconds commit_interval{50};
    // Longest time that a write waits while another program locks the database. After the same
    // time, the thread tries to write the pending data again. In between, the thread does other
    // work.
    std::chrono::milliseconds busy_timeout{1000};
    std::size_t max_pending_points = 4096;  // maximum number of pending points
  };
  // Functions that the thread "store" calls.
  struct Events {
    // The chunks of the recording of this run, up to number `seq`, are on the disk.
    std::function<void(std::int64_t run, std::int64_t seq)> recorded;
    // The disk rejected data of the run (disk full, file removed). The run cannot continue.
    std::function<void(std::int64_t run, const Error& error)> failed;
    // The state of the storage has changed; see storage().
    std::function<void(const StorageState& now)> storage_changed = nullptr;
    // The head of the chain of hashes has changed. Also called once at the start.
    std::function<void(const store::ChainHead& head)> head_changed = nullptr;
  };

  // Opens the database and starts the thread. If the database can be read but not written, start()
  // succeeds too, because mdofd must serve the active tables; the thread then tries to open the
  // database for writing again and again. If the database cannot be read, it is unknown whether a
  // table is active. Errors: those of Store::open.
  static Result<std::unique_ptr<Storekeeper>> start(const Options& options, Events events);
  // Processes the jobs in the queue, writes pending data, and joins the thread.
  ~Storekeeper();

  // The following functions are thread-safe. Their callbacks run on the thread "store".
  using Job = std::function<void(store::Store&)>;
  // Adds a job to the queue. False: the queue is full or closed, and the job will not run.
  bool post(Job job);
  // Adds a job and waits for its result. Errors: those of the job; the queue is full or closed; the
  // database cannot be written.
  Result<std::string> run(std::function<Result<std::string>(store::Store&)> job);
  // Creates a recording. The caller may write to it before begin_run(). Errors: those of
  // RecordingWriter::create().
  Result<store::RecordingWriter> create_recording(const NewRun& run) const;
  bool begin_run(NewRun run, std::function<void(Result<std::int64_t>)> done);
  // Adds the blocks to the recording of the run. `wait`: true if the source of the samples can wait
  // for space in the queue. If `wait` is false and the queue is full, the blocks are lost;
  // dropped_blocks() counts the call once.
  bool record(std::int64_t run, std::vector<SampleBlock> blocks, bool wait);
  // Stores points of a run, then calls `done`. If another program locks the database, the points
  // are pending until that program releases the database; the recording contains their samples. If
  // more than `max_pending_points` points are pending, these points and all later points of the run
  // are dropped: `done` receives an error, and dropped_points() counts these points. At the end of
  // the run, all points are stored in a new run that supersedes the run.
  void append_points(std::int64_t run, std::vector<MeasuredPoint> points,
                     std::function<void(Status)> done);
  // Seals the recording and ends the run. If the result differs from the stored points, the stored
  // points do not change; the complete result is stored as a new run that supersedes the run.
  // `done` receives the id of the run to read.
  void end_run(std::int64_t run, Run result, RunEnding how,
               std::function<void(Result<std::int64_t>)> done);

  StorageState storage() const;
  // The reason why no data can be stored: the database is lost, or it could not be opened for
  // writing yet. Empty: data can be stored.
  std::string fault() const;
  // The reason why the stored state of a run is still "open" although its measurement has ended.
  // Empty: the end of the run is stored, or the run is in progress.
  std::string still_open_reason(std::int64_t run) const;
  // The last announced head of the chain of hashes.
  store::ChainHead chain_head() const;
  // Reports damage of the database that a reader has found. The state "damaged" stays until mdofd
  // ends. Thread-safe.
  void note_damage(const std::string& what);
  std::uint64_t dropped_blocks() const { return queue_.dropped(); }
  // Number of points that append_points() dropped.
  std::uint64_t dropped_points() const { return dropped_points_.load(); }
  // Time of the last report of the thread, for the watchdog.
  std::chrono::steady_clock::time_point last_turn() const { return last_turn_.load(); }

 private:
  Storekeeper(const Options& options, Events events);
  void open_again();
  void note_full(const Error& error);
  void clear_full_state();
  void set(std::string& which, const std::string& reason);
  void set_unopened(StorageState now);
  void report_change(const StorageState& before);
  void work();
  void commit_recordings();
  void check_storage_if_due();
  void check_database();
  std::string chain_fault();
  void begin_chain();
  void announce_head();
  void end_finished_runs();
  Result<std::int64_t> begin(NewRun& run);
  Result<std::int64_t> begin_or_remove(NewRun& run);
  struct Points;
  struct Ending;
  struct Unended;
  void take(Points points);
  void take(Ending ending);
  void seal(Ending& ending);
  Result<std::int64_t> end(Ending& ending);
  void wait_for_database(Points points);
  void drop(const Points& points);
  std::size_t take_dropped_count(std::int64_t run);
  void wait_for_database(Ending ending);
  void explain(std::int64_t run, const std::string& why);
  void keep_rejected_end(Unended unended, const Error& error);
  void try_later();
  void store_waiting_items();
  void discard_waiting_items();
  Status end_or_wait(std::int64_t run, const store::RunEnd& end);

  struct Recording {
    store::RecordingWriter writer;
    store::FileWatch file;
    bool waiting = false;  // true: some blocks are not committed yet
  };

  Status commit(std::int64_t run, Recording& recording);
  Status keep_points(std::int64_t run, const std::vector<MeasuredPoint>& points);

  struct Points {
    std::int64_t run;
    std::vector<MeasuredPoint> points;
    std::function<void(Status)> done;
  };
  struct Ending {
    std::int64_t run;
    Run result;
    RunEnding how;
    std::function<void(Result<std::int64_t>)> done;
    std::size_t dropped = 0;  // number of dropped points of the run
  };
  struct Unended {
    std::int64_t run;
    store::RunEnd end;
  };

  std::optional<store::Store> store_;  // nullopt: the database could not be opened for writing yet
  const Options options_;
  Events events_;
  std::map<std::int64_t, Recording> recordings_;
  store::FileWatch database_;
  std::chrono::steady_clock::time_point files_watched_{};
  std::chrono::steady_clock::time_point last_open_attempt_{};
  mutable std::mutex fault_mutex_;  // protects the next seven members
  std::string lost_, full_, held_, damaged_;
  StorageState unopened_;  // reason why store_ is nullopt; "ok" if store_ exists
  store::ChainHead announced_;
  std::map<std::int64_t, std::string> open_reasons_;
  // Value of store_->changes() when the head was announced last.
  std::int64_t changes_announced_ = -1;
  std::vector<Unended> unended_;
  std::deque<Points> waiting_points_;  // pending until another program releases the database
  std::size_t waiting_count_ = 0;      // number of points in waiting_points_
  std::deque<Ending> waiting_ends_;    // ends of runs that are pending for the same reason
  // Time of the next attempt to store pending data.
  std::chrono::steady_clock::time_point next_try_{};
  // Run -> number of points of the run that were not stored. incomplete_: because the disk rejected
  // a point. overflowed_: because too many points were pending.
  std::map<std::int64_t, std::size_t> incomplete_, overflowed_;
  std::atomic<std::uint64_t> dropped_points_{0};
  BoundedQueue<std::function<void()>> queue_;
  std::atomic<std::chrono::steady_clock::time_point> last_turn_;
  std::thread thread_;
};

}  // namespace mdof::daemon
