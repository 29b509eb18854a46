#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "algo/form/clamping.h"
#include "algo/linear_algebra/least_squares.h"
#include "schema/base/number/number_text.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

// z = c0 + c1 u + c2 v + c3 u^2 + c4 u v + c5 v^2, u and v in half sides of the square.
constexpr int kTerms = 6;
std::array<double, kTerms> terms(double u, double v) {
  return {{1, u, v, u * u, u * v, v * v}};
}

struct Curvature {
  double xx = 0, yy = 0, xy = 0;
};

class Square {
 public:
  Square(const SurfaceMap& map, double side_m)
      : map_(map),
        ni_(static_cast<std::ptrdiff_t>(std::floor(side_m / 2 / map.dx_m + 1e-9))),
        nj_(static_cast<std::ptrdiff_t>(std::floor(side_m / 2 / map.dy_m + 1e-9))),
        half_x_m_(static_cast<double>(ni_) * map.dx_m),
        half_y_m_(static_cast<double>(nj_) * map.dy_m) {
    if (ni_ < 1 || nj_ < 1) return;
    // Of a whole square the same weights everywhere.
    Eigen::MatrixXd A(size(), kTerms);
    Eigen::Index row = 0;
    each([&](double u, double v, std::size_t) {
      const auto t = terms(u, v);
      for (int k = 0; k < kTerms; ++k) A(row, k) = t[static_cast<std::size_t>(k)];
      ++row;
    });
    const Eigen::MatrixXd inverse = LeastNorm(A).inverse();
    for (int k = 0; k < 3; ++k) {
      weight_[static_cast<std::size_t>(k)].resize(static_cast<std::size_t>(size()));
      for (Eigen::Index r = 0; r < size(); ++r)
        weight_[static_cast<std::size_t>(k)][static_cast<std::size_t>(r)] = inverse(3 + k, r);
    }
  }

  bool is_large_enough() const { return ni_ >= 1 && nj_ >= 1; }

  // False: less than half of the square has heights, or they do not determine a parabola.
  bool at(std::size_t i, std::size_t j, Curvature& curvature) const {
    const auto ii = static_cast<std::ptrdiff_t>(i), jj = static_cast<std::ptrdiff_t>(j);
    if (ii >= ni_ && jj >= nj_ && ii + ni_ < static_cast<std::ptrdiff_t>(map_.nx) &&
        jj + nj_ < static_cast<std::ptrdiff_t>(map_.ny)) {
      double uu = 0, uv = 0, vv = 0;
      std::size_t k = 0;
      for (std::ptrdiff_t b = -nj_; b <= nj_; ++b) {
        const double* z = map_.z_m.data() + (jj + b) * static_cast<std::ptrdiff_t>(map_.nx) + ii;
        for (std::ptrdiff_t a = -ni_; a <= ni_; ++a, ++k) {
          uu += weight_[0][k] * z[a];
          uv += weight_[1][k] * z[a];
          vv += weight_[2][k] * z[a];
        }
      }
      if (!std::isnan(uu)) {
        curvature = in_m(uu, uv, vv);
        return true;
      }
    }
    return fitted(ii, jj, curvature);
  }

 private:
  Eigen::Index size() const { return static_cast<Eigen::Index>((2 * ni_ + 1) * (2 * nj_ + 1)); }
  template <class F>
  void each(F&& f) const {
    std::size_t k = 0;
    for (std::ptrdiff_t b = -nj_; b <= nj_; ++b)
      for (std::ptrdiff_t a = -ni_; a <= ni_; ++a)
        f(static_cast<double>(a) / static_cast<double>(ni_),
          static_cast<double>(b) / static_cast<double>(nj_), k++);
  }
  Curvature in_m(double uu, double uv, double vv) const {
    return {2 * uu / (half_x_m_ * half_x_m_), 2 * vv / (half_y_m_ * half_y_m_),
            uv / (half_x_m_ * half_y_m_)};
  }

