// The tool as a cantilever beam of several cylinders.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "schema/milling/milling_plan.h"

namespace mdof::algo {

// m/N: the deflection at each height of `at_m` by a unit force at each of `of_m`, bending alone
// (Eq. 2 of Huo et al. for one cylinder). Heights are above the tip, m, at most the overhang.
Eigen::MatrixXd beam_compliance(const std::vector<ToolSection>& from_holder,
                                double youngs_modulus_Pa, const std::vector<double>& at_m,
                                const std::vector<double>& of_m);

// What shear adds to the deflection of the tip by a force there, as a share of the bending:
// Cowper's coefficient of a circle, Poisson's ratio 0.22 (tungsten carbide).
double shear_share(const std::vector<ToolSection>& from_holder);

}  // namespace mdof::algo
