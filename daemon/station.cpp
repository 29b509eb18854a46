#include "daemon/station.h"

#include <pthread.h>

#include <algorithm>

#include "daemon/live_json.h"
#include "daemon/open_run.h"
#include "daemon/paths.h"
#include "daemon/version.h"

namespace mdof::daemon {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kReadTimeout{100};
constexpr milliseconds kFirstBackoff{50}, kLongestBackoff{2000};

void name_thread(const char* role, Axis axis) {
  const std::string name = std::string(role) + "-" + letter(axis);
  pthread_setname_np(pthread_self(), name.c_str());
}

std::string file_stamp(std::string utc) {
  std::erase_if(utc, [](char c) { return c == ':' || c == '-' || c == '.'; });
  return utc;
}

}  // namespace

Station::Station(AxisConfig config, PipelineOptions options, std::string configuration,
                 std::filesystem::path recordings, Storekeeper& keeper, StationEvents events)
    : config_(std::move(config)),
      options_(std::move(options)),
      configuration_(std::move(configuration)),
      recordings_(std::move(recordings)),
      keeper_(keeper),
      shared_(std::make_shared<Shared>(std::move(events))),
      acquire_turn_(steady_clock::now()),
      measure_turn_(steady_clock::now()) {
  status_.info.name = config_.device.name;
  status_.info.driver = config_.device.driver;
  status_.info.simulated = config_.device.simulated;
  measure_thread_ = std::thread([this] { measure(); });
  if (config_.device.live) start_acquiring();
}

Station::~Station() {
  if (config_.device.live) stop_acquiring();
  shared_->queue.close();
  measure_thread_.join();  // an open run ends there; from here nobody else starts or joins a reader
  stop_acquiring();
}

// ---- acquire thread ----

void Station::start_acquiring() {
  stop_acquiring();
  acquiring_ = true;
  acquire_turn_ = steady_clock::now();
  acquire_thread_ = std::thread([this, pass = ++pass_] { acquire(pass); });
}

void Station::stop_acquiring() {
  acquiring_ = false;
  if (acquire_thread_.joinable()) acquire_thread_.join();
}

void Station::set_state(const std::string& state, const std::string& error) {
  const std::lock_guard lock(status_mutex_);
  status_.state = state;
  if (!error.empty()) status_.error = error;
}

void Station::acquire(std::uint64_t pass) {
  name_thread("acquire", config_.rig.axis);
  auto driver = config_.device.make();
  milliseconds backoff = kFirstBackoff;
  bool ended = false;
  while (acquiring_ && !ended) {
    acquire_turn_ = steady_clock::now();
    const Status opened = driver ? (*driver)->open() : Status(tl::unexpected(driver.error()));
    if (opened) {
      {
        const std::lock_guard lock(status_mutex_);
        status_.info = (*driver)->info();
      }
      set_state("open");
      backoff = kFirstBackoff;
      ended = read_until_trouble(**driver, pass);
      if (ended || !acquiring_) break;
    } else {
      set_state("failed: reopening", opened.error().message);
    }
    // A replay that cannot be read will not heal: the run ends with what is wrong.
    if (!config_.device.live) {
      Item item;
      item.kind = Item::Kind::ended;
      item.pass = pass;
      item.reason = status().error;
      set_state("ended");
      shared_->queue.push_always(std::move(item));
      return;
    }
    for (auto waited = milliseconds(0); waited < backoff && acquiring_;
         waited += milliseconds(10)) {
      std::this_thread::sleep_for(milliseconds(10));
      acquire_turn_ = steady_clock::now();
    }
    backoff = std::min(2 * backoff, kLongestBackoff);
    const std::lock_guard lock(status_mutex_);
    ++status_.reopened;
  }
  if (!ended) return set_state("closed");
  set_state("ended");
  Item item;
  item.kind = Item::Kind::ended;
  item.pass = pass;
  item.source = config_.device.source_info(**driver);
  shared_->queue.push_always(std::move(item));
}

