// Determines which of the five errors a set of probes can measure. Only the fixture is necessary,
// no readings.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "algo/model/fixture.h"

namespace mdof::algo {

// Returns the first-order Jacobian of the readings. Rows: probes; columns: δy δz εx εy εz; m and
// m/rad.
//  reading = u · (δ + ε × (p - d e_x)) for a plane perpendicular to the probe's direction.
Eigen::MatrixXd first_order_jacobian(const Fixture& fixture, double travel_m,
                                     const std::vector<bool>& use);

struct Visibility {
  int rank = 0;          // 0 to 5
  double condition = 0;  // largest / smallest singular value; angles are scaled by 10 mm
  // ISO names of the errors that are not determined, alone or in a combination.
  std::vector<std::string> unseen;
  bool complete() const { return rank == kErrorCount; }
};

// The rank is the number of singular values above 1e-6 of the largest. `use`: probes to use.
Visibility visibility(const Fixture& fixture, const std::vector<bool>& use);

// Returns for example "probes A B cannot separate ECX and EYX" with the rank and what to change.
// Only for a visibility that is not complete().
std::string describe_unseen(const Fixture& fixture, const std::vector<bool>& use,
                            const Visibility& visibility);

}  // namespace mdof::algo