  // Of what is measured in the square: normal equations by Cholesky's method.
  bool fitted(std::ptrdiff_t i, std::ptrdiff_t j, Curvature& curvature) const {
    std::array<std::array<double, kTerms + 1>, kTerms> A{};
    std::size_t count = 0;
    for (std::ptrdiff_t b = -nj_; b <= nj_; ++b)
      for (std::ptrdiff_t a = -ni_; a <= ni_; ++a) {
        if (i + a < 0 || j + b < 0 || i + a >= static_cast<std::ptrdiff_t>(map_.nx) ||
            j + b >= static_cast<std::ptrdiff_t>(map_.ny))
          continue;
        const double z = map_.at(static_cast<std::size_t>(i + a), static_cast<std::size_t>(j + b));
        if (std::isnan(z)) continue;
        ++count;
        const auto t = terms(static_cast<double>(a) / static_cast<double>(ni_),
                             static_cast<double>(b) / static_cast<double>(nj_));
        for (std::size_t r = 0; r < kTerms; ++r) {
          for (std::size_t c = 0; c <= r; ++c) A[r][c] += t[r] * t[c];
          A[r][kTerms] += t[r] * z;
        }
      }
    if (2 * count < static_cast<std::size_t>(size())) return false;
    for (std::size_t r = 0; r < kTerms; ++r) {
      const double whole = A[r][r];
      for (std::size_t c = 0; c <= r; ++c) {
        for (std::size_t k = 0; k < c; ++k) A[r][c] -= A[r][k] * A[c][k];
        if (c < r) A[r][c] /= A[c][c];
      }
      if (!(A[r][r] > 1e-9 * whole)) return false;
      A[r][r] = std::sqrt(A[r][r]);
      for (std::size_t k = 0; k < r; ++k) A[r][kTerms] -= A[r][k] * A[k][kTerms];
      A[r][kTerms] /= A[r][r];
    }
    for (std::size_t r = kTerms; r-- > 0;) {
      for (std::size_t k = r + 1; k < kTerms; ++k) A[r][kTerms] -= A[k][r] * A[k][kTerms];
      A[r][kTerms] /= A[r][r];
    }
    curvature = in_m(A[3][kTerms], A[4][kTerms], A[5][kTerms]);
    return true;
  }

  const SurfaceMap& map_;
  std::ptrdiff_t ni_, nj_;
  double half_x_m_, half_y_m_;
  std::array<std::vector<double>, 3> weight_;  // of u^2, u v, v^2
};

double von_mises_Pa(const Curvature& c, const Plate& plate) {
  const double stiffness = plate.youngs_modulus_Pa * plate.thickness_m / 2;
  const double plane = stiffness / (1 - plate.poisson * plate.poisson);
  const double x = plane * (c.xx + plate.poisson * c.yy), y = plane * (c.yy + plate.poisson * c.xx);
  const double shear = stiffness / (1 + plate.poisson) * c.xy;
  return std::sqrt(x * x - x * y + y * y + 3 * shear * shear);
}

}  // namespace

Result<PlateStress> plate_stress(const SurfaceMap& form, const Plate& plate, double smooth_m) {
  const Square square(form, smooth_m);
  if (!square.is_large_enough())
    return fail(ErrorCode::usage, plain_number(to_mm(smooth_m)) + " mm are less than two pixels (" +
                                      plain_number(to_mm(form.dx_m)) + " x " +
                                      plain_number(to_mm(form.dy_m)) +
                                      " mm); a curvature needs a square of 3 x 3 pixels");
  PlateStress stress;
  for (std::size_t j = 0; j < form.ny; ++j)
    for (std::size_t i = 0; i < form.nx; ++i) {
      Curvature curvature;
      if (std::isnan(form.at(i, j)) || !square.at(i, j, curvature)) continue;
      ++stress.pixels;
      const double at_Pa = von_mises_Pa(curvature, plate);
      if (at_Pa <= stress.max_Pa) continue;
      stress.max_Pa = at_Pa;
      stress.x_m = form.x_m(i);
      stress.y_m = form.y_m(j);
    }
  if (stress.pixels > 0) return stress;
  return bad_input(form.name +
                   ": no pixel has half of the square of smoothing about it; take a "
                   "smaller one");
}

}  // namespace mdof::algo
