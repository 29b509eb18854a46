// By how much the errors of each point of a run change with what its probes and its encoder say.
#pragma once

#include <vector>

#include "algo/model/solver.h"
#include "schema/run.h"

namespace mdof::algo {

struct PointSensitivity {
  bool valid = false;   // false: a point without errors; the rest is then 0
  double travel_m = 0;  // of the target
  Errors5 carriage{};   // local
  // Change of the errors, local frame and stated where the run is: by 1 m of each probe's reading
  // (0 for a lost probe), and by 1 m of the travel.
  std::vector<Errors5> by_probe;
  Errors5 by_travel{};
  // By 1 m that the place of the point differs from that which the encoder says, in the travel's
  // direction: by_travel, less what the errors themselves change along the axis.
  Errors5 by_place{};
};

// One a point of the run: of a reading by the solver's gain, of the travel by differences of the
// solver itself, of the place by local_slopes(), too. The solver is of the run's rig and model.
std::vector<PointSensitivity> point_sensitivities(const Solver& solver, const Run& run);

}  // namespace mdof::algo
