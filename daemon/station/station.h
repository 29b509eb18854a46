// A station measures one axis. Each of its devices has a thread (device/acquisition.h, or
// device/shared_device.h for devices that several axes share). The thread "measure-X" processes the
// samples.
//
//   devices -> queue      measure: queue -> recording (store thread) -> pipeline -> points
// Live devices are read from the start of mdofd, for the live view. A replay is read only during a
// run. If a run continues another run, the thread "resume-X" measures the recording of the other
// run first. Then the measure thread measures the new samples.
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
#include "daemon/measure/configuration/sources.h"
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

// Functions that the station calls, on threads of the station or of the store.
struct StationEvents {
  std::function<void(std::string json)> live;       // message for the topic live.update
  std::function<void(std::string json)> run_event;  // message for the topic run.event
  // A trouble of a device. `run`: the run in progress; 0: no run.
  std::function<void(Axis axis, std::int64_t run, const Trouble&)> trouble;
};

// Called with the id of a run when the run is on the disk, or with the error. Runs on a thread of
// the store or of the station.
using RunDone = std::function<void(Result<std::int64_t>)>;

// Use this class on the main thread only. encoder() and run() are thread-safe.
class Station {
 public:
  // `before`: the axis position that a user set last, before this program started. `shared`: the
  // devices that this axis shares with other axes.
  Station(AxisConfig config, PipelineOptions options, std::string configuration,
          std::filesystem::path recordings, Storekeeper& keeper, StationEvents events,
          std::optional<DatumSetting> before = std::nullopt, SharedDevices* shared = nullptr);
  ~Station();  // a run in progress gets the state "aborted"
  // Asks the devices to stop and does not wait. All stations can then stop at the same time.
  void begin_stopping();

  void start_run(const RunRequest& request, const RunDone& done);
  // When the run is on the disk, calls `done` with the id of the run to read (see
  // Storekeeper::end_run).
  void stop_run(bool abort, const HistoryEntry& action, RunDone done);
  // Sets the current position of the axis. The position becomes valid when it is stored, with the
  // user who set it. Errors (conflict): a run is in progress, the axis moves, the encoder sends no
  // samples, or the axis is read from a log. Other errors: the position could not be stored.
  using DatumDone = std::function<void(Result<EncoderDatum>)>;
  void set_encoder(double position_m, const HistoryEntry& action, DatumDone done);
  EncoderState encoder() const { return zero_.state(); }
  // The run in progress. 0: no run. -1: a run is about to begin, or the position is being stored.
  std::int64_t run() const { return shared_->run.load(); }
  // Ends this run as failed, because the store cannot store its data.
  void storage_failed(std::int64_t run, const Error& error);

  void wake_devices();  // call this function when a device was plugged in
  // The interval between two live() events. nullopt: no live events are sent.
  void watch(std::optional<std::chrono::milliseconds> every) {
    live_every_.store(every.value_or(kNever));
  }
  const AxisConfig& config() const { return config_; }
  std::vector<DeviceStatus> devices() const;
  // Whether all threads have reported within `limit`.
  bool healthy(std::chrono::steady_clock::duration limit) const;

 private:
  struct Beginning;
  // An item in the queue of the measure thread: samples or a job. Items are processed in order.
  struct Samples {
    SampleBlock block;
    std::uint64_t pass;  // as in DeviceSink
  };
  using Job = std::function<void(Station&)>;
  using Item = std::variant<Samples, Job>;
  using Queue = BoundedQueue<Item>;
  struct OpenRun;
  // Data that callbacks of the store can still use after the station is destroyed.
  struct Shared {
    explicit Shared(StationEvents e) : events(std::move(e)), queue(kQueuedBlocks) {}
    StationEvents events;
    std::atomic<std::int64_t> run{0};
    Queue queue;
    SpareBlocks spare;
    void post(Job job) { queue.push_always(std::move(job)); }
  };
  static constexpr std::size_t kQueuedBlocks = 1024;

  // The reason why no run can begin on the axis. `run`: value of shared_->run, not 0.
  std::string occupied_reason(std::int64_t run) const;
  DeviceSink sink();
  NewRun describe_run(const RunRequest& request, const PipelineOptions& options) const;
  PipelineOptions options_for(const RunRequest& request) const;
  PipelineOptions with_devices(PipelineOptions options) const;
  // The description of the run and its measurement use the same options object. A replay therefore
  // uses the options of the measurement.
  using Options = std::shared_ptr<const PipelineOptions>;
  void begin_run(NewRun description, const RunRequest& request, const Options& options,
                 std::shared_ptr<Beginning> beginning, const RunDone& done);
  void resume_run(NewRun description, const RunRequest& request, const Options& options,
                  const RunDone& done);

  void measure();
  void handle(Samples& samples);
  void handle(const Job& job) { job(*this); }
  void take_samples(SampleBlock& block);
  void record_if_due();
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
  // Functions in station_datum.cpp:
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
  double age_s(std::chrono::steady_clock::time_point now) const;
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

  EncoderZero zero_;               // only the measure thread changes it
  std::unique_ptr<OpenRun> open_;  // measure thread only
  std::optional<Pipeline> view_;   // live view between runs; measure thread only
  RecentRange recent_;             // readings of the current pipeline
  std::chrono::steady_clock::time_point last_live_{};
  std::int64_t newest_ns_ = 0;  // time of the newest frame; it arrived at newest_since_
  std::chrono::steady_clock::time_point newest_since_{};
  std::vector<std::unique_ptr<DeviceReader>> acquisitions_;
  std::thread measure_thread_;
  std::atomic<bool> resuming_{false};
  std::thread resume_thread_;
};

// The channels of the devices that are or were open.
std::vector<ChannelSource> open_sources(const std::vector<DeviceStatus>& devices);

}  // namespace mdof::daemon
