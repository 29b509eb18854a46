// The thread "store": the only writer of the database and of recordings. All writing to the disk is
// a job in its queue; the measurement never waits for it.
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

// Data for storing a new run.
struct NewRun {
  RunHeader header;
  std::filesystem::path recording;  // empty: not recorded (a replay)
  RecordingHeader recording_header;
  std::optional<store::RecordingWriter> begun;        // a recording that already has a beginning
  std::optional<HistoryEntry> action = std::nullopt;  // the requesting user
};

// Data for the end of a run besides its result.
struct RunEnding {
  bool differs = false;  // the result differs from the stored points
  std::optional<HistoryEntry> action = std::nullopt;
  std::optional<RunUncertainty> uncertainty = std::nullopt;  // uncertainty of the result's points
};

// The state of the storage. "ok"; "lost": the database, its -wal or -shm, or its chain of hashes
// was deleted, replaced or cut while in use; "damaged": SQLite found damage; "full": the disk
// accepts no data (full or read-only); "held": another program locks the database, and points are
// pending.
struct StorageState {
  std::string state = "ok";
  std::string reason;  // with the remedy
  bool operator==(const StorageState&) const = default;
};

class Storekeeper {
 public:
  struct Options {
    std::filesystem::path database;
    store::Durability durability = store::Durability::full;
    std::chrono::milliseconds commit_interval{50};
    // Longest wait for another program that locks the database. Pending data are then tried again
    // after the same time, which is left for other work.
    std::chrono::milliseconds busy_timeout{1000};
    std::size_t most_waiting = 4096;  // maximum number of pending points
  };
  // Called on the store thread.
  struct Events {
    // Chunks up to `seq` of this run's recording are on the disk.
    std::function<void(std::int64_t run, std::int64_t seq)> recorded;
    // The disk rejected data (full, removed): the run can no longer be kept.
    std::function<void(std::int64_t run, const Error& error)> failed;
    // The state of the storage has changed; see storage().
    std::function<void(const StorageState& now)> storage_changed = nullptr;
    // The head of the chain of hashes has changed; also called once at the start.
    std::function<void(const store::ChainHead& head)> head_changed = nullptr;
  };

  // Opens the database and starts the thread. A database that is readable but not yet writable is
  // also accepted, because its tables must be served; opening is then tried again and again.
  // Otherwise errors as from Store::open: for an unreadable database it is unknown whether a table
  // is active.
  static Result<std::unique_ptr<Storekeeper>> start(const Options& options, Events events);
  // Finishes the queue, writes pending data, and joins the thread.
  ~Storekeeper();

  // Thread-safe from here on. Callbacks run on the store thread.
  using Job = std::function<void(store::Store&)>;
  // False: the queue is full or closing; the job is dropped.
  bool post(Job job);
  // Waits for the result. Errors: those of the job; a full or closing queue; a store that is not
  // writable.
  Result<std::string> run(std::function<Result<std::string>(store::Store&)> job);
  // Errors as from RecordingWriter::create(). The caller may write to it until it belongs to a run.
  Result<store::RecordingWriter> create_recording(const NewRun& run) const;
  bool begin_run(NewRun run, std::function<void(Result<std::int64_t>)> done);
  // `wait`: for a source that can wait; otherwise a full queue drops the blocks and counts them as
  // one.
  bool record(std::int64_t run, std::vector<SampleBlock> blocks, bool wait);
  // If another program locks the database, points and ends wait for its release. Meanwhile the
  // recording contains the samples, and `done` is called after storing. Points beyond
  // `most_waiting`, and all later points of their run, are dropped (`done` gets an error) and
  // counted. They are stored at the end of the run, in a run that supersedes it.
  void append_points(std::int64_t run, std::vector<MeasuredPoint> points,
                     std::function<void(Status)> done);
  // Seals the recording and ends the run. If the result differs from the stored points, these stay,
  // and the complete result is stored as a new run that supersedes the run. `done` gets the id of
  // the run to read.
  void end_run(std::int64_t run, Run result, RunEnding how,
               std::function<void(Result<std::int64_t>)> done);

  StorageState storage() const;
  // Why nothing can be stored: the database is lost, or could not yet be opened for writing. Empty:
  // data can be stored.
  std::string fault() const;
  // Why a run whose measurement has ended is still stored as open; empty: it is not.
  std::string still_open_reason(std::int64_t run) const;
  // The last announced head of the chain of hashes.
  store::ChainHead chain_head() const;
  // Thread-safe. Reports damage that a reader found; the state stays until mdofd ends.
  void note_damage(const std::string& what);
  std::uint64_t dropped_blocks() const { return queue_.dropped(); }
  std::uint64_t dropped_points() const { return dropped_points_.load(); }  // by append_points()
  // Time of the thread's last report, for the watchdog.
  std::chrono::steady_clock::time_point last_turn() const { return last_turn_.load(); }

 private:
  Storekeeper(const Options& options, Events events);
  void open_again();
  void note_full(const Error& error);
  void note_space();
  void set(std::string& which, const std::string& reason);
  void set_unopened(StorageState now);
  void report_change(const StorageState& before);
  void work();
  void commit_recordings();
  void watch_files();
  void watch_database();
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
    bool waiting = false;  // contains blocks that are not yet committed
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
    std::size_t dropped = 0;  // number of its dropped points
  };
  struct Unended {
    std::int64_t run;
    store::RunEnd end;
  };

  std::optional<store::Store> store_;  // nullopt: not yet writable
  const Options options_;
  Events events_;
  std::map<std::int64_t, Recording> recordings_;
  store::FileWatch database_;
  std::chrono::steady_clock::time_point files_watched_{};
  std::chrono::steady_clock::time_point last_open_attempt_{};
  mutable std::mutex fault_mutex_;  // protects the next seven
  std::string lost_, full_, held_, damaged_;
  StorageState unopened_;  // why store_ is missing; "ok": it exists
  store::ChainHead announced_;
  std::map<std::int64_t, std::string> open_reasons_;
  std::int64_t changes_announced_ = -1;  // changes of the database when its head was announced
  std::vector<Unended> unended_;
  std::deque<Points> waiting_points_;  // wait until another program releases the database
  std::size_t waiting_count_ = 0;      // number of points in waiting_points_
  std::deque<Ending> waiting_ends_;    // likewise
  std::chrono::steady_clock::time_point next_try_{};  // time of the next attempt to store pending
                                                      // data
  // Run -> number of its points that were not kept, because the disk rejected one or too many were
  // pending.
  std::map<std::int64_t, std::size_t> incomplete_, overflowed_;
  std::atomic<std::uint64_t> dropped_points_{0};
  BoundedQueue<std::function<void()>> queue_;
  std::atomic<std::chrono::steady_clock::time_point> last_turn_;
  std::thread thread_;
};

}  // namespace mdof::daemon
