// A simulated axis that runs measurement cycles and records the target, run and direction of each
// stop.
#pragma once

#include <vector>

#include "tests/algo/stepping_axis.h"

namespace mdof::algo {

inline constexpr double kOverrun_m = 1e-3;
inline const std::vector<double> kMachineTargets = {0,     5e-3,    10.2e-3, 14.9e-3,
                                                    20e-3, 25.1e-3, 30e-3};

// The expected target, run and direction of a visit.
struct Truth {
  int target, run, direction;
};

// Moves as the test commands and records the expected target, run and direction of each stop.
struct Machine : SteppingAxis {
  using SteppingAxis::SteppingAxis;
  std::vector<Truth> truth;
  std::vector<double> targets = kMachineTargets;

  int count() const { return static_cast<int>(targets.size()); }
  double at(int target) const { return targets[static_cast<std::size_t>(target) - 1]; }
  void visit(int target, int run, int direction) {
    stop(at(target));
    truth.push_back({target, run, direction});
  }
  void beyond(int target, int direction) { move_to(at(target) + direction * kOverrun_m); }

  void forward(int run) {
    for (int t = 1; t <= count(); ++t) visit(t, run, 1);
  }
  void reverse(int run) {
    for (int t = count(); t >= 1; --t) visit(t, run, -1);
  }
  void standard(int runs) {
    for (int run = 1; run <= runs; ++run) {
      forward(run);
      beyond(count(), 1);
      reverse(run);
      beyond(1, -1);
    }
  }
  // Visits one target `runs` times, each time from below and then from above.
  void oscillate(int target, int first_run, int runs) {
    for (int run = first_run; run < first_run + runs; ++run) {
      beyond(target, -1);
      visit(target, run, 1);
      beyond(target, 1);
      visit(target, run, -1);
    }
  }
};

}  // namespace mdof::algo
