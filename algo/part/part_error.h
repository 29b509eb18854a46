// The error of a part along its path from the causes of its layers, each with its uncertainty, and
// the share of each (README.md). SI units.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace mdof::algo {

// One cause over the points of a path: error = value + xi u. xi is one number of variance 1 for the
// whole path, because repeated measurement does not reduce the uncertainty of, for example, a
// squareness or a scale.
struct PartCause {
  std::size_t layer = 0;
  std::string name;
  std::vector<Eigen::Vector3d> value_m, u_m;
};

// A cause with zero error and u.
inline PartCause new_cause(const std::string& name, std::size_t points) {
  return {0, name, std::vector<Eigen::Vector3d>(points, Eigen::Vector3d::Zero()),
          std::vector<Eigen::Vector3d>(points, Eigen::Vector3d::Zero())};
}

struct PartPath {
  std::vector<Eigen::Vector3d> at_m;
  // Outward unit vectors: the error is the component along them. Empty: the error is the length of
  // the error vector.
  std::vector<Eigen::Vector3d> normal;
};

struct PartShare {
  double rms_m = 0, U_rms_m = 0;  // rms of the layer or cause, with its U
  double share = 0, U_share = 0;  // share of the sum of all mean squares, with its U
};

struct PartError {
  double p95_m = 0, U_p95_m = 0, max_m = 0, U_max_m = 0;
  std::size_t worst = 0;  // index of the point
  std::vector<PartShare> layers, causes;
};

struct PartTrials {
  std::uint64_t seed = 1;
  std::size_t shares = 2000, errors = 400;
};

// Calculates U for 95 % by Monte Carlo over the xi: 95 % of the trials are within U of the
// estimate. The estimate of a cause with a known u and an unknown value (a budget) is its expected
// mean square.
PartError part_error(const PartPath& path, const std::vector<PartCause>& causes, std::size_t layers,
                     const PartTrials& trials = {});

}  // namespace mdof::algo
