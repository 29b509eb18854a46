// The noise of a signal that is at rest some of the time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace mdof::algo {

// Standard deviation of white noise, from mean |second differences| over short times (slots). A
// constant speed has no second differences, but acceleration and vibration have. Therefore the
// lower quartile of all slots so far is used; it is from slots at rest if the axis rests for at
// least a quarter of the time. The quietest slot is not used: among thousands of short slots it is
// far below the noise by chance. The resolution is 9 %. The result does not depend on how the data
// are divided; memory is fixed.
class NoiseFloor {
 public:
  // Mean |x[i] - 2 x[i-1] + x[i-2]| over `rows` values. A NaN (from a missing value) is ignored.
  void add(double mean_bend, std::size_t rows);
  double sd() const { return sd_; }  // 0 before the first slot

 private:
  static constexpr std::size_t kBins = 8 * 64;
  std::array<std::uint32_t, kBins> slots_{};
  std::uint64_t total_ = 0, below_ = 0;  // all slots, and those in bins below bin_
  std::size_t bin_ = 0;
  double sd_ = 0;
};

}  // namespace mdof::algo
