// Overall figures of a run: number of visits, omitted stops, readings of encoder and probes. They
// help people to judge whether the run is plausible.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace mdof {

// One row of the matrix n_ij: for one target, the number of points in each run for which the five
// errors were calculated.
struct TargetVisits {
  double target_m = 0;
  std::vector<int> forward, reverse;  // one number for run 1, 2, ...
};

// A stop that belongs to no target.
struct StopLeftOut {
  double position_m = 0;
  std::int64_t begin_ns = 0;  // time of the first sample of its average
  std::string reason;  // code of a notice, "stop_parked_at_start"; for an old run, a sentence
};

struct ProbeFigures {
  std::string id;
  std::uint64_t points = 0;  // points for which the probe has a value
  double sd_m = 0;           // standard deviation of single readings; median over all dwells
  double travel_m = 0;       // difference between the largest and the smallest mean of a dwell
  double min_m = 0, max_m = 0;
};

struct Plausibility {
  std::string cycle;  // "standard", "pilgrim", "quasi-pilgrim", "pendulum", "none"
  int runs = 0;
  std::vector<TargetVisits> n_ij;  // in the order of the targets
  std::vector<StopLeftOut> left_out;
  // Stops at a target that were not averaged, because they were too short or because the axis
  // crept.
  std::uint64_t short_stops = 0;
  double rate_hz = 0;
  double encoder_min_m = 0, encoder_max_m = 0;
  std::uint64_t scans = 0, scans_lost = 0, gaps = 0;  // gaps: intervals longer than three periods
  // Time from the first to the last scan. NaN: unknown, because an mdof version without this member
  // stored the run.
  double duration_s = std::numeric_limits<double>::quiet_NaN();
  std::vector<ProbeFigures> probes;  // in the order of the rig
};

}  // namespace mdof
