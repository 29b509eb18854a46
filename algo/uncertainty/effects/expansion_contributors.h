// Effects of temperature on scale, fixture and target (schema/rig/effects/expansion.h), as
// contributors.
//
// The scale gets longer by a part of the travel. The positions of all probes move away from M's
// origin by the same part of their distance. A target whose temperature has the gradient g bends:
// its point r moves by α ((g·r) r - r² g/2), which is free of stress (its strain is α g·r in every
// direction). The target is held at its point that lies in M's origin when d = 0. Each effect
// counts by its change since the zero of the probes at d = 0.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "algo/model/solver.h"
#include "algo/uncertainty/contributors.h"
#include "algo/uncertainty/point_sensitivity.h"
#include "schema/rig/rig.h"
#include "schema/run.h"

namespace mdof::algo {

// Change of the readings of all probes at a pose, m.
Eigen::VectorXd readings_by_fixture_expansion(const Fixture& fixture, double relative,
                                              double travel_m, const Errors5& carriage);
// `bend_per_m`: α g, local frame.
Eigen::VectorXd readings_by_gradient(const Fixture& fixture, const Eigen::Vector3d& bend_per_m,
                                     double travel_m);
// α g by one standard uncertainty along each of the machine's axes, local frame.
std::vector<Eigen::Vector3d> gradient_bends(const Rig& rig);

// `points`: as returned by point_sensitivities(). Empty if the rig declares no expansion.
std::vector<Contributor> expansion_contributors(const Rig& rig, const Solver& solver,
                                                const std::vector<PointSensitivity>& points);

}  // namespace mdof::algo
