#include "drivers/labjack/samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace mdof::drivers::labjack {

AinCalibration nominal_calibration(std::size_t gain) {
  constexpr std::array<double, 4> kGains{1, 10, 100, 1000};
  return {0.00031580578 / kGains.at(gain), -0.00031580578 / kGains.at(gain), 33523};
}

Status check(const AinCalibration& c, std::size_t gain) {
  constexpr double kSlope = 0.05, kCentre = 2000;  // larger than the deviation of any device
  const AinCalibration nominal = nominal_calibration(gain);
  const auto near = [](double value, double wanted, double by) {
    return std::abs(value - wanted) <= by;  // false for NaN
  };
  if (near(c.positive_slope / nominal.positive_slope, 1, kSlope) &&
      near(c.negative_slope / nominal.negative_slope, 1, kSlope) &&
      near(c.centre, nominal.centre, kCentre))
    return {};
  return io_error("the calibration constants in the flash of the device are impossible (slopes " +
                  std::to_string(c.positive_slope) + ", " + std::to_string(c.negative_slope) +
                  " V per code, centre at code " + std::to_string(c.centre) +
                  "); send the device to LabJack for calibration");
}

double volts(const AinCalibration& c, std::uint16_t raw) {
  const double above = raw - c.centre;
  return above < 0 ? -above * c.negative_slope : above * c.positive_slope;
}

Status ScanSplitter::take(std::span<const std::uint16_t> samples,
                          std::optional<std::uint64_t> dropped, std::vector<Scan>& scans) {
  if (dropped && !gap_) {
    gap_ = dropped;
    candidates_ = (begun_.size() + samples.size() + words_ - 1) / words_;
  }
  for (const std::uint16_t sample : samples) {
    begun_.push_back(sample);
    if (begun_.size() == words_) end_scan(scans);
  }
  if (!gap_ || candidates_ > 0) return {};
  return io_error(
      "the stream dropped " + std::to_string(*gap_) +
      " scans, but does not report at which point, so the times of later scans are unknown");
}

void ScanSplitter::end_scan(std::vector<Scan>& scans) {
  const bool marks = gap_ && candidates_ > 0 &&
                     std::all_of(begun_.begin(), begun_.end(), [](auto w) { return w == 0xFFFF; });
  if (candidates_ > 0) --candidates_;
  if (marks) {
    std::move(held_.begin(), held_.end(), std::back_inserter(scans));
    held_.clear();
    next_ += *gap_;
    lost_ += *std::exchange(gap_, std::nullopt);
    candidates_ = 0;
  } else {
    (gap_ ? held_ : scans).push_back({next_++, std::exchange(lost_, 0), begun_});
  }
  begun_.clear();
}

}  // namespace mdof::drivers::labjack
