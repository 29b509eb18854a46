// The order in which an axis goes to its targets (ISO 230-2, VDI/DGQ 3441), and the run of each
// visit.
#pragma once

#include <cstddef>
#include <vector>

namespace mdof::algo {

enum class Cycle {
  standard,       // over all targets and back, beyond the end targets; or one way only
  pendulum,       // over all targets and back, turning at the end targets
  pilgrim,        // a target's visits one after the other, then the next target (step cycle)
  quasi_pilgrim,  // back and forth over a few targets, or at each of them, all the way along
  none,
};
const char* to_string(Cycle cycle);

struct Visit {
  int target = 0;     // 1 ... m, ascending
  int direction = 0;  // +1, -1
};

struct CycleFound {
  Cycle cycle = Cycle::none;
  bool by_passes = false;  // a run is a pass over the targets; else a target's k-th visit is run k
  std::vector<int> run;    // 1, 2, ... of each visit
};

// Passes, by the turning points of the way over the targets: see recognise_cycle() for what counts
// as one. Visit by visit.
class Passes {
 public:
  explicit Passes(int targets) : turn_(targets > 3 ? targets / 2 : 1) {}
  int next(const Visit& visit);  // its run

 private:
  void follow(int target);
  void turn(int heading, int target);

  int turn_;
  int low_ = 0, high_ = 0;  // since the last turn
  int heading_ = 0;
  int forward_ = 0, reverse_ = 0;                // passes begun
  int forward_before_ = 0, reverse_before_ = 0;  // visits before the first turn
};

// In the standard and the pendulum cycle a run is a pass: a missed stop shifts nothing, and a
// target that is repeated within a pass has two visits of one run. A new pass begins where the
// axis has gone back by half of the targets; going back by less is a repetition. In the other
// cycles the k-th visit of a target in a direction is run k.
CycleFound recognise_cycle(const std::vector<Visit>& visits, int targets);

}  // namespace mdof::algo
