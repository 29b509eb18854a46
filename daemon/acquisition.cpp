#include "daemon/acquisition.h"

#include <pthread.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace mdof::daemon {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kReadTimeout{100};
constexpr milliseconds kFirstBackoff{50}, kLongestBackoff{250};
constexpr milliseconds kNap{10}, kRefresh{1000};
// Some devices take seconds to be found, asked and set up; to be in there is no hang-up.
constexpr milliseconds kOpening{20'000};

// Names of threads end after 15 characters.
void name_thread(const std::string& device) {
  pthread_setname_np(pthread_self(), ("acq-" + device).substr(0, 15).c_str());
}

// Devices that fail together are not to be asked again together: from 3/4 to all of the pause.
milliseconds jittered(milliseconds pause, const std::string& device, std::uint64_t attempt) {
  const std::size_t hash = std::hash<std::string>{}(device + std::to_string(attempt));
  return pause * 3 / 4 + pause * (hash % 256) / 1024;
}

}  // namespace

Acquisition::Acquisition(drivers::DriverSpec spec, Sink sink)
    : spec_(std::move(spec)), sink_(std::move(sink)), turn_(steady_clock::now()) {
  status_.info.name = spec_.name;
  status_.info.driver = spec_.driver;
  status_.info.simulated = spec_.simulated;
}

Acquisition::~Acquisition() {
  stop();
}

void Acquisition::start() {
  stop();
  acquiring_ = true;
  turn_ = steady_clock::now();
  thread_ = std::thread([this, pass = ++pass_] { acquire(pass); });
}

void Acquisition::stop() {
  acquiring_ = false;
  if (thread_.joinable()) thread_.join();
}

void Acquisition::set_state(const std::string& state, const std::string& error) {
  const std::lock_guard lock(status_mutex_);
  status_.state = state;
  if (!error.empty()) status_.error = error;
}

void Acquisition::acquire(std::uint64_t pass) {
  name_thread(spec_.name);
  backoff_ = kFirstBackoff;
  last_ns_.reset();
  auto driver = spec_.make();
  if (!driver) set_state("failed: reopening", driver.error().message);
  while (acquiring_) {
    turn_ = steady_clock::now();
    if (driver && open_and_read(**driver, pass)) {
      set_state("ended");
      return sink_.ended(pass, "", spec_.source_info(**driver));
    }
    if (!acquiring_) break;
    if (!spec_.live) {  // a replay that cannot be read will not heal
      const std::string why = status().error;
      set_state("ended");
      return sink_.ended(pass, why, {});
    }
    pause();
  }
  set_state("closed");
}

// True: the source has come to its end. False: an error (kept in the status) or no longer wanted.
bool Acquisition::open_and_read(drivers::Driver& driver, std::uint64_t pass) {
  turn_ = steady_clock::now() + kOpening;
  const Status opened = driver.open();
  turn_ = steady_clock::now();
  if (!opened) {
    set_state("failed: reopening", opened.error().message);
    return false;
  }
  set_state("open");
  refresh_info(driver);
  just_opened_ = true;
  return read_until_trouble(driver, pass);
}

// What the device says of itself grows with time: its clock.
void Acquisition::refresh_info(const drivers::Driver& driver) {
  next_refresh_ = steady_clock::now() + kRefresh;
  const std::lock_guard lock(status_mutex_);
  status_.info = driver.info();
}

bool Acquisition::read_until_trouble(drivers::Driver& driver, std::uint64_t pass) {
  while (acquiring_) {
    turn_ = steady_clock::now();
    SampleBlock block;
    const auto state = driver.read(block, kReadTimeout);
    if (!state) {
      set_state("failed: reopening", state.error().message);
      return false;
    }
    if (block.scans() > 0) {
      backoff_ = kFirstBackoff;  // it works; to be opened alone is no proof of that
      if (steady_clock::now() > next_refresh_) refresh_info(driver);
      note_loss(block);
      hand_over(block, pass);
    }
    if (*state == drivers::ReadState::end) return true;
  }
  return false;
}

// Scans of a device that was away, at least one, where it cannot count them itself, and those
// dropped here.
void Acquisition::note_loss(SampleBlock& block) {
  const std::lock_guard lock(status_mutex_);
  if (std::exchange(just_opened_, false) && last_ns_ && block.lost == 0) {
    const double away_s = static_cast<double>(block.time_ns.front() - *last_ns_) * 1e-9;
    const double scans = away_s * status_.info.rate_hz;
    block.lost = static_cast<std::uint64_t>(std::llround(std::max(1.0, scans - 1)));
  }
  last_ns_ = block.time_ns.back();
  status_.lost += block.lost;
  block.lost += std::exchange(dropped_scans_, 0);
  status_.scans += block.scans();
}

void Acquisition::hand_over(SampleBlock& block, std::uint64_t pass) {
  if (!spec_.live) {
    while (acquiring_ && !sink_.samples(block, pass, kReadTimeout)) turn_ = steady_clock::now();
    return;
  }
  if (sink_.samples(block, pass, milliseconds(0))) return;
  dropped_scans_ += block.lost + block.scans();
  const std::lock_guard lock(status_mutex_);
  ++status_.dropped;
  status_.lost += block.scans();
}

void Acquisition::pause() {
  const auto until = steady_clock::now() + jittered(backoff_, spec_.name, status().reopened);
  backoff_ = std::min(2 * backoff_, kLongestBackoff);
  while (acquiring_ && steady_clock::now() < until) {
    std::this_thread::sleep_for(kNap);
    turn_ = steady_clock::now();
    if (!woken_.exchange(false)) continue;
    backoff_ = kFirstBackoff;
    break;
  }
  const std::lock_guard lock(status_mutex_);
  ++status_.reopened;
}

DeviceStatus Acquisition::status() const {
  const std::lock_guard lock(status_mutex_);
  return status_;
}

bool Acquisition::healthy(steady_clock::duration limit) const {
  if (!acquiring_ || status().state == "ended") return true;
  return steady_clock::now() - turn_.load() < limit;
}

}  // namespace mdof::daemon
