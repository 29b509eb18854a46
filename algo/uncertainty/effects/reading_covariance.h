// The uncertainties that a rig declares, as the covariance of its readings at one pose.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "algo/model/solver.h"
#include "schema/point.h"
#include "schema/rig/rig.h"

namespace mdof::algo {

// m², probes x probes. It includes calibration, sensitivity, position and direction of the probes,
// with the covariances of a calibration record; the installation of the fixture, the encoder and
// the expansion; the drift over `since_zero_s`; and the flatness that the probes of a plane share
// (flatness.h). A shift or rotation of a probe, and a height, count by their change since the zero
// at d = 0 without errors. It does not include the rest after corrections of the probes' physics
// (physics_contributors).
Eigen::MatrixXd declared_covariance(const Rig& rig, const Solver& solver, double travel_m,
                                    const Errors5& carriage, const std::vector<double>& readings_m,
                                    double since_zero_s);

}  // namespace mdof::algo
