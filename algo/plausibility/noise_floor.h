// The noise of a signal that now and then stands still.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace mdof::algo {

// Standard deviation of white noise, from mean |second differences| over short stretches (slots).
// A constant speed leaves no second difference, acceleration and vibration do: therefore the lower
// quartile of all slots so far, which lies among those at rest where the axis rests for a quarter
// of the time or longer. Never the quietest one: of thousands of short slots that is an accident,
// far below the noise. 9 % fine; the same however the data are cut; memory is fixed.
class NoiseFloor {
 public:
  // Mean |x[i] - 2 x[i-1] + x[i-2]| over `rows` values. NaN, of a value that is missing, is no
  // slot.
  void add(double mean_bend, std::size_t rows);
  double sd() const { return sd_; }  // 0 before the first slot

 private:
  static constexpr std::size_t kBins = 8 * 64;
  std::array<std::uint32_t, kBins> slots_{};
  std::uint64_t total_ = 0, below_ = 0;  // slots, and those in bins under bin_
  std::size_t bin_ = 0;
  double sd_ = 0;
};

}  // namespace mdof::algo
