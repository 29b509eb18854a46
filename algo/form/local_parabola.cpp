#include "algo/form/local_parabola.h"

#include <algorithm>
#include <cmath>

#include "algo/linear_algebra/least_squares.h"

namespace mdof::algo {
namespace {

constexpr int kTerms = 6;
// z = c0 + c1 u + c2 v + c3 u^2 + c4 u v + c5 v^2. u and v are coordinates about the centre, in
// units of half the side of the square.
std::array<double, kTerms> terms(double u, double v) {
  return {{1, u, v, u * u, u * v, v * v}};
}

// Number of pixels in half a side, at most the number of pixels of the map.
std::ptrdiff_t pixels(double half_side_m, double pixel_m, std::size_t of_map) {
  return static_cast<std::ptrdiff_t>(
      std::min(std::floor(half_side_m / pixel_m + 1e-9), static_cast<double>(of_map)));
}

}  // namespace

LocalParabola::LocalParabola(const SurfaceMap& map, double side_m, double least_share)
    : map_(map),
      ni_(pixels(side_m / 2, map.dx_m, map.nx)),
      nj_(pixels(side_m / 2, map.dy_m, map.ny)),
      half_x_m_(static_cast<double>(ni_) * map.dx_m),
      half_y_m_(static_cast<double>(nj_) * map.dy_m),
      least_share_(least_share) {
  const bool fits = 2 * ni_ < static_cast<std::ptrdiff_t>(map.nx) &&
                    2 * nj_ < static_cast<std::ptrdiff_t>(map.ny);
  if (!is_large_enough() || !fits) return;
  // A complete square has the same weights everywhere.
  Eigen::MatrixXd A(static_cast<Eigen::Index>(size()), kTerms);
  Eigen::Index row = 0;
  for (std::ptrdiff_t b = -nj_; b <= nj_; ++b)
    for (std::ptrdiff_t a = -ni_; a <= ni_; ++a, ++row) {
      const auto t = terms(static_cast<double>(a) / static_cast<double>(ni_),
                           static_cast<double>(b) / static_cast<double>(nj_));
      for (int k = 0; k < kTerms; ++k) A(row, k) = t[static_cast<std::size_t>(k)];
    }
  const ThinQr qr = thin_qr(A);
  const Eigen::MatrixXd inverse = qr.R.triangularView<Eigen::Upper>().solve(qr.Q.transpose());
  constexpr std::array<Eigen::Index, 4> kWanted{{0, 3, 4, 5}};
  for (std::size_t k = 0; k < kWanted.size(); ++k)
    for (Eigen::Index r = 0; r < A.rows(); ++r) weight_[k].push_back(inverse(kWanted[k], r));
}

bool LocalParabola::at(std::size_t i, std::size_t j, Parabola& found) const {
  const auto ii = static_cast<std::ptrdiff_t>(i), jj = static_cast<std::ptrdiff_t>(j);
  if (ii >= ni_ && jj >= nj_ && ii + ni_ < static_cast<std::ptrdiff_t>(map_.nx) &&
      jj + nj_ < static_cast<std::ptrdiff_t>(map_.ny)) {
    std::array<double, 4> c{};
    std::size_t k = 0;
    for (std::ptrdiff_t b = -nj_; b <= nj_; ++b) {
      const double* z = map_.z_m.data() + (jj + b) * static_cast<std::ptrdiff_t>(map_.nx) + ii;
      for (std::ptrdiff_t a = -ni_; a <= ni_; ++a, ++k)
        for (std::size_t t = 0; t < c.size(); ++t) c[t] += weight_[t][k] * z[a];
    }
    if (!std::isnan(c[0])) {
      found = in_m(c);
      return true;
    }
  }
  return fitted(ii, jj, found);
}

Parabola LocalParabola::in_m(const std::array<double, 4>& c) const {
  return {c[0], 2 * c[1] / (half_x_m_ * half_x_m_), 2 * c[3] / (half_y_m_ * half_y_m_),
          c[2] / (half_x_m_ * half_y_m_)};
}

// Fit to the measured pixels of the square: normal equations by Cholesky's method.
bool LocalParabola::fitted(std::ptrdiff_t i, std::ptrdiff_t j, Parabola& found) const {
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
  if (static_cast<double>(count) < least_share_ * static_cast<double>(size())) return false;
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
  found = in_m({{A[0][kTerms], A[3][kTerms], A[4][kTerms], A[5][kTerms]}});
  return true;
}

}  // namespace mdof::algo
