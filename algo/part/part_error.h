// Calculates the error of a part along a path, and the share of each layer and of each cause in
// this error (README.md). Each layer consists of causes with uncertainties. SI units.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "algo/part/interval.h"

namespace mdof::algo {

// A part of the uncertainty of a cause: the effect of one standard uncertainty of a quantity that
// other causes can also contain. The same `number` is the same quantity in all causes.
struct CommonPart {
  std::size_t number = 0;
  std::vector<Eigen::Vector3d> u_m;
};

// One cause of the error at the points of a path: error = value + xi u + the sum of eta u over the
// common parts. xi and eta are random numbers with variance 1; xi belongs to the cause, eta to the
// number of the part. They are the same for the whole path, because the uncertainty of, for
// example, a squareness or a scale is the same at all points.
struct PartCause {
  std::size_t layer = 0;
  std::string name;
  std::vector<Eigen::Vector3d> value_m, u_m;
  std::vector<CommonPart> common{};
};

// Returns a cause with error 0 and u 0 at all points.
inline PartCause new_cause(const std::string& name, std::size_t points) {
  return {0,
          name,
          std::vector<Eigen::Vector3d>(points, Eigen::Vector3d::Zero()),
          std::vector<Eigen::Vector3d>(points, Eigen::Vector3d::Zero()),
          {}};
}

struct PartPath {
  std::vector<Eigen::Vector3d> at_m;
  // Outward unit vectors. The error at a point is the component of the error vector along the
  // normal. Empty: the error is the length of the error vector.
  std::vector<Eigen::Vector3d> normal;
};

struct PartShare {
  double rms_m = 0;  // rms error of the layer or cause
  Interval rms_interval_m;
  double share = 0;  // share in the sum of all mean squares; NaN: all errors are 0
  Interval share_interval;
};

struct PartError {
  double p95_m = 0;
  Interval p95_interval_m;
  double max_m = 0;
  Interval max_interval_m;
  // Index of the point with the largest expected square of the error, that is |sum of the values|²
  // + u². If no cause has a u, it is the point with the largest error.
  std::size_t worst = 0;
  std::vector<PartShare> layers, causes;
};

struct PartTrials {
  std::uint64_t seed = 1;
  std::size_t shares = 2000, errors = 400;
};

// Calculates intervals of 95 % by the Monte Carlo method with random xi and eta (README.md). If a
// cause has a known u and an unknown value (a budget), its stated mean square is the expected one.
PartError part_error(const PartPath& path, const std::vector<PartCause>& causes, std::size_t layers,
                     const PartTrials& trials = {});

}  // namespace mdof::algo
