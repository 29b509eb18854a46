// Finds the passes of an axis that moves back and forth without stopping.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "schema/base/result.h"
#include "schema/sample.h"

namespace mdof::algo {

inline constexpr int kGapPeriods = 3;  // a longer time without a scan is a gap

// Rows first ... last - 1 of `frames`, between two reversals of the axis.
struct AxisPass {
  const FrameBlock& frames;
  std::size_t first = 0, last = 0;
  int direction = 0;  // +1: forward, -1: reverse
};

// A reversal is found when the axis has moved back by 50 µm. Rows at rest, before a reversal or
// during a pass, belong to the pass. A spike of a single position is no reversal. The result does
// not depend on how the frames are divided into blocks. One pass is kept in memory. Each frame must
// have a position.
class PassFinder {
 public:
  using Take = std::function<void(const AxisPass&)>;

  // Calls `take` for each complete pass. Error: a pass with more than kMostScans scans.
  Status push(const FrameBlock& frames, std::size_t first, std::size_t last, const Take& take);
  // Ends the data and calls `take` for the last pass.
  void flush(const Take& take);

  // Largest number of scans in a pass.
  static constexpr std::size_t kMostScans = std::size_t{1} << 22;

 private:
  struct Extreme {
    std::size_t row = 0;
    double at_m = 0;
  };
  void follow(std::size_t row, double at_m, const Take& take);
  void turn(int heading, Extreme at, const Take& take);

  FrameBlock rows_;
  std::size_t next_ = 0;  // first row of rows_ that is not yet processed
  int heading_ = 0;
  std::size_t begin_ = 0;
  bool begun_ = false;
  Extreme low_, high_;  // lowest and highest position since the last reversal
};

// Returns the median of the encoder's readings in this row and in the two rows next to it. The
// median removes a single wrong count and does not change a steady motion. In the first and the
// last row, the result is the reading itself.
double median_position(const FrameBlock& frames, std::size_t row);

}  // namespace mdof::algo
