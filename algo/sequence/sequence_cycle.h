// Recognises the order in which an axis moves to its targets (ISO 230-2, VDI/DGQ 3441), and the run
// of each visit.
#pragma once

#include <cstddef>
#include <vector>

namespace mdof::algo {

enum class Cycle {
  // Over all targets and back, with reversals outside the end targets; or in one direction only.
  standard,
  pendulum,  // over all targets and back, with reversals at the end targets
  pilgrim,   // all visits of a target, then all visits of the next target (step cycle)
  // repeated motion back and forth over a few targets, or at each target, along the whole travel
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
  // true: a run is a pass over the targets; false: the k-th visit of a target in a direction
  // belongs to run k.
  bool by_passes = false;
  std::vector<int> run;  // run of each visit: 1, 2, ...
};

// Counts passes visit by visit from the reversals of the path over the targets. recognise_cycle()
// defines a pass.
class Passes {
 public:
  explicit Passes(int targets) : turn_(targets > 3 ? targets / 2 : 1) {}
  int next(const Visit& visit);  // run of this visit

 private:
  void follow(int target);
  void turn(int heading, int target);

  int turn_;
  int low_ = 0, high_ = 0;  // lowest and highest target since the last reversal
  int heading_ = 0;
  int forward_ = 0, reverse_ = 0;                // number of passes that have begun
  int forward_before_ = 0, reverse_before_ = 0;  // number of visits before the first reversal
};

// In the standard and the pendulum cycle a run is a pass. So a missed stop does not change the run
// numbers of later visits, and a target that is repeated within a pass has two visits of one run. A
// new pass begins when the axis has moved back by half of the targets; a shorter motion back is a
// repetition. In the other cycles the k-th visit of a target in a direction belongs to run k.
CycleFound recognise_cycle(const std::vector<Visit>& visits, int targets);

}  // namespace mdof::algo
