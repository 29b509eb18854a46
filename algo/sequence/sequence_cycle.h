// The order in which an axis moves to its targets (ISO 230-2, VDI/DGQ 3441), and the run of each
// visit.
#pragma once

#include <cstddef>
#include <vector>

namespace mdof::algo {

enum class Cycle {
  standard,  // over all targets and back, past the end targets; or in one direction only
  pendulum,  // over all targets and back, with reversals at the end targets
  pilgrim,   // all visits of a target one after the other, then the next target (step cycle)
  // Back and forth over a few targets, or at each of them, all along the travel.
  quasi_pilgrim,
  none,
};
const char* to_string(Cycle cycle);

struct Visit {
  int target = 0;     // 1 ... m, ascending
  int direction = 0;  // +1, -1
};

struct CycleFound {
  Cycle cycle = Cycle::none;
  // A run is a pass over the targets; otherwise a target's k-th visit is run k.
  bool by_passes = false;
  std::vector<int> run;  // run of each visit: 1, 2, ...
};

// Counts passes visit by visit from the reversals of the path over the targets; recognise_cycle()
// says what a pass is.
class Passes {
 public:
  explicit Passes(int targets) : turn_(targets > 3 ? targets / 2 : 1) {}
  int next(const Visit& visit);  // run of this visit

 private:
  void follow(int target);
  void turn(int heading, int target);

  int turn_;
  int low_ = 0, high_ = 0;  // since the last reversal
  int heading_ = 0;
  int forward_ = 0, reverse_ = 0;                // passes that have begun
  int forward_before_ = 0, reverse_before_ = 0;  // visits before the first reversal
};

// In the standard and the pendulum cycle a run is a pass: a missed stop shifts no number, and a
// target that is repeated within a pass has two visits of one run. A new pass begins when the axis
// has moved back by half of the targets; a shorter way back is a repetition. In the other cycles
// the k-th visit of a target in a direction is run k.
CycleFound recognise_cycle(const std::vector<Visit>& visits, int targets);

}  // namespace mdof::algo
