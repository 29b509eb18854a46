// Effects of temperature on scale, fixture and target (schema/rig/effects/expansion.h), as
// contributors.
//
// - Scale: the expansion of the scale is proportional to the travel.
// - Fixture: the positions of all probes move away from the origin of M, in proportion to their
//   distance from this origin.
// - Target: a temperature gradient g bends the target. The point r of the target moves by
//   α ((g·r) r - r² g/2), with the expansion coefficient α. This displacement is free of stress,
//   because the strain is α g·r in every direction. The displacement is 0 at the point that lies in
//   the origin of M at the travel d = 0.
// The probes were zeroed at d = 0. Therefore a reading contains an effect minus its value at d = 0.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "algo/model/solver.h"
#include "algo/uncertainty/contributors.h"
#include "algo/uncertainty/point_sensitivity.h"
#include "schema/rig/rig.h"
#include "schema/run.h"

namespace mdof::algo {

// Changes of the readings of all probes, m, by the relative expansion `relative` of the fixture.
Eigen::VectorXd readings_by_fixture_expansion(const Fixture& fixture, double relative,
                                              double travel_m, const Errors5& carriage);
// `bend_per_m`: α g, local frame.
Eigen::VectorXd readings_by_gradient(const Fixture& fixture, const Eigen::Vector3d& bend_per_m,
                                     double travel_m);
// α g for a gradient of one standard uncertainty along each axis of the machine, in the local
// frame.
std::vector<Eigen::Vector3d> gradient_bends(const Rig& rig);

// `points`: result of point_sensitivities(). Empty if the rig declares no expansion.
std::vector<Contributor> expansion_contributors(const Rig& rig, const Solver& solver,
                                                const std::vector<PointSensitivity>& points);

}  // namespace mdof::algo
