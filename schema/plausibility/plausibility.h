// What a run looks like as a whole, for people to judge whether it can be right: what was visited
// how often, what was left out, what the encoder and the probes did.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace mdof {

// One row of the matrix n_ij: how many points with errors there are of a target, in each run.
struct TargetVisits {
  double target_m = 0;
  std::vector<int> forward, reverse;  // of run 1, 2, ...
};

// A stop that belongs to no target.
struct StopLeftOut {
  double position_m = 0;
  std::int64_t begin_ns = 0;  // of its average
  std::string reason;         // a notice's code, "stop_parked_at_start"; of an old run a sentence
};

struct ProbeFigures {
  std::string id;
  std::uint64_t points = 0;  // in which it has a value
  double sd_m = 0;           // of single readings: the median of the dwells'
  double travel_m = 0;       // from the lowest to the highest mean of a dwell
  double min_m = 0, max_m = 0;
};

struct Plausibility {
  std::string cycle;  // "standard", "pilgrim", "quasi-pilgrim", "pendulum", "none"
  int runs = 0;
  std::vector<TargetVisits> n_ij;  // in the order of the targets
  std::vector<StopLeftOut> left_out;
  std::uint64_t short_stops = 0;  // too short to be averaged, or creeping; at a target
  double rate_hz = 0;
  double encoder_min_m = 0, encoder_max_m = 0;
  std::uint64_t scans = 0, scans_lost = 0, gaps = 0;  // gaps: intervals over three periods
  std::vector<ProbeFigures> probes;                   // in the order of the rig
};

}  // namespace mdof
