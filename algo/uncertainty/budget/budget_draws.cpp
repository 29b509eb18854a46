#include "algo/uncertainty/budget/budget_draws.h"

#include <algorithm>
#include <cmath>

#include "schema/base/random.h"

namespace mdof::algo {
namespace {

constexpr double kMostFreedom = 10000;  // degrees of freedom; the normal distribution is used above
                                        // this limit

Distribution distribution_of(const DeclaredUncertainty& declared) {
  Distribution d;
  const auto limited = [&](Distribution::Kind kind, double half_width) {
    d.kind = kind;
    d.low = -half_width;
    d.high = half_width;
  };
  switch (declared.shape) {
    case UncertaintyShape::rectangular:
      limited(Distribution::Kind::rectangular, std::sqrt(3.0));
      break;
    case UncertaintyShape::triangular:
      limited(Distribution::Kind::triangular, std::sqrt(6.0));
      break;
    case UncertaintyShape::u_shaped:
      limited(Distribution::Kind::u_shaped, std::sqrt(2.0));
      break;
    case UncertaintyShape::normal:
      d.kind = Distribution::Kind::normal;
      d.spread = 1;
      if (declared.freedom <= kMostFreedom) {
        d.kind = Distribution::Kind::t;
        d.dof = declared.freedom;
      }
  }
  return d;
}

}  // namespace

UnitQuantity::UnitQuantity(const DeclaredUncertainty& declared)
    : normal_(declared.shape == UncertaintyShape::normal && !(declared.freedom <= kMostFreedom)),
      quantile_(distribution_of(declared)) {}

UnitQuantity::UnitQuantity(double freedom)
    : UnitQuantity(DeclaredUncertainty{1, UncertaintyShape::normal, freedom}) {}

void UnitQuantity::quantiles(std::span<double> p) const {
  if (normal_) return gaussians(p);
  for (double& each : p) each = quantile_.at(each);
}

double student_factor(double normal, double freedom) {
  constexpr double kLeastRoot = 0.1;
  if (!std::isfinite(freedom)) return 1;
  const double variance = 2 / (9 * freedom);
  const double root = 1 - variance + normal * std::sqrt(variance);
  return std::pow(std::max(root, kLeastRoot), -1.5);
}

BlockOfDraws::BlockOfDraws(const Stream& from, std::uint64_t first, std::uint64_t trials)
    : from_(from), first_(first) {
  pair_.fill(std::vector<double>(trials));
}

std::vector<double> BlockOfDraws::next() {
  if (quantity_ % 2 == 0) draw_pairs(from_, quantity_ / 2, first_, 1, pair_[0], pair_[1]);
  return pair_[quantity_++ % 2];
}

std::vector<double> BlockOfDraws::next(const UnitQuantity& quantity) {
  std::vector<double> drawn = next();
  quantity.quantiles(drawn);
  return drawn;
}

}  // namespace mdof::algo
