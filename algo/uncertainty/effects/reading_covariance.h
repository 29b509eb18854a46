// What a rig declares not to know of its probes, as the covariance of their readings at one pose.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "algo/model/solver.h"
#include "schema/point.h"
#include "schema/rig/rig.h"

namespace mdof::algo {

// m², probes x probes: calibration, sensitivity, place and direction of the probes, with the
// covariances of a calibration record, how the fixture is installed, the encoder, expansion, drift
// over `since_zero_s`, and the flatness that the probes of a plane share (flatness.h). What moves
// or turns a probe counts by what it changes after the zero at d = 0 without errors, and so does a
// height. Not in it: what corrections of the probes' physics leave (physics_contributors).
Eigen::MatrixXd declared_covariance(const Rig& rig, const Solver& solver, double travel_m,
                                    const Errors5& carriage, const std::vector<double>& readings_m,
                                    double since_zero_s);

}  // namespace mdof::algo
