// Estimates the noise of a signal that is sometimes at rest.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace mdof::algo {

// Calculates the standard deviation of white noise from the mean |second difference| in short
// intervals of time (slots). The second differences are 0 at constant speed, but not with
// acceleration and vibration. Therefore the lower quartile of all slots so far is used. It is from
// a slot at rest if the axis rests for at least a quarter of the time. The minimum of all slots is
// not used, because the minimum of thousands of short slots is far below the noise. The result has
// steps of 7 % to 12 %. It does not depend on how the data are divided into blocks; memory is
// fixed.
class NoiseFloor {
 public:
  // `mean_bend`: mean |x[i] - 2 x[i-1] + x[i-2]| over `rows` values. A NaN (from a missing value)
  // is ignored.
  void add(double mean_bend, std::size_t rows);
  double sd() const { return sd_; }  // 0 before the first slot

 private:
  static constexpr std::size_t kBins = 8 * 64;
  std::array<std::uint32_t, kBins> slots_{};
  std::uint64_t total_ = 0, below_ = 0;  // number of all slots, and of the slots in bins below bin_
  std::size_t bin_ = 0;
  double sd_ = 0;
};

}  // namespace mdof::algo
