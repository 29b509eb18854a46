#include "drivers/sysfs/poller.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <ctime>
#include <utility>

#include "drivers/clock/monotonic.h"
#include "drivers/scan_block.h"

namespace mdof::drivers {
namespace {

constexpr std::int64_t kBlock_ns = 10'000'000;

// steady_clock is CLOCK_MONOTONIC.
void sleep_until(std::int64_t time_ns) {
  const timespec until{time_ns / 1'000'000'000, time_ns % 1'000'000'000};
  while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
}

}  // namespace

SysfsPoller::SysfsPoller(std::string name, std::string driver, double rate_hz, std::int64_t slow_ns,
                         std::function<Result<SysfsDevice>()> open)
    : name_(std::move(name)),
      driver_(std::move(driver)),
      rate_hz_(rate_hz),
      period_ns_(std::llround(1e9 / rate_hz)),
      slow_ns_(slow_ns),
      open_(std::move(open)) {}

DeviceInfo SysfsPoller::info() const {
  DeviceInfo info{name_, driver_, device_.description, channels_, rate_hz_, false, {}};
  if (datum_lost_) info.datum_lost = device_.datum_lost;
  info.datum_remedy = device_.datum_remedy;
  return info;
}

Status SysfsPoller::open() {
  is_open_ = false;
  device_ = {};  // closes the files of the old device first
  MDOF_TRY(device_, open_());
  channels_.clear();
  for (const auto& input : device_.inputs) channels_.push_back(input.channel);
  is_open_ = true;
  datum_lost_ = opened_before_ && !device_.datum_lost.empty();
  opened_before_ = true;
  next_ns_ = monotonic_ns();
  lost_ = 0;
  failures_ = 0;
  passed_mark_ = false;
  return {};
}

Result<ReadState> SysfsPoller::read(SampleBlock& block, std::chrono::milliseconds timeout) {
  start_block(block, name_, channels_);
  if (std::exchange(passed_mark_, false)) {
    ++marks_passed_;
    datum_lost_ = false;
  }
  if (!is_open_) return io_error("device \"" + name_ + "\" is not open; call open() before read()");
  const std::int64_t until_ns =
      monotonic_ns() +
      std::chrono::nanoseconds(std::min(timeout, std::chrono::milliseconds(3'600'000))).count();
  const std::int64_t full_ns = monotonic_ns() + kBlock_ns;
  do {
    sleep_until(std::min(next_ns_, until_ns));
    if (next_ns_ > until_ns) break;
    MDOF_CHECK(poll(block));
    schedule_next(monotonic_ns());
    // Lost polls and passed marks apply to the beginning of a block. Therefore a scan after a loss
    // or a mark begins a new block.
  } while (next_ns_ < std::max(full_ns, block.scans() == 0 ? until_ns : 0) && lost_ == 0 &&
           !passed_mark_);
  return ReadState::more;
}

Status SysfsPoller::poll(SampleBlock& block) {
  std::vector<double> values;
  Quality quality = failures_ > 0 || datum_lost_ ? Quality::suspect : Quality::good;
  std::vector<Quality> own;
  const std::int64_t begin_ns = monotonic_ns();
  std::int64_t last_begin_ns = begin_ns;
  for (const auto& input : device_.inputs) {
    last_begin_ns = monotonic_ns();
    const auto reading = input.read();
    if (!reading) return count_failure(reading.error());
    passed_mark_ = passed_mark_ || reading->passed_mark;
    values.push_back(reading->value);
    own.push_back(reading->quality);
  }
  const std::int64_t end_ns = monotonic_ns();
  if (slow_ns_ > 0 && end_ns - begin_ns > slow_ns_) quality = Quality::suspect;
  last_time_ns_ = std::max(last_begin_ns + (end_ns - last_begin_ns) / 2, last_time_ns_ + 1);
  add_scan(block, last_time_ns_, values, quality);
  for (std::size_t i = 0; i < own.size(); ++i)
    block.quality[i].back() = std::max(block.quality[i].back(), own[i]);
  block.lost += std::exchange(lost_, 0);
  failures_ = 0;
  return {};
}

Status SysfsPoller::count_failure(const Error& why) {
  ++lost_;
  if (++failures_ <= kFailuresAllowed) return {};
  is_open_ = false;
  return io_error("device \"" + name_ + "\": " + std::to_string(failures_) +
                  " readings in a row failed; the last error: " + why.message);
}

// Schedules the next poll at a multiple of the period. A poll that is late by less than one period
// is still made; a poll that is later than this is lost.
void SysfsPoller::schedule_next(std::int64_t now_ns) {
  next_ns_ += period_ns_;
  if (next_ns_ > now_ns - period_ns_) return;  // not late, or late by less than one period
  const std::int64_t missed = (now_ns - next_ns_) / period_ns_;
  lost_ += static_cast<std::uint64_t>(missed);
  next_ns_ += missed * period_ns_;
}

}  // namespace mdof::drivers
