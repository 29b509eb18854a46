// The readings of the probes at each target of one pass of an axis.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "algo/on_the_fly/passes.h"
#include "algo/on_the_fly/target_grid.h"
#include "schema/point.h"

namespace mdof::algo {

struct BinPoint {
  std::int64_t place = 0;  // number of the target (TargetGrid::Target)
  // Values of the probes at the target; probe_sd_m: standard deviation of single readings about the
  // fitted parabola.
  Point point;
  double speed_m_s = 0;
  std::vector<double> slope;  // for each probe: slope of the reading over the position
  std::size_t last_row = 0;   // row after the last row of the bin, in the frames of the pass
};

enum class BinFault { none, speed_changes, too_few, gap };

struct BinLeftOut {
  std::int64_t place = 0;
  double position_m = 0;
  std::int64_t begin_ns = 0;
  BinFault fault = BinFault::none;
  std::size_t scans = 0;
  double speed_m_s = 0;
};

struct PassBins {
  int direction = 0;
  std::int64_t begin_ns = 0, end_ns = 0;
  double from_m = 0, to_m = 0;
  std::vector<BinPoint> bins;        // in the order of time
  std::vector<BinLeftOut> left_out;  // in the order of time
  bool too_dense = false;            // there are more targets than scans, so no bin was evaluated
};

struct ProbesOfBins {
  std::vector<std::string> ids;
  std::vector<double> range_m, step_m;  // step_m: resolution of the readings; 0: unknown
};

// Each bin has a range of travel. The bin begins when the axis first reaches this range and ends
// when the axis first leaves it. A bin is left out in three cases:
// - The speed of the axis changes: the rms deviation of the position from a straight line over time
//   is above the root sum of squares of 0.75 % of the length of the bin and of three times the
//   noise of the encoder. A change of the speed by a fifth, or a stop for a twentieth of the bin's
//   time, has this effect.
// - The bin has fewer than kLeastReadingsPerBin scans.
// - More than half of the bin's time has no scans.
//
// `period_ns`: time between two scans.
PassBins bins_of(const AxisPass& pass, const TargetGrid& grid, const ProbesOfBins& probes,
                 std::int64_t period_ns);

}  // namespace mdof::algo
