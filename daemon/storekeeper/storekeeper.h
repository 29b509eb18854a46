// The thread "store": the one writer of the database and of recordings. Everything that touches the
// disk for writing is a job in its queue; the measuring path never waits for it.
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

// What a run that is being measured needs on the disk.
struct NewRun {
  RunHeader header;
  std::filesystem::path recording;  // empty: not recorded (a replay)
  RecordingHeader recording_header;
  std::optional<store::RecordingWriter> begun;        // a recording that has a beginning already
  std::optional<HistoryEntry> action = std::nullopt;  // who asked for it
};

// How a run ends, beside its result.
struct RunEnding {
  bool differs = false;  // from the points already stored
  std::optional<HistoryEntry> action = std::nullopt;
  std::optional<RunUncertainty> uncertainty = std::nullopt;  // of the result's points
};

// How it is with storing: "ok"; "lost": the database, its -wal or -shm was deleted, replaced or cut
// short under us, or its chain of hashes was; "damaged": SQLite found damage in it;
// "full": the disk takes nothing (it is full, or may not be written); "held": a foreign program
// holds the database, and points wait.
struct StorageState {
  std::string state = "ok";
  std::string reason;  // and the remedy
  bool operator==(const StorageState&) const = default;
};

class Storekeeper {
 public:
  struct Options {
    std::filesystem::path database;
    store::Durability durability = store::Durability::full;
    std::chrono::milliseconds commit_interval{50};
    // For a foreign program that holds the database, each time; what can wait is then tried again,
    // after as long a time for all other work.
    std::chrono::milliseconds busy_timeout{1000};
    std::size_t most_waiting = 4096;  // points, meanwhile
  };
  // All called on the store thread.
  struct Events {
    // Chunks up to `seq` of this run's recording are on the disk.
    std::function<void(std::int64_t run, std::int64_t seq)> recorded;
    // The disk refused (full, gone): the run can no longer be kept.
    std::function<void(std::int64_t run, const Error& error)> failed;
    // The database is not what it was any more, or is again; see storage().
    std::function<void(const StorageState& now)> storage_changed = nullptr;
    // The chain of hashes has another head; also once at the start.
    std::function<void(const store::ChainHead& head)> head_changed = nullptr;
  };

  // Opens the database and starts the thread. One that can be read but not written now is taken as
  // well, since tables are to be served: it is opened again and again. Else errors as Store::open:
  // what cannot be read could be anything, and "no table is active" must not be a guess.
  static Result<std::unique_ptr<Storekeeper>> start(const Options& options, Events events);
  // Ends the queue, writes out what waits, joins.
  ~Storekeeper();

  // Thread-safe from here on. Callbacks run on the store thread.
  using Job = std::function<void(store::Store&)>;
  // False: the queue is full or closing; the job is not kept.
  bool post(Job job);
  // Waits for its result. Errors: those of the job, a full or closing queue, no store to write to.
  Result<std::string> run(std::function<Result<std::string>(store::Store&)> job);
  // Errors as RecordingWriter::create(). Whoever calls it may write until it is a run's.
  Result<store::RecordingWriter> create_recording(const NewRun& run) const;
  bool begin_run(NewRun run, std::function<void(Result<std::int64_t>)> done);
  // `wait`: for a source that can wait; otherwise a full queue drops the blocks, counted as one.
  bool record(std::int64_t run, std::vector<SampleBlock> blocks, bool wait);
  // Where a foreign program holds the database, points and ends wait until it is released: the
  // recording has them meanwhile, and `done` comes when they are stored. Points beyond
  // `most_waiting`, and all later ones of their run, are dropped (`done`: an error) and counted:
  // they are stored when the run ends, as in a run that supersedes it.
  void append_points(std::int64_t run, std::vector<MeasuredPoint> points,
                     std::function<void(Status)> done);
  // Seals the recording and ends the run. If the result differs from the points already stored,
  // they stay, and the whole result is stored as a new run that supersedes them; gives the id to
  // read.
  void end_run(std::int64_t run, Run result, RunEnding how,
               std::function<void(Result<std::int64_t>)> done);

  StorageState storage() const;
  // Why nothing can be stored: the database is lost, or could not be opened for writing yet. Empty:
  // it can.
  std::string fault() const;
  // Why a run whose measuring has ended stands as open; empty: it does not.
  std::string why_open(std::int64_t run) const;
  // The head of the chain of hashes, as announced last.
  store::ChainHead chain_head() const;
  // Thread-safe: a reader found damage in the database. Says so until mdofd ends.
  void note_damage(const std::string& what);
  std::uint64_t dropped_blocks() const { return queue_.dropped(); }
  std::uint64_t dropped_points() const { return dropped_points_.load(); }  // of append_points()
  // When the thread last came round; for the watchdog.
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
  Result<std::int64_t> begin_or_clear(NewRun& run);
  struct Points;
  struct Ending;
  struct Unended;
  void take(Points points);
  void take(Ending ending);
  void seal(Ending& ending);
  Result<std::int64_t> end(Ending& ending);
  void wait_for_database(Points points);
  void drop(const Points& points);
  std::size_t dropped_of(std::int64_t run);
  void wait_for_database(Ending ending);
  void explain(std::int64_t run, const std::string& why);
  void refused_end(Unended unended, const Error& error);
  void try_later();
  void store_waiting_items();
  void discard_waiting_items();
  Status end_or_wait(std::int64_t run, const store::RunEnd& end);

  struct Recording {
    store::RecordingWriter writer;
    store::FileWatch file;
    bool waiting = false;  // holds blocks that are not committed yet
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
    std::size_t dropped = 0;  // points of it
  };
  struct Unended {
    std::int64_t run;
    store::RunEnd end;
  };

  std::optional<store::Store> store_;  // none: it cannot be written yet
  const Options options_;
  Events events_;
  std::map<std::int64_t, Recording> recordings_;
  store::FileWatch database_;
  std::chrono::steady_clock::time_point files_watched_{};
  std::chrono::steady_clock::time_point tried_{};
  mutable std::mutex fault_mutex_;  // guards the next seven
  std::string lost_, full_, held_, damaged_;
  StorageState unopened_;  // why there is no store_ yet; "ok": there is one
  store::ChainHead announced_;
  std::map<std::int64_t, std::string> open_because_;
  std::int64_t changes_announced_ = -1;  // of the database, when its head was announced
  std::vector<Unended> unended_;
  std::deque<Points> waiting_points_;  // for a foreign program to release the database
  std::size_t waiting_count_ = 0;      // points in them
  std::deque<Ending> waiting_ends_;    // for the same
  std::chrono::steady_clock::time_point next_try_{};  // to store what waits
  // Run -> points of it that were not kept: the disk refused one, or too many waited.
  std::map<std::int64_t, std::size_t> incomplete_, overflowed_;
  std::atomic<std::uint64_t> dropped_points_{0};
  BoundedQueue<std::function<void()>> queue_;
  std::atomic<std::chrono::steady_clock::time_point> last_turn_;
  std::thread thread_;
};

}  // namespace mdof::daemon
