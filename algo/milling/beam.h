// Deflection of the tool, which is modelled as a cantilever beam of several cylinders.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "schema/milling/milling_plan.h"

namespace mdof::algo {

// Returns the deflection at each height of `at_m` (rows) due to a unit force at each height of
// `of_m` (columns), m/N. The deflection contains bending only (Eq. 2 of Huo et al. for one
// cylinder). Heights are above the tip, m, and at most the overhang.
Eigen::MatrixXd beam_compliance(const std::vector<ToolSection>& from_holder,
                                double youngs_modulus_Pa, const std::vector<double>& at_m,
                                const std::vector<double>& of_m);

// For a force at the tip, returns the ratio of the tip's deflection due to shear to its deflection
// due to bending. Uses Cowper's shear coefficient of a circle and Poisson's ratio 0.22 (tungsten
// carbide).
double shear_share(const std::vector<ToolSection>& from_holder);

}  // namespace mdof::algo
