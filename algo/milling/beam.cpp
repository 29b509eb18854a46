#include "algo/milling/beam.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mdof::algo {
namespace {

constexpr double kPoisson = 0.22;
constexpr double kShearCoefficient = 6 * (1 + kPoisson) / (7 + 6 * kPoisson);

double second_moment(double diameter_m) {
  return std::numbers::pi * std::pow(diameter_m, 4) / 64;
}

// Returns ∫ (a - s)(b - s) ds from s0 to s1.
double moments(double a, double b, double s0, double s1) {
  const auto antiderivative = [&](double s) { return s * (a * b + s * (-(a + b) / 2 + s / 3)); };
  return antiderivative(s1) - antiderivative(s0);
}

// a, b: distances of the two points from the fixed end. The product of the bending moments is 0
// beyond the point that is nearer to the fixed end.
double compliance(const std::vector<ToolSection>& from_holder, double youngs_modulus_Pa, double a,
                  double b) {
  double sum = 0, begin = 0;
  const double last = std::min(a, b);
  for (const ToolSection& section : from_holder) {
    const double end = std::min(begin + section.length_m, last);
    if (end > begin)
      sum += moments(a, b, begin, end) / (youngs_modulus_Pa * second_moment(section.diameter_m));
    begin += section.length_m;
  }
  return sum;
}

double length(const std::vector<ToolSection>& sections) {
  double sum = 0;
  for (const ToolSection& section : sections) sum += section.length_m;
  return sum;
}

}  // namespace

Eigen::MatrixXd beam_compliance(const std::vector<ToolSection>& from_holder,
                                double youngs_modulus_Pa, const std::vector<double>& at_m,
                                const std::vector<double>& of_m) {
  const double overhang = length(from_holder);
  Eigen::MatrixXd C(at_m.size(), of_m.size());
  for (std::size_t i = 0; i < at_m.size(); ++i)
    for (std::size_t j = 0; j < of_m.size(); ++j)
      C(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          compliance(from_holder, youngs_modulus_Pa, overhang - at_m[i], overhang - of_m[j]);
  return C;
}

double shear_share(const std::vector<ToolSection>& from_holder) {
  const double overhang = length(from_holder);
  double shear = 0;  // times E: ∫ E / (κ G A) ds
  for (const ToolSection& section : from_holder)
    shear += section.length_m * 2 * (1 + kPoisson) /
             (kShearCoefficient * std::numbers::pi * section.diameter_m * section.diameter_m / 4);
  return shear / compliance(from_holder, 1, overhang, overhang);
}

}  // namespace mdof::algo
