// One axis at work: its device's thread "acquire-X" and its thread "measure-X".
//
//   acquire: driver -> queue      measure: queue -> recording (store thread) -> pipeline -> points
//
// A live device is read from the start, for the view; a replay only while a run is under way.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "daemon/bounded_queue.h"
#include "daemon/config.h"
#include "daemon/pipeline.h"
#include "daemon/storekeeper.h"

namespace mdof::daemon {

// A run as it was asked for.
struct RunRequest {
  std::string note;
  std::vector<double> targets_m;  // empty: recognised
  int repeats = 0;                // 0: until stopped; else complete after so many, both ways
};

struct DeviceStatus {
  std::string state = "closed";  // "open", "closed", "failed: reopening", "ended"
  std::string error;             // of the last failure
  drivers::DeviceInfo info;
  std::uint64_t scans = 0;    // since the start
  std::uint64_t dropped = 0;  // blocks the measuring thread had no room for
  std::uint64_t reopened = 0;
};

// Called on the station's or the store's threads; the receiver posts to its own.
struct StationEvents {
  std::function<void(std::string json)> live;       // newest instant, for live.update
  std::function<void(std::string json)> run_event;  // for run.event
};

// Told the id of a run, once it is on the disk, or why there is none; on the store's or a station's
// thread.
using RunDone = std::function<void(Result<std::int64_t>)>;

// Calls from the main thread only, but for status().
class Station {
 public:
  Station(AxisConfig config, PipelineOptions options, std::string configuration,
          std::filesystem::path recordings, Storekeeper& keeper, StationEvents events);
  ~Station();  // an open run ends as aborted

  void start_run(const RunRequest& request, const RunDone& done);
  // `done`: the id of the run to read (see Storekeeper::end_run), once it is on the disk.
  void stop_run(bool abort, RunDone done);
  // The run under way: 0 none, -1 about to begin.
  std::int64_t run() const { return shared_->run.load(); }
  // The store gave up on this run.
  void storage_failed(std::int64_t run, const Error& error);

  void watch(bool wanted) { watched_.store(wanted); }  // whether live() is worth its work
  const AxisConfig& config() const { return config_; }
  DeviceStatus status() const;
  // Both threads came round within `limit`.
  bool healthy(std::chrono::steady_clock::duration limit) const;

 private:
  struct Item {
    enum class Kind { samples, ended, attach, stop, storage_failed } kind = Kind::samples;
    SampleBlock block;
    std::int64_t run = 0;
    RunRequest request;
    bool abort = false;
    std::string reason;
    drivers::SourceInfo source;
    std::uint64_t pass = 0;  // of a source that is read once a run
    RunDone done;
  };
  struct OpenRun;
  // What the store's callbacks may still need when the station itself has gone.
  struct Shared {
    explicit Shared(StationEvents e) : events(std::move(e)), queue(kQueuedBlocks) {}
    StationEvents events;
    std::atomic<std::int64_t> run{0};
    BoundedQueue<Item> queue;
  };
  static constexpr std::size_t kQueuedBlocks = 1024;

  void start_acquiring();
  void stop_acquiring();
  void acquire(std::uint64_t pass);
  bool read_until_trouble(drivers::Driver& driver, std::uint64_t pass);
  void set_state(const std::string& state, const std::string& error = "");
  NewRun describe_run(const RunRequest& request) const;

  void measure();
  void handle(Item& item);
  void take_samples(SampleBlock& block);
  bool of_this_pass(const Item& item) const;
  void keep_new_points(const std::vector<MeasuredPoint>& points);
  void attach(Item& item);
  void finish(RunState state, const std::string& why, const drivers::SourceInfo& source,
              RunDone done);
  void show_live();

  const AxisConfig config_;
  const PipelineOptions options_;
  const std::string configuration_;
  const std::filesystem::path recordings_;
  Storekeeper& keeper_;
  const std::shared_ptr<Shared> shared_;

  std::atomic<bool> watched_{false}, acquiring_{false};
  std::atomic<std::chrono::steady_clock::time_point> acquire_turn_, measure_turn_;
  mutable std::mutex status_mutex_;
  DeviceStatus status_;  // guarded by status_mutex_

  std::unique_ptr<OpenRun> open_;  // measure thread only
  std::optional<Pipeline> view_;   // measure thread only: between runs
  std::chrono::steady_clock::time_point last_live_{};
  std::uint64_t pass_ = 0;  // readings begun; by whoever calls start_acquiring()
  std::thread acquire_thread_, measure_thread_;
};

}  // namespace mdof::daemon
