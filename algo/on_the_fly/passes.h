// Frames -> the passes of an axis that goes back and forth without stopping.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "schema/base/result.h"
#include "schema/sample.h"

namespace mdof::algo {

inline constexpr int kGapPeriods = 3;  // longer without a scan is a gap

// Rows first ... last - 1 of `frames`, between two turns of the axis.
struct AxisPass {
  const FrameBlock& frames;
  std::size_t first = 0, last = 0;
  int direction = 0;  // +1, -1
};

// The axis has turned where it has gone back by 50 µm; rows in which it stands, before it turns or
// within its way, belong to the pass. Streaming, the same however the frames are cut; one pass is
// kept in memory. Each frame must have a position; those that spike by a single one turn nothing.
class PassFinder {
 public:
  using Take = std::function<void(const AxisPass&)>;

  // Calls `take` for each pass that became complete. Error: one of more scans than can be kept.
  Status push(const FrameBlock& frames, std::size_t first, std::size_t last, const Take& take);
  // End of the data: the last pass.
  void flush(const Take& take);

  static constexpr std::size_t kMostScans = std::size_t{1} << 22;  // of a pass

 private:
  struct Extreme {
    std::size_t row = 0;
    double at_m = 0;
  };
  void follow(std::size_t row, double at_m, const Take& take);
  void turn(int heading, Extreme at, const Take& take);

  FrameBlock rows_;
  std::size_t next_ = 0;  // of rows_: not yet followed
  int heading_ = 0;
  std::size_t begin_ = 0;
  bool begun_ = false;
  Extreme low_, high_;  // since the last turn
};

// The median of the encoder's reading and its two neighbours: a single wrong count is voted out, a
// steady way stays as it is. At the ends of the rows it is the reading.
double voted_place(const FrameBlock& frames, std::size_t row);

}  // namespace mdof::algo