// True: the source has come to its end. False: an error (kept in the status) or no longer wanted.
bool Station::read_until_trouble(drivers::Driver& driver, std::uint64_t pass) {
  while (acquiring_) {
    acquire_turn_ = steady_clock::now();
    Item item;
    item.pass = pass;
    const auto state = driver.read(item.block, kReadTimeout);
    if (!state) {
      set_state("failed: reopening", state.error().message);
      return false;
    }
    if (item.block.scans() > 0) {
      {
        const std::lock_guard lock(status_mutex_);
        status_.scans += item.block.scans();
      }
      if (config_.device.live) {
        shared_->queue.try_push(std::move(item));
      } else {
        while (acquiring_ && !shared_->queue.push_for(item, kReadTimeout)) {
          acquire_turn_ = steady_clock::now();
        }
      }
    }
    if (*state == drivers::ReadState::end) return true;
  }
  return false;
}

// ---- main thread ----

NewRun Station::describe_run(const RunRequest& request) const {
  NewRun run;
  RunHeader& h = run.header;
  PipelineOptions options = options_;
  options.sequence.targets_m = request.targets_m;
  h.axis = config_.rig.axis;
  h.simulated = config_.device.simulated;
  h.started_utc = utc_now();
  h.note = request.note;
  h.provenance.rig_text = config_.rig.text;
  h.provenance.model = to_string(options.model);
  h.provenance.software_version = kVersion;
  h.provenance.options_json = options.json();
  h.provenance.configuration = configuration_;
  if (!config_.device.recorded) {
    h.provenance.recording_kind = "replay";
    h.provenance.recording_path = config_.device.source_path;
    return run;
  }
  run.recording = recordings_ / (file_stamp(h.started_utc) + "-" + letter(h.axis) + ".mdofrec");
  h.provenance.recording_kind = "recording";
  h.provenance.recording_path = std::filesystem::absolute(run.recording).string();
  run.recording_header = {kVersion,       config_.rig.text, device_json(status()),
                          configuration_, h.started_utc,    h.simulated};
  return run;
}

void Station::start_run(const RunRequest& request, const RunDone& done) {
  std::int64_t none = 0;
  if (!shared_->run.compare_exchange_strong(none, -1)) {
    return done(fail(ErrorCode::conflict, std::string("a run of axis ") + letter(config_.rig.axis) +
                                              " is under way; stop it with run.stop first"));
  }
  NewRun description = describe_run(request);
  const bool posted = keeper_.begin_run(
      std::move(description), [shared = shared_, request, done](const Result<std::int64_t>& id) {
        if (!id) {
          shared->run = 0;
          return done(id);
        }
        Item item;
        item.kind = Item::Kind::attach;
        item.run = *id;
        item.request = request;
        item.done = done;
        shared->queue.push_always(std::move(item));
      });
  if (posted) return;
  shared_->run = 0;
  done(io_error("the store is behind; try again"));
}

void Station::stop_run(bool abort, RunDone done) {
  if (shared_->run <= 0) {
    return done(fail(ErrorCode::not_found,
                     std::string("no run of axis ") + letter(config_.rig.axis) + " is under way"));
  }
  Item item;
  item.kind = Item::Kind::stop;
  item.abort = abort;
  item.done = std::move(done);
  shared_->queue.push_always(std::move(item));
}

void Station::storage_failed(std::int64_t run, const Error& error) {
  Item item;
  item.kind = Item::Kind::storage_failed;
  item.run = run;
  item.reason = error.message;
  shared_->queue.push_always(std::move(item));
}

DeviceStatus Station::status() const {
  const std::lock_guard lock(status_mutex_);
  DeviceStatus status = status_;
  status.dropped = shared_->queue.dropped();
  return status;
}

bool Station::healthy(steady_clock::duration limit) const {
  const auto now = steady_clock::now();
  const bool acquires =
      !acquiring_ || status().state == "ended" || now - acquire_turn_.load() < limit;
  return acquires && now - measure_turn_.load() < limit;
}

}  // namespace mdof::daemon
