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
  std::int64_t place = 0;  // place number of the target (target_grid.h)
  Point point;             // values at the target; sd is of the residuals of single readings
  double speed_m_s = 0;
  std::vector<double> slope;  // slope of each probe's reading over the position
  std::size_t last_row = 0;   // index in the rows of the pass
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
  bool too_dense = false;            // more targets than scans, so no bin was evaluated
};

struct ProbesOfBins {
  std::vector<std::string> ids;
  std::vector<double> range_m, step_m;  // step of the readings; 0: unknown
};

// A bin is the time from the first arrival of the axis in its range of travel until it leaves this
// range. A bin is left out in three cases. (1) The axis changes its speed: the rms of the position
// about a straight line over time, without the encoder's noise, is above 0.75 % of the bin, as with
// a change of a fifth, or with a stop of a twentieth of the bin's time. (2) It has fewer than
// kLeastReadingsPerBin scans. (3) More than half of its time has no scans. `period_ns`: time
// between two scans.
PassBins bins_of(const AxisPass& pass, const TargetGrid& grid, const ProbesOfBins& probes,
                 std::int64_t period_ns);

}  // namespace mdof::algo
