#include "daemon/station/station.h"

#include <algorithm>

#include "daemon/measure/configuration/slow_channels.h"
#include "daemon/measure/replay/request_json.h"
#include "daemon/paths.h"
#include "daemon/station/live_json.h"
#include "daemon/station/open_run.h"
#include "daemon/version.h"
#include "daemon/words/error_text.h"
#include "schema/base/thread_start.h"

namespace mdof::daemon {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

bool has_encoder(const SampleBlock& block) {
  return std::any_of(block.channels.begin(), block.channels.end(),
                     [](const Channel& channel) { return channel.id == kEncoderChannel; });
}

std::string file_stamp(std::string utc) {
  std::erase_if(utc, [](char c) { return c == ':' || c == '-' || c == '.'; });
  return utc;
}

// The columns of a script are known only when it runs. Adds a trouble to the first script if all
// devices were open and none of them provides a channel of the rig.
void add_missing_channel(const AxisConfig& config, std::vector<DeviceStatus>& devices) {
  const std::vector<ChannelSource> sources = open_sources(devices);
  const auto unknown = [](const ChannelSource& source) { return source.channels.empty(); };
  if (std::any_of(sources.begin(), sources.end(), unknown)) return;
  const Status complete = check_all_channels(config.rig, sources);
  for (std::size_t i = 0; !complete && i < devices.size(); ++i) {
    if (!config.devices[i].channels.empty()) continue;
    std::string columns;
    for (const std::string& channel : sources[i].channels)
      columns += (columns.empty() ? "" : ", ") + channel;
    devices[i].standing.push_back(
        {Trouble::Kind::missing, sources[i].device,
         complete.error().message + " (channels of this device: " + columns + ")", ""});
    return;
  }
}

}  // namespace

Station::Station(AxisConfig config, PipelineOptions options, std::string configuration,
                 std::filesystem::path recordings, Storekeeper& keeper, StationEvents events,
                 std::optional<DatumSetting> before, SharedDevices* shared)
    : config_(std::move(config)),
      options_(std::move(options)),
      configuration_(std::move(configuration)),
      recordings_(std::move(recordings)),
      keeper_(keeper),
      shared_(std::make_shared<Shared>(std::move(events))),
      measure_turn_(steady_clock::now()),
      zero_(config_.devices, config_.live() ? std::move(before) : std::nullopt,
            config_.rig.encoder_um_per_V) {
  SharedDevices alone;
  for (const auto& device : config_.devices)
    acquisitions_.push_back(device.part.empty() ? std::make_unique<Acquisition>(device, sink())
                                                : (shared ? *shared : alone).part(device, sink()));
  measure_thread_ = std::thread([this] { measure(); });
  if (!config_.live()) return;
  for (auto& acquisition : acquisitions_) acquisition->start();
}

void Station::begin_stopping() {
  resuming_ = false;
  if (!config_.live()) return;
  for (auto& acquisition : acquisitions_) acquisition->request_stop();
}

Station::~Station() {
  begin_stopping();
  if (resume_thread_.joinable()) resume_thread_.join();
  if (config_.live())
    for (auto& acquisition : acquisitions_) acquisition->stop();
  shared_->queue.close();
  // The thread ends a run in progress. After the thread has ended, no thread starts or stops a
  // device.
  measure_thread_.join();
  acquisitions_.clear();
}

// The functions that the threads of the devices call.
DeviceSink Station::sink() {
  DeviceSink sink;
  sink.samples = [this](SampleBlock& block, std::uint64_t pass, milliseconds wait) {
    // Frames have the times of the encoder samples. Therefore only blocks with encoder samples wake
    // the measure thread.
    const auto wake = has_encoder(block) ? Queue::Wake::yes : Queue::Wake::no;
    SampleBlock spare = shared_->spare.take(block.device);
    Item item(Samples{std::move(block), pass});
    const bool pushed = shared_->queue.push_for(item, wait, wake);
    block = pushed ? std::move(spare) : std::move(std::get<Samples>(item).block);
    return pushed;
  };
  sink.ended = [this](std::uint64_t pass, const std::string& reason,
                      const drivers::SourceInfo& source) {
    shared_->post([=](Station& s) { s.source_ended(pass, reason, source); });
  };
  sink.trouble = [this](const Trouble& trouble) {
    // The trouble is added to the run first. A client that receives the trouble and then stops the
    // run finds the trouble in the run.
    shared_->post([=](Station& s) { s.take_trouble(trouble); });
    shared_->events.trouble(config_.rig.axis, run(), trouble);
  };
  sink.mark = [this](const std::string& device) {
    shared_->post([=](Station& s) { s.take_mark(device); });
  };
  return sink;
}

// ---- functions on the main thread ----

PipelineOptions Station::options_for(const RunRequest& request) const {
  PipelineOptions options = with_devices(options_);
  options.sequence.targets_m = request.targets_m;
  options.repeats = request.repeats;
  options.datum = zero_.datum();
  return options;
}

// Adds the delays of the channels and the current sampling rates of the devices. Some devices state
// their rate only when they are open; for others the measured rate is used.
PipelineOptions Station::with_devices(PipelineOptions options) const {
  options = with_delays(std::move(options), config_.rig, config_.delays);
  std::vector<drivers::DeviceInfo> infos;
  for (const auto& device : devices()) {
    infos.push_back(device.info);
    if (device.info.rate_hz == 0) infos.back().rate_hz = device.measured_hz;
  }
  if (infos.size() > 1 || !options.align.delay_s.empty())
    options.align = with_intervals(std::move(options.align), infos);
  return options;
}

