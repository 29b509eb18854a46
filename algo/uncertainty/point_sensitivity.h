// Sensitivities of the errors of each point of a run to the readings of its probes and encoder.
#pragma once

#include <vector>

#include "algo/model/solver.h"
#include "schema/run.h"

namespace mdof::algo {

struct PointSensitivity {
  bool valid = false;   // false: a point without errors; the rest is then 0
  double travel_m = 0;  // travel of the target
  Errors5 carriage{};   // errors of the carriage, local frame
  // Change of the errors, local frame, stated at the same place as the errors of the run: by 1 m of
  // each probe's reading (0 for a lost probe), and by 1 m of the travel.
  std::vector<Errors5> by_probe;
  Errors5 by_travel{};
  // Change by 1 m of difference between the true position of the point and that of the encoder, in
  // the travel's direction: by_travel minus the slope of the errors along the axis.
  Errors5 by_place{};
};

// One element for each point of the run. The gain of the solver gives the sensitivities to the
// readings, differences of the model give those to the travel, and local_slopes() those to the
// position. `solver` has the rig and the model of the run.
std::vector<PointSensitivity> point_sensitivities(const Solver& solver, const Run& run);

}  // namespace mdof::algo
