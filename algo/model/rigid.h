// The rigid model (algo/README.md), with a true rotation, for any probes and any target planes.
//
// The pose of the carriage is X_MC = (R, t), with t = (d, δy, δz) in the local frame and R = Rz(C)
// Ry(B) Rx(A) about the machine's axes (for the X axis Rz(εz) Ry(εy) Rx(εx)), converted to the
// local frame. A probe at P with the direction u meets the target plane n·c = k (+ height) of the
// frame C at the displacement
//   s = (k - n_M·(P - t)) / (n_M·u),  n_M = R n.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "algo/model/fixture.h"
#include "schema/point.h"

namespace mdof::algo {

// Returns the readings of all probes for given errors. Angles must be within ±0.25 rad.
Eigen::VectorXd rigid_readings(const Fixture& fixture, double travel_m, const Errors5& local);

// Returns the derivatives of the readings. Rows: probes; columns: δy δz εx εy εz. The slope of the
// height map is neglected.
Eigen::MatrixXd rigid_jacobian(const Fixture& fixture, double travel_m, const Errors5& local);

// Solves the five errors by weighted Gauss-Newton iteration. `readings_m` and `weights` have one
// value for each probe; a probe with the weight 0 is not used. The caller ensures that the probes
// in use determine all five errors.
AxisErrors solve_rigid(const Fixture& fixture, double travel_m,
                       const std::vector<double>& readings_m, const std::vector<double>& weights);

}  // namespace mdof::algo
