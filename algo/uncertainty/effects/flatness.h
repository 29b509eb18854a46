// The unknown height of a target plane: a random surface, isotropic and continuous in direction.
//
// Heights are normal, with standard deviation u, and two places r apart have the covariance
//   C(r) = u² Σ k⁻⁴ J₀(2π k r/L) / Σ k⁻⁴,  k = 1 … kFlatnessWaves
// The surface consists of waves of the lengths L, L/2, … with the weights 1/k² of a sensitivity
// study; all directions and phases are equally likely. A wave of random direction has the
// covariance J₀. A reading counts the change of the height since d = 0, where the probe was zeroed.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "schema/axis.h"

namespace mdof::algo {

// 1 - J₀(x), accurate to 3e-11, and to rounding for a small x.
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
  // Covariance of two heights, each relative to its own height at d = 0.
  double zeroed_m2(const Footprint& a, const Footprint& b) const;

 private:
  double variance_m2_, length_m_;
};

// Heights of the footprints relative to those at d = 0, as in independent_parts():
// kMostFlatnessParts columns at most.
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

// Changes of the errors of all points of each run by each independent part of a surface that all
// these runs share: [run][part][point].
std::vector<std::vector<std::vector<Errors5>>> flatness_parts(
    const std::vector<const PlaneFootprints*>& runs);

}  // namespace mdof::algo
