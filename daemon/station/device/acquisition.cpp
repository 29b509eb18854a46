#include "daemon/station/device/acquisition.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "daemon/paths.h"
#include "daemon/words/error_text.h"
#include "drivers/long_step.h"
#include "schema/base/number/number_text.h"
#include "schema/base/thread_start.h"

namespace mdof::daemon {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kReadTimeout{100};
constexpr milliseconds kFirstBackoff{50}, kLongestBackoff{250};
constexpr milliseconds kFullQueueSleep{10}, kRefresh{1000};
// Largest time for opening and set-up of a device. The watchdog must not end mdofd in this time.
constexpr milliseconds kOpening{20'000};

// Returns 3/4 to 4/4 of the waiting time. Devices that failed at the same time are then not opened
// at the same time.
milliseconds jittered(milliseconds pause, const std::string& device, std::uint64_t attempt) {
  const std::size_t hash = std::hash<std::string>{}(device + std::to_string(attempt));
  return pause * 3 / 4 + pause * (hash % 256) / 1024;
}

void mark_suspect(SampleBlock& block) {
  block.quality.resize(block.channels.size());
  for (auto& quality : block.quality) {
    quality.resize(block.scans(), Quality::good);
    for (Quality& q : quality) q = std::max(q, Quality::suspect);
  }
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

void Acquisition::set_state(const std::string& state) {
  const std::lock_guard lock(status_mutex_);
  status_.state = state;
}

void Acquisition::fail(const std::string& error) {
  {
    const std::lock_guard lock(status_mutex_);
    status_.state = "failed: reopening";
    status_.error = error;
  }
  if (lost_since_) return;  // the error is reported already
  lost_since_ = steady_clock::now();
  // The trouble states the device in its own member, so the name is removed from the text.
  const std::string who = "device \"" + spec_.name + "\"";
  const std::size_t begin = error.starts_with(who) ? error.find_first_not_of(": ", who.size()) : 0;
  report(Trouble::Kind::lost, begin == std::string::npos ? error : error.substr(begin));
}

// Reports a trouble. Also adds the trouble to the status, for clients that connect later.
void Acquisition::report(Trouble::Kind kind, const std::string& text, const std::string& channel) {
  const Trouble trouble{kind, spec_.name, text, utc_now(), channel};
  {
    const std::lock_guard lock(status_mutex_);
    auto& standing = status_.standing;
    const bool back = kind == Trouble::Kind::back;
    std::erase_if(standing, [&](const Trouble& t) {
      if (!back) return t.kind == kind && t.channel == channel;
      return t.kind != Trouble::Kind::suspect && (channel.empty() || t.channel == channel);
    });
    if (!back) standing.push_back(trouble);
  }
  if (sink_.trouble) sink_.trouble(trouble);
}

void Acquisition::acquire(std::uint64_t pass) {
  start_thread_as("acq-" + spec_.name);
  backoff_ = kFirstBackoff;
  last_ns_.reset();
  lost_since_.reset();
  datum_lost_.clear();
  clock_is_uncertain_ = false;
  position_ = {};
  marks_passed_ = 0;
  clock_steps_ = 0;
  {
    const std::lock_guard lock(status_mutex_);
    status_.standing.clear();
  }
  drivers::long_step_watcher() = [this](steady_clock::time_point until) {
    turn_ = std::max(turn_.load(), until);
  };
  auto driver = spec_.make();
  if (!driver) fail(words::text(driver.error()));
  while (acquiring_) {
    turn_ = steady_clock::now();
    if (driver && open_and_read(**driver, pass)) {
      set_state("ended");
      return sink_.ended(pass, "", spec_.source_info(**driver));
    }
    if (!acquiring_) break;
    if (!spec_.live) {  // a file that cannot be read now cannot be read later
      const std::string why = status().error;
      set_state("ended");
      return sink_.ended(pass, why, {});
    }
    pause();
  }
  set_state("closed");
}

// True: the source has ended. False: an error (the status contains it), or the thread must stop.
bool Acquisition::open_and_read(drivers::Driver& driver, std::uint64_t pass) {
  turn_ = steady_clock::now() + kOpening;
  const Status opened = driver.open();
  turn_ = steady_clock::now();
  if (!opened) {
    fail(words::text(opened.error()));
    return false;
  }
  set_state("open");
  rate_.begin(steady_clock::now());
  refresh_info(driver);
  just_opened_ = true;
  // Some drivers begin a new clock, whose number of steps is 0. This is no jump.
  if (const drivers::DeviceClock* clock = driver.clock()) clock_steps_ = clock->steps();
  return read_until_trouble(driver, pass);
}

void Acquisition::trust_encoder_count(const std::string& encoder) {
  const std::lock_guard lock(status_mutex_);
  forget_suspicion(encoder);
  trusted_.insert(encoder);
}

void Acquisition::forget_suspicion(const std::string& encoder) {
  std::erase_if(status_.standing, [&](const Trouble& t) {
    return t.kind == Trouble::Kind::suspect && t.channel == encoder;
  });
}

// Reports that the reference mark was passed, before the first block that is counted from the mark.
void Acquisition::watch_mark(const drivers::Driver& driver) {
  const int marks = driver.marks_passed();
  if (std::exchange(marks_passed_, marks) == marks) return;
  datum_lost_.erase(kEncoderChannel);
  {
    const std::lock_guard lock(status_mutex_);
    forget_suspicion(kEncoderChannel);
  }
  next_refresh_ = steady_clock::now();
  if (sink_.mark) sink_.mark(spec_.name);
}

void Acquisition::trust_counts(drivers::Driver& driver) {
  std::set<std::string> trusted;
  {
    const std::lock_guard lock(status_mutex_);
    trusted.swap(trusted_);
  }
  for (const std::string& encoder : trusted) {
    encoder == kEncoderChannel ? driver.trust_count() : driver.trust_further_count(encoder);
    datum_lost_.erase(encoder);
  }
}

// Updates information of the device that changes with time, such as the state of its clock.
void Acquisition::refresh_info(const drivers::Driver& driver) {
  next_refresh_ = steady_clock::now() + kRefresh;
  const drivers::DeviceInfo info = driver.info();
  assert(info.clock.has_value() == (driver.clock() != nullptr));
  {
    const std::lock_guard lock(status_mutex_);
    status_.info = info;
  }
  watch_datum(info);
}

// Reports a lost datum only once, because the datum stays lost.
void Acquisition::watch_datum(const drivers::DeviceInfo& info) {
  std::map<std::string, std::string> lost = info.further_datum_lost;
  lost[kEncoderChannel] = info.datum_lost;
  for (const auto& [encoder, why] : lost) {
    if (why.empty() || !datum_lost_.insert(encoder).second) continue;
    report(Trouble::Kind::suspect,
           "the encoder's datum is lost, so the positions of further stops are unknown: " + why +
               "; " + words::remedy(info.datum_remedy) + " and measure again",
           encoder);
  }
}

// If the time of samples is uncertain, the axis position of these samples is unknown. The samples
// get the quality "suspect", also in the recording.
void Acquisition::watch_clock(const drivers::Driver& driver, SampleBlock& block) {
  if (!spec_.live) return;
  const drivers::DeviceClock* clock = driver.clock();
  if (!clock) return;
  if (clock->doubtful()) mark_suspect(block);
  if (clock->doubtful() != clock_is_uncertain_ || clock->steps() != clock_steps_)
    report_clock(clock->state());
}

void Acquisition::report_clock(const drivers::ClockState& clock) {
  const bool stepped = std::exchange(clock_steps_, clock.steps) != clock.steps;
  const bool was = std::exchange(clock_is_uncertain_, clock.doubtful);
  if (stepped)
    report(
        Trouble::Kind::clock,
        "the device clock jumped, or the link was slow for a long time. The times of the "
        "samples are unknown while the clock settles (4 s). Stops in these 4 s are not evaluated, "
        "or are evaluated without the probes of this device. Check the power and the network, "
        "then measure these stops again");
  else if (clock.doubtful && !was)
    report(Trouble::Kind::clock,
           "the packets arrive " + std::to_string(clock.late_ns / 1'000'000) +
               " ms late, or the device clock stood still. Until mdofd reports that the times of "
               "the samples are valid again, the samples are suspect. Check the network and the "
               "load of this computer");
  else if (was && !clock.doubtful)
    report(Trouble::Kind::back, "the times of the samples are valid again");
}

bool Acquisition::read_until_trouble(drivers::Driver& driver, std::uint64_t pass) {
  SampleBlock block;
  while (acquiring_) {
    turn_ = steady_clock::now();
    trust_counts(driver);
    const auto state = driver.read(block, kReadTimeout);
    if (!state) {
      fail(words::text(state.error()));
      return false;
    }
    if (block.scans() > 0) {
      backoff_ = kFirstBackoff;  // samples arrive, so the device works
      watch_mark(driver);
      if (steady_clock::now() > next_refresh_) refresh_info(driver);
      note_loss(block);
      watch_clock(driver, block);
      const bool came_back = recover(block);
      if (const auto trouble = spec_.live ? position_.take(block) : std::nullopt)
        report(trouble->kind, trouble->text, trouble->channel);
      watch_rate(block.scans(), came_back ? 0 : block.lost);
      deliver(block, pass);
    } else {
      watch_rate(0, 0);
    }
    if (*state == drivers::ReadState::end) return true;
  }
  return false;
}

// Called with each block of samples. A device can be opened and still not work; samples prove that
// it works. Returns whether the device was lost before.
bool Acquisition::recover(const SampleBlock& block) {
  if (!lost_since_) return false;
  const std::chrono::duration<double> away = steady_clock::now() - *lost_since_;
  lost_since_.reset();
  position_ = {};  // no longer in the status, so a trouble that continues is reported again
  {
    const std::lock_guard lock(status_mutex_);
    status_.last_error = std::exchange(status_.error, "");
    status_.recovered_utc = utc_now();
  }
  std::string text =
      "the device sends samples again after a break of " + plain_number(away.count(), 2) + " s";
  if (block.lost > 0) text += "; scans lost in this time: " + std::to_string(block.lost);
  report(Trouble::Kind::back, text);
  return true;
}

void Acquisition::watch_rate(std::uint64_t scans, std::uint64_t lost) {
  const auto now = steady_clock::now();
  if (!rate_.take(now, scans, lost) || !spec_.live) return;
  const DeviceStatus is = status();
  const bool was_slow = std::any_of(is.standing.begin(), is.standing.end(),
                                    [](const Trouble& t) { return t.kind == Trouble::Kind::slow; });
  if (const auto trouble = rate_.judge(now, is.info.rate_hz, was_slow))
    report(trouble->kind, trouble->text);
}

// Adds to block.lost the dropped scans, and the scans that were lost while the device was not open.
// If the device does not count the scans that were lost while it was not open, their number is
// estimated from the time and the rate; it is at least 1.
void Acquisition::note_loss(SampleBlock& block) {
  const std::lock_guard lock(status_mutex_);
  const double rate_hz = status_.info.rate_hz > 0 ? status_.info.rate_hz : status_.measured_hz;
  measure_rate(block);
  if (std::exchange(just_opened_, false) && last_ns_ && block.lost == 0) {
    const double away_s = static_cast<double>(block.time_ns.front() - *last_ns_) * 1e-9;
    block.lost = static_cast<std::uint64_t>(std::llround(std::max(1.0, away_s * rate_hz - 1)));
  }
  last_ns_ = block.time_ns.back();
  status_.lost += block.lost;
  block.lost += std::exchange(dropped_scans_, 0);
  status_.scans += block.scans();
}

// Measures the sampling rate, for devices that do not state it. status_mutex_ must be locked.
void Acquisition::measure_rate(const SampleBlock& block) {
  if (just_opened_) {
    opened_ns_ = block.time_ns.front();
    scans_since_opened_ = 0;
  }
  scans_since_opened_ += block.scans();
  const std::int64_t passed_ns = block.time_ns.back() - opened_ns_;
  if (passed_ns > 0)
    status_.measured_hz =
        1e9 * static_cast<double>(scans_since_opened_ - 1) / static_cast<double>(passed_ns);
}

void Acquisition::deliver(SampleBlock& block, std::uint64_t pass) {
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
    std::this_thread::sleep_for(kFullQueueSleep);
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
