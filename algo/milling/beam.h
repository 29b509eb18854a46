// The tool as a cantilever beam of several cylinders.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "schema/milling/milling_plan.h"

namespace mdof::algo {

// Deflection at each height of `at_m` by a unit force at each height of `of_m`, m/N, bending only
// (Eq. 2 of Huo et al. for one cylinder). Heights are above the tip, m, at most the overhang.
Eigen::MatrixXd beam_compliance(const std::vector<ToolSection>& from_holder,
                                double youngs_modulus_Pa, const std::vector<double>& at_m,
                                const std::vector<double>& of_m);

// Deflection of the tip due to shear by a force at the tip, as a share of the bending, with
// Cowper's coefficient of a circle and Poisson's ratio 0.22 (tungsten carbide).
double shear_share(const std::vector<ToolSection>& from_holder);

}  // namespace mdof::algo
