#include "algo/separation/unseen.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "schema/base/number/number_text.h"
#include "schema/base/random.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kNothing = 1e-6;  // a smaller remainder of a shape of norm 1 is rounding

// Collects the unseen shapes that have a name, as an orthonormal basis.
class Named {
 public:
  explicit Named(const MatrixXd& unseen) : unseen_(unseen), basis_(unseen.rows(), 0) {}

  // Adds `shapes` to the basis if all of them are unseen. Returns the number of new directions; 0
  // if one of the shapes is not unseen, or if no direction is new.
  std::size_t take(const std::vector<VectorXd>& shapes) {
    MatrixXd fresh(unseen_.rows(), 0);
    for (VectorXd v : shapes) {
      if (v.norm() < kNothing) continue;
      v.normalize();
      if ((v - unseen_ * (unseen_.transpose() * v)).norm() > kNothing) return 0;
      append(fresh, less(less(v, basis_), fresh));
    }
    for (Index i = 0; i < fresh.cols(); ++i) append(basis_, fresh.col(i));
    return static_cast<std::size_t>(fresh.cols());
  }

  // The unseen shapes that have no name, as orthonormal columns.
  MatrixXd rest() const {
    MatrixXd rest(unseen_.rows(), 0);
    for (Index i = 0; i < unseen_.cols(); ++i)
      append(rest, less(less(unseen_.col(i), basis_), rest));
    return rest;
  }

 private:
  // Removes the components along `basis` from `v`. The second removal corrects the rounding of the
  // first one (Gram-Schmidt).
  static VectorXd less(const VectorXd& v, const MatrixXd& basis) {
    const VectorXd once = v - basis * (basis.transpose() * v);
    return once - basis * (basis.transpose() * once);
  }
  static void append(MatrixXd& basis, const VectorXd& v) {
    if (v.norm() < kNothing) return;
    basis.conservativeResize(Eigen::NoChange, basis.cols() + 1);
    basis.col(basis.cols() - 1) = v.normalized();
  }

  const MatrixXd& unseen_;
  MatrixXd basis_;
};

// The places, converted to -1 ... 1.
VectorXd scaled(const std::vector<double>& places_m) {
  const double middle = (places_m.front() + places_m.back()) / 2;
  const double half = std::max((places_m.back() - places_m.front()) / 2, 1e-12);
  VectorXd t(static_cast<Index>(places_m.size()));
  for (Index i = 0; i < t.size(); ++i)
    t(i) = (places_m[static_cast<std::size_t>(i)] - middle) / half;
  return t;
}

std::vector<VectorXd> period_shapes(const std::vector<double>& places_m, double period_m) {
  VectorXd sine(static_cast<Index>(places_m.size())), cosine = sine;
  for (Index i = 0; i < sine.size(); ++i) {
    const double turns = (places_m[static_cast<std::size_t>(i)] - places_m.front()) / period_m;
    sine(i) = sine_of_turns(turns);
    cosine(i) = sine_of_turns(turns + 0.25);
  }
  return {cosine, sine};
}

std::string mm_text(double m) {
  return plain_number(to_mm(m), 7) + " mm";
}

// +1 if all columns are symmetric about the middle of the places, -1 if all are antisymmetric;
// otherwise 0.
int symmetry(const std::vector<double>& places_m, const MatrixXd& shapes) {
  const std::size_t n = places_m.size();
  const double sum = places_m.front() + places_m.back();
  for (std::size_t i = 0; i < n; ++i)
    if (std::abs(places_m[i] + places_m[n - 1 - i] - sum) >
        0.1 * std::max(places_m.back() - places_m.front(), 1e-12) / static_cast<double>(n))
      return 0;
  const MatrixXd mirrored = shapes.colwise().reverse();
  if ((mirrored - shapes).norm() < kNothing * static_cast<double>(n)) return 1;
  return (mirrored + shapes).norm() < kNothing * static_cast<double>(n) ? -1 : 0;
}

std::string rest_name(const std::vector<double>& places_m, const MatrixXd& rest) {
  const std::string count =
      std::to_string(rest.cols()) + (rest.cols() == 1 ? " more shape" : " more shapes");
  const std::string middle = mm_text((places_m.front() + places_m.back()) / 2);
  Index first = rest.rows() - 1, last = 0;
  for (Index i = 0; i < rest.rows(); ++i) {
    if (rest.row(i).norm() < kNothing) continue;
    first = std::min(first, i);
    last = i;
  }
  if (first == last) return count + " at " + mm_text(places_m[static_cast<std::size_t>(first)]);
  const int symmetric = symmetry(places_m, rest);
  if (symmetric != 0)
    return count + (symmetric > 0 ? " symmetric about " : " antisymmetric about ") + middle;
  return count + ", from " + mm_text(places_m[static_cast<std::size_t>(first)]) + " to " +
         mm_text(places_m[static_cast<std::size_t>(last)]);
}

}  // namespace

std::vector<UndeterminedShape> named_shapes(const std::vector<double>& places_m,
                                            const MatrixXd& unseen,
                                            const std::vector<double>& periods_m) {
  std::vector<UndeterminedShape> names;
  Named named(unseen);
  const auto try_name = [&](const std::string& name, const std::vector<VectorXd>& shapes) {
    if (const std::size_t dimensions = named.take(shapes)) names.push_back({name, dimensions});
  };
  const VectorXd t = scaled(places_m);
  try_name("offset", {VectorXd::Ones(t.size())});
  try_name("slope", {t});
  try_name("parabola", {t.cwiseProduct(t)});
  for (const double period_m : periods_m)
    try_name("period " + mm_text(period_m), period_shapes(places_m, period_m));
  const MatrixXd rest = named.rest();
  if (rest.cols() > 0)
    names.push_back({rest_name(places_m, rest), static_cast<std::size_t>(rest.cols())});
  return names;
}

std::vector<double> hidden_periods(const std::vector<double>& ways_m, double step_m,
                                   double match_m) {
  double divisor = 0;
  for (double rest : ways_m) {
    rest = std::abs(rest);
    while (rest > match_m) {
      const double next = std::abs(std::remainder(divisor, rest));
      divisor = rest;
      rest = next;
    }
  }
  std::vector<double> periods;
  if (!(step_m > 0)) return periods;
  for (int part = 1; divisor / part > 2 * step_m - match_m; ++part)
    periods.push_back(divisor / part);
  return periods;
}

}  // namespace mdof::algo