NewRun Station::describe_run(const RunRequest& request, const PipelineOptions& options) const {
  NewRun run;
  run.action = request.action;
  RunHeader& h = run.header;
  if (request.resumes) h.supersedes = request.resumes->id;
  h.axis = config_.rig.axis;
  h.sides = config_.rig.sides;
  h.simulated = config_.simulated();
  h.started_utc = utc_now();
  h.start_known = config_.recorded();
  h.note = request.note;
  h.provenance.rig_text = config_.rig.text;
  h.provenance.model = to_string(options.model);
  h.provenance.software_version = kVersion;
  h.provenance.options_json = options.json();
  h.provenance.configuration = configuration_;
  if (!config_.recorded()) {
    h.provenance.recording_kind = "replay";
    h.provenance.recording_path = config_.devices.front().source_path;
    return run;
  }
  run.recording = recordings_ / (file_stamp(h.started_utc) + "-" + letter(h.axis) + ".mdofrec");
  h.provenance.recording_kind = "recording";
  h.provenance.recording_path = std::filesystem::absolute(run.recording).string();
  run.recording_header = {kVersion,
                          config_.rig.text,
                          devices_json(devices()),
                          configuration_,
                          h.started_utc,
                          h.simulated,
                          request_json({request.note, request.notices, options})};
  return run;
}

std::string Station::occupied_reason(std::int64_t run) const {
  const std::string of = std::string("a run of axis ") + letter(config_.rig.axis);
  if (run < 0) return of + " is about to begin, or the axis position is being stored; try again";
  if (const std::string why = keeper_.still_open_reason(run); !why.empty())
    return of + " (run " + std::to_string(run) + ") has ended; " + why;
  return of + " is under way; stop this run first";
}

void Station::start_run(const RunRequest& request, const RunDone& done) {
  if (request.resumes) {
    const bool counts_on = zero_.has_counted_since(request.resumes->id);
    const Status same = check_same_datum(*request.resumes, zero_.datum(), counts_on);
    if (!same) return done(tl::unexpected(same.error()));
    const Status alike = check_same_settings(*request.resumes, options_for(request));
    if (!alike) return done(tl::unexpected(alike.error()));
  }
  std::int64_t none = 0;
  if (!shared_->run.compare_exchange_strong(none, -1)) {
    return done(fail(ErrorCode::conflict, occupied_reason(none)));
  }
  const auto options = std::make_shared<const PipelineOptions>(options_for(request));
  NewRun description = describe_run(request, *options);
  if (!request.resumes) return begin_run(std::move(description), request, options, nullptr, done);
  if (resume_thread_.joinable()) resume_thread_.join();
  resuming_ = true;
  auto shared = std::make_shared<NewRun>(std::move(description));
  resume_thread_ = std::thread([this, shared, request, options, done] {
    resume_run(std::move(*shared), request, options, done);
  });
}

// Runs on the thread "resume-X".
void Station::resume_run(NewRun description, const RunRequest& request, const Options& options,
                         const RunDone& done) {
  start_thread_as(std::string("resume-") + letter(config_.rig.axis));
  const auto ready = [&]() -> Result<std::shared_ptr<Beginning>> {
    MDOF_TRY(auto pipeline, Pipeline::create(config_.rig, *options));
    auto beginning = std::make_shared<Beginning>(Beginning{std::move(pipeline), 0});
    MDOF_TRY(beginning->end_ns,
             record_again(*request.resumes, keeper_, description, beginning->pipeline, resuming_));
    return beginning;
  }();
  if (ready) return begin_run(std::move(description), request, options, *ready, done);
  shared_->run = 0;
  done(tl::unexpected(ready.error()));
}

void Station::begin_run(NewRun description, const RunRequest& request, const Options& options,
                        std::shared_ptr<Beginning> beginning, const RunDone& done) {
  const bool posted = keeper_.begin_run(
      std::move(description), [shared = shared_, request, options, beginning = std::move(beginning),
                               done](const Result<std::int64_t>& id) {
        if (!id) {
          shared->run = 0;
          return done(id);
        }
        shared->post([run = *id, request, options, beginning, done](Station& s) {
          s.attach(run, request, options, beginning.get(), done);
        });
      });
  if (posted) return;
  shared_->run = 0;
  done(io_error("too many writes to the database are pending; try again"));
}

void Station::stop_run(bool abort, const HistoryEntry& action, RunDone done) {
  if (shared_->run <= 0) {
    return done(fail(ErrorCode::not_found,
                     std::string("no run of axis ") + letter(config_.rig.axis) + " is under way"));
  }
  shared_->post(
      [abort, action, done = std::move(done)](Station& s) { s.end_run(abort, action, done); });
}

void Station::storage_failed(std::int64_t run, const Error& error) {
  shared_->post([run, reason = words::text(error)](Station& s) { s.storage_ended(run, reason); });
}

void Station::wake_devices() {
  for (auto& acquisition : acquisitions_) acquisition->wake();
}

std::vector<DeviceStatus> Station::devices() const {
  std::vector<DeviceStatus> all;
  for (const auto& acquisition : acquisitions_) all.push_back(acquisition->status());
  add_missing_channel(config_, all);
  return all;
}

std::vector<ChannelSource> open_sources(const std::vector<DeviceStatus>& devices) {
  std::vector<ChannelSource> sources;
  for (const DeviceStatus& device : devices) {
    sources.push_back({device.info.name, {}});
    for (const Channel& channel : device.info.channels)
      sources.back().channels.push_back(channel.id);
  }
  return sources;
}

bool Station::healthy(steady_clock::duration limit) const {
  const auto acquires = [&](const auto& acquisition) { return acquisition->healthy(limit); };
  return std::all_of(acquisitions_.begin(), acquisitions_.end(), acquires) &&
         steady_clock::now() - measure_turn_.load() < limit;
}

}  // namespace mdof::daemon
