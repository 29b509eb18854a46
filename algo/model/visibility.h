// Which of the five errors a set of probes determines, before any number is solved.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "algo/model/fixture.h"

namespace mdof::algo {

// First-order Jacobian of the readings: rows are probes, columns δy δz εx εy εz; m and m/rad.
//  reading = u · (δ + ε × (p - d e_x)) for a plane perpendicular to the probe's direction.
Eigen::MatrixXd first_order_jacobian(const Fixture& fixture, double travel_m,
                                     const std::vector<bool>& use);

struct Visibility {
  int rank = 0;                     // 0 to 5
  double condition = 0;             // largest by smallest singular value, angles scaled by 10 mm
  std::vector<std::string> unseen;  // ISO names in a combination that is not determined
  bool complete() const { return rank == kErrorCount; }
};

// Rank by singular values relative to 1e-6 of the largest. `use`: probes to use.
Visibility visibility(const Fixture& fixture, const std::vector<bool>& use);

// "probes A B cannot separate ECX and EYX" with the rank and the remedy; for an incomplete
// visibility.
std::string describe_unseen(const Fixture& fixture, const std::vector<bool>& use,
                            const Visibility& visibility);

}  // namespace mdof::algo
