// One axis: its devices, each with its thread (device/acquisition.h; for devices shared with other
// axes, device/shared_device.h), and its thread "measure-X".
//
//   devices -> queue      measure: queue -> recording (store thread) -> pipeline -> points
//
// Live devices are read from the start, for the view; a replay is read only during a run. The
// thread "resume-X" prepares a run that continues another one; the measure thread then continues
// it.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "daemon/measure/configuration/config.h"
#include "daemon/measure/pipeline.h"
#include "daemon/measure/run_request.h"
#include "daemon/station/device/device_reader.h"
#include "daemon/station/device/shared_device.h"
#include "daemon/station/device/spare_blocks.h"
#include "daemon/station/encoder_zero.h"
#include "daemon/station/recent_range.h"
#include "daemon/storekeeper/storekeeper.h"
#include "schema/base/bounded_queue.h"
#include "schema/notice/notice.h"

namespace mdof::daemon {

// Called on threads of the station or the store; the receiver posts to its own thread.
struct StationEvents {
  std::function<void(std::string json)> live;       // newest instant, for live.update
  std::function<void(std::string json)> run_event;  // for run.event
  // Trouble of a device; `run`: the run in progress, 0: none.
  std::function<void(Axis axis, std::int64_t run, const Trouble&)> trouble;
};

// Called with the id of a run after it is on the disk, or with the error; on a thread of the store
// or the station.
using RunDone = std::function<void(Result<std::int64_t>)>;

// Call it from the main thread only. encoder() and run() are thread-safe.
class Station {
 public:
  // `before`: the last set position of the axis, from before this program started. `shared`: the
  // devices that this axis shares with other stations.
  Station(AxisConfig config, PipelineOptions options, std::string configuration,
          std::filesystem::path recordings, Storekeeper& keeper, StationEvents events,
          std::optional<DatumSetting> before = std::nullopt, SharedDevices* shared = nullptr);
  ~Station();  // an open run ends as aborted
  // Asks the devices to stop without waiting, so that all stations stop at the same time.
  void begin_stopping();

  void start_run(const RunRequest& request, const RunDone& done);
  // `done`: the id of the run to read (see Storekeeper::end_run), after it is on the disk.
  void stop_run(bool abort, const HistoryEntry& action, RunDone done);
  // Sets the present position of the axis. It is valid after it was stored with its user. Errors
  // (conflict): a run is in progress, the axis moves, the encoder sends nothing, or the encoder is
  // that of a log. Other errors: it could not be stored.
  using DatumDone = std::function<void(Result<EncoderDatum>)>;
  void set_encoder(double position_m, const HistoryEntry& action, DatumDone done);
  EncoderState encoder() const { return zero_.state(); }
  // The run in progress; 0: none; -1: a run is about to begin.
  std::int64_t run() const { return shared_->run.load(); }
  // The store can no longer keep this run.
  void storage_failed(std::int64_t run, const Error& error);

  void wake_devices();  // call it when a device was plugged in
  // The interval of live() events; nullopt: none are wanted.
  void watch(std::optional<std::chrono::milliseconds> every) {
    live_every_.store(every.value_or(kNever));
  }
  const AxisConfig& config() const { return config_; }
  std::vector<DeviceStatus> devices() const;
  // Whether all threads have reported within `limit`.
  bool healthy(std::chrono::steady_clock::duration limit) const;

 private:
  struct Beginning;
  // An item for the measure thread, in order: samples or another job.
  struct Samples {
    SampleBlock block;
    std::uint64_t pass;  // number of the reading of a source that is read once per run
  };
  using Job = std::function<void(Station&)>;
  using Item = std::variant<Samples, Job>;
  using Queue = BoundedQueue<Item>;
  struct OpenRun;
  // Data that callbacks of the store may still use after the station was destroyed.
  struct Shared {
    explicit Shared(StationEvents e) : events(std::move(e)), queue(kQueuedBlocks) {}
    StationEvents events;
    std::atomic<std::int64_t> run{0};
    Queue queue;
    SpareBlocks spare;
    void post(Job job) { queue.push_always(std::move(job)); }
  };
  static constexpr std::size_t kQueuedBlocks = 1024;

  // Why nothing can begin on the axis, for a value of shared_->run that is not 0.
  std::string occupied_reason(std::int64_t run) const;
  DeviceSink sink();
  NewRun describe_run(const RunRequest& request, const PipelineOptions& options) const;
  PipelineOptions options_for(const RunRequest& request) const;
  PipelineOptions with_devices(PipelineOptions options) const;
  // `options`: the same for the description and the measurement, so that a replay measures the
  // same.
  using Options = std::shared_ptr<const PipelineOptions>;
  void begin_run(NewRun description, const RunRequest& request, const Options& options,
                 std::shared_ptr<Beginning> beginning, const RunDone& done);
  void resume_run(NewRun description, const RunRequest& request, const Options& options,
                  const RunDone& done);

  void measure();
  void handle(Samples& samples);
  void handle(const Job& job) { job(*this); }
  void take_samples(SampleBlock& block);
  void keep_for_recording(const SampleBlock& block);
  void record();
  bool is_this_pass(std::uint64_t pass) const;
  void source_ended(std::uint64_t pass, const std::string& reason,
                    const drivers::SourceInfo& source);
  void take_trouble(const Trouble& trouble);
  void storage_ended(std::int64_t run, const std::string& reason);
  void end_run(bool abort, const HistoryEntry& action, const RunDone& done);
  void report_unsolved(const std::vector<MeasuredPoint>& points);
  void report_left_out();
  void keep_new_points(const std::vector<MeasuredPoint>& points);
  void attach(std::int64_t run, const RunRequest& request, const Options& options,
              Beginning* beginning, const RunDone& done);
  // station_datum.cpp
  void take_datum(double position_m, const HistoryEntry& action, const DatumDone& done);
  void store_datum(const DatumSetting& setting, const HistoryEntry& action, const DatumDone& done);
  void put_datum(const Result<DatumSetting>& stored, const HistoryEntry& action,
                 const DatumDone& done);
  void take_mark(const std::string& device);
  void end_unless_from_mark();
  void finish(RunState state, Notices why, const drivers::SourceInfo& source = {},
              RunDone done = {}, const std::optional<HistoryEntry>& action = std::nullopt);
  const Pipeline* pipeline() const;
  void note_newest();
  void show_live();
  void watch_range(Pipeline& pipeline);
  std::vector<std::string> present_troubles() const;

  const AxisConfig config_;
  const PipelineOptions options_;
  const std::string configuration_;
  const std::filesystem::path recordings_;
  Storekeeper& keeper_;
  const std::shared_ptr<Shared> shared_;

  static constexpr auto kNever = std::chrono::milliseconds::max();
  std::atomic<std::chrono::milliseconds> live_every_{kNever};
  std::atomic<std::chrono::steady_clock::time_point> measure_turn_;

  EncoderZero zero_;               // changed only by the measure thread
  std::unique_ptr<OpenRun> open_;  // measure thread only
  std::optional<Pipeline> view_;   // measure thread only: between runs
  RecentRange recent_;             // readings of the present pipeline
  std::chrono::steady_clock::time_point last_live_{};
  std::int64_t newest_ns_ = 0;  // time of the newest instant, which arrived at newest_since_
  std::chrono::steady_clock::time_point newest_since_{};
  std::vector<std::unique_ptr<DeviceReader>> acquisitions_;
  std::thread measure_thread_;
  std::atomic<bool> resuming_{false};
  std::thread resume_thread_;
};

}  // namespace mdof::daemon
