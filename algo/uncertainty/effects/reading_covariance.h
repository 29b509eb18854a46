// The covariance of the readings of a rig at one pose, from the uncertainties that the rig
// declares.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "algo/model/solver.h"
#include "schema/point.h"
#include "schema/rig/rig.h"

namespace mdof::algo {

// Covariance of the readings, m², probes x probes. It includes:
//   - calibration, sensitivity, position and direction of the probes, with the covariances of a
//     calibration record
//   - installation of the fixture, encoder, expansion
//   - drift over the time `since_zero_s`
//   - flatness of the planes; probes of the same plane are correlated (flatness.h)
// The probes were zeroed at the travel d = 0 without errors. Therefore a shift or rotation of a
// probe, or a height, contributes its effect minus its effect at d = 0. The covariance does not
// include the physics of the probes (physics_contributors.h).
Eigen::MatrixXd declared_covariance(const Rig& rig, const Solver& solver, double travel_m,
                                    const Errors5& carriage, const std::vector<double>& readings_m,
                                    double since_zero_s);

}  // namespace mdof::algo
