// One pass of an axis -> what its probes read at each target that it went over.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "algo/on_the_fly/passes.h"
#include "algo/on_the_fly/target_grid.h"
#include "schema/point.h"

namespace mdof::algo {

struct BinPoint {
  std::int64_t place = 0;  // of the target (target_grid.h)
  Point point;             // at the target: values there, sd of what is left of single readings
  double speed_m_s = 0;
  std::vector<double> slope;  // of each probe's reading over the position
  std::size_t last_row = 0;   // of the pass
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
  std::vector<BinLeftOut> left_out;  // likewise
  bool too_dense = false;            // more targets than scans: none was tried
};

struct ProbesOfBins {
  std::vector<std::string> ids;
  std::vector<double> range_m, step_m;  // step: of the readings; 0: not known
};

// A bin is the stretch from where the axis comes into it to where it leaves it. It is left out
// where the axis changes its speed in it: where the rms of its way about a straight line over time
// is above 0.75 % of the bin beside the encoder's noise, as of a change by a fifth or a stop of a
// twentieth of the bin's time; with fewer than kFewestOfBin scans; and where more than half of its
// time has none. `period_ns`: from scan to scan.
PassBins bins_of(const AxisPass& pass, const TargetGrid& grid, const ProbesOfBins& probes,
                 std::int64_t period_ns);

}  // namespace mdof::algo
