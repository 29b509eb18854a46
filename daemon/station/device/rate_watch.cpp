#include "daemon/station/device/rate_watch.h"

#include "schema/base/number/number_text.h"

namespace mdof::daemon {
namespace {

constexpr std::chrono::seconds kWindow{5};
// A device becomes slow below kSlowShare of its nominal rate. It is no longer slow above
// kRecoveredShare of this rate.
constexpr double kSlowShare = 0.8, kRecoveredShare = 0.95;

}  // namespace

void RateWatch::begin(Time now) {
  end_ = now + kWindow;
  scans_ = lost_ = 0;
}

bool RateWatch::take(Time now, std::uint64_t scans, std::uint64_t lost) {
  scans_ += scans;
  lost_ += lost;
  return now >= end_;
}

std::optional<Trouble> RateWatch::judge(Time now, double nominal_hz, bool was_slow) {
  const double window_s = std::chrono::duration<double>(now - end_ + kWindow).count();
  const double rate_hz = static_cast<double>(scans_) / window_s;
  const bool slow = lost_ > 0 || rate_hz < (was_slow ? kRecoveredShare : kSlowShare) * nominal_hz;
  std::optional<Trouble> trouble;
  if (slow && !was_slow)
    trouble = {Trouble::Kind::slow, "",
               "the device sends " + plain_number(rate_hz) + " scans per second instead of " +
                   plain_number(nominal_hz) + ", and " + std::to_string(lost_) +
                   " scans were lost in 5 s; check the network or cable and the load of this "
                   "computer, or lower the rate of the device",
               ""};
  if (was_slow && !slow)
    trouble = {Trouble::Kind::back, "",
               "the device sends at its full rate again, and no scans are lost", ""};
  begin(now);
  return trouble;
}

}  // namespace mdof::daemon
