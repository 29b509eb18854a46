// Sensitivities of the errors of each point of a run to the readings of its probes and encoder.
#pragma once

#include <vector>

#include "algo/model/solver.h"
#include "schema/run.h"

namespace mdof::algo {

struct PointSensitivity {
  bool valid = false;   // false: the point has no valid errors; errors and changes are then 0
  double travel_m = 0;  // travel of the target
  Errors5 carriage{};   // errors of the carriage, local frame
  // Change of the errors by 1 m of each probe's reading (0 for a lost probe), and by 1 m of the
  // travel. Local frame, at the reference point of the run.
  std::vector<Errors5> by_probe;
  Errors5 by_travel{};
  // Change of the errors if the true position of the point is 1 m further along the travel than the
  // encoder shows: by_travel minus the slope of the errors along the axis. The magnitude contains
  // the slope that the targets do not show (LocalSlope::unseen).
  Errors5 by_place{};
};

// One element for each point of the run. `solver` must have the rig and the model of the run.
// by_probe is calculated from the gain of the solver, by_travel from differences of the model,
// by_place with local_slopes().
std::vector<PointSensitivity> point_sensitivities(const Solver& solver, const Run& run);

}  // namespace mdof::algo
