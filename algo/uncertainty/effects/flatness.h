// The unknown heights of a target plane, described as a random surface that is isotropic.
//
// The heights have a normal distribution with the standard deviation u. The heights of two places
// at the distance r have the covariance
//   C(r) = u² Σ k⁻⁴ J₀(2π k r/L) / Σ k⁻⁴,  k = 1 … kFlatnessWaves
// L is the length of the longest wave. The surface is a sum of waves of the lengths L/k with the
// amplitudes 1/k², as in a sensitivity study. All directions and phases of a wave are equally
// likely, so its covariance is J₀. The probes were zeroed at d = 0. Therefore a reading contains
// the height minus the height at d = 0.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "schema/axis.h"

namespace mdof::algo {

// 1 - J₀(x) with an error below 3e-11; for small x the error is rounding only.
double one_minus_bessel_j0(double x);

// The points where the line of a probe meets the plane, now (`place`) and at d = 0 (`zero`); frame
// C.
struct Footprint {
  Eigen::Vector3d place, zero;
};

class FlatnessCovariance {
 public:
  FlatnessCovariance(double u_m, double length_m) : variance_m2_(u_m * u_m), length_m_(length_m) {}
  // u² - C(r).
  double semivariogram_m2(double apart_m) const;
  // Covariance of two heights. Each height is relative to the height at d = 0 on the line of the
  // same probe.
  double zeroed_m2(const Footprint& a, const Footprint& b) const;

 private:
  double variance_m2_, length_m_;
};

// Heights of the footprints relative to the heights at d = 0, as independent parts: one row for
// each footprint, at most kMostFlatnessParts columns (independent_parts()).
inline constexpr std::size_t kMostFlatnessParts = 256;
Eigen::MatrixXd independent_heights(const FlatnessCovariance& covariance,
                                    const std::vector<Footprint>& footprints);

// Footprints and readings of one plane in one run.
struct PlaneFootprints {
  double u_m = 0, length_m = 0;
  std::vector<Footprint> footprints;  // one for each probe at each target
  struct Reading {
    std::size_t point, footprint;
    Errors5 by_height;  // change of the point's errors by 1 m of height
  };
  std::vector<Reading> readings;
  std::size_t points = 0;
};

// Changes of the errors by each independent part of one surface that all these runs measured:
// [run][part][point].
std::vector<std::vector<std::vector<Errors5>>> flatness_parts(
    const std::vector<const PlaneFootprints*>& runs);

}  // namespace mdof::algo
