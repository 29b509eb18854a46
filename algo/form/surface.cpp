#include "algo/form/surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

namespace mdof::algo {
namespace {

// Additional rounds of extrapolation, for the pixels that slopes at corners use.
constexpr std::size_t kForSlopes = 6;
constexpr double kOnPixel = 1e-9;  // in pixels: a place nearer to a pixel uses only this pixel
// In pixels: at a place nearer than this to one pixel, the next pixel may be missing. Without this
// tolerance, the rounding of a movement would remove the outermost pixels.
constexpr double kBorderTolerance = 0.01;

// Weights of the pixels -2 ... 3 of a row for the height at t in [0, 1] between pixels 0 and 1, and
// for its derivative.
struct Weights {
  std::array<double, 6> value{}, slope{};
};

// Adds the terms with derivatives of Hermite's cubic h00 f0 + h10 d0 + h01 f1 + h11 d1. The
// derivative at pixel 0 is d0 = (f(-2) - 8 f(-1) + 8 f(1) - f(2)) / 12.
void add_derivative(double at_0, double at_1, std::array<double, 6>& w) {
  constexpr std::array<double, 5> kFive = {{1. / 12, -8. / 12, 0, 8. / 12, -1. / 12}};
  for (std::size_t k = 0; k < 5; ++k) {
    w[k] += at_0 * kFive[k];
    w[k + 1] += at_1 * kFive[k];
  }
}
// at_0, at_1: factors of the terms with height and derivative at the pixels 0 and 1.
Weights six(double t, double at_0 = 1, double at_1 = 1) {
  const double u = 1 - t;
  Weights w;
  w.value[2] = at_0 * ((1 + 2 * t) * u * u);
  w.value[3] = at_1 * ((3 - 2 * t) * t * t);
  add_derivative(at_0 * (t * u * u), at_1 * (-t * t * u), w.value);
  w.slope[2] = at_0 * (-6 * t * u);
  w.slope[3] = at_1 * (6 * t * u);
  add_derivative(at_0 * (u * (u - 2 * t)), at_1 * (t * (t - 2 * u)), w.slope);
  return w;
}
Weights four(double t) {
  const double u = 1 - t;
  Weights w;
  w.value = {{0, -t * u * u / 2, (1 + 2 * t) * u * u + t * t * u / 2,
              (3 - 2 * t) * t * t + t * u * u / 2, -t * t * u / 2, 0}};
  const double d0 = u * (u - 2 * t) / 2, d1 = t * (t - 2 * u) / 2;
  w.slope = {{0, -d0, -6 * t * u - d1, 6 * t * u + d0, d1, 0}};
  return w;
}
Weights two(double t) {
  return {{{0, 0, 1 - t, t, 0, 0}}, {{0, 0, -1, 1, 0, 0}}};
}

// Weights for the extrapolation from n = 1 ... 4 pixels: weights[n - 1], from the nearest pixel to
// the farthest.
constexpr std::array<std::array<double, 4>, 4> kLine = {
    {{{1, 0, 0, 0}}, {{2, -1, 0, 0}}, {{4. / 3, 1. / 3, -2. / 3, 0}}, {{1, 0.5, 0, -0.5}}}};
constexpr std::array<std::array<double, 4>, 4> kParabola = {
    {{{1, 0, 0, 0}}, {{2, -1, 0, 0}}, {{3, -3, 1, 0}}, {{3, -3, 1, 0}}}};

}  // namespace

Surface::Surface(const SurfaceMap& map, std::size_t extension, Extension how)
    : dx_m_(map.dx_m), dy_m_(map.dy_m) {
  const std::size_t rings = std::min<std::size_t>(extension + kForSlopes, kNone - 1);
  const std::size_t pad = rings + 3;  // at() reads three pixels beyond every other pixel
  nx_ = map.nx + 2 * pad;
  ny_ = map.ny + 2 * pad;
  x0_m_ = map.x_m(0);
  y0_m_ = map.y_m(0);
  x0_m_ -= static_cast<double>(pad) * dx_m_;
  y0_m_ -= static_cast<double>(pad) * dy_m_;
  z_m_.assign(nx_ * ny_, SurfaceMap::kMissing);
  ring_.assign(nx_ * ny_, kNone);
  for (std::size_t j = 0; j < map.ny; ++j)
    for (std::size_t i = 0; i < map.nx; ++i)
      if (const double z = map.at(i, j); !std::isnan(z)) {
        z_m_[(j + pad) * nx_ + i + pad] = z;
        ring_[(j + pad) * nx_ + i + pad] = 0;
      }
  if (how == Extension::line) {
    const std::vector<double> z_m = z_m_;
    const std::vector<std::uint8_t> ring = ring_;
    extend(kForSlopes, Extension::parabola);
    near_m_ = std::exchange(z_m_, z_m);
    ring_ = ring;
  }
  extend(rings, how);
}

void Surface::extend(std::size_t rings, Extension how) {
  const auto& weights = how == Extension::line ? kLine : kParabola;
  const std::array<std::ptrdiff_t, 4> ways = {
      {1, -1, static_cast<std::ptrdiff_t>(nx_), -static_cast<std::ptrdiff_t>(nx_)}};
  std::vector<std::size_t> front, next;
  // The first round extrapolates the missing pixels beside a measured pixel. A later round
  // extrapolates the missing pixels beside the pixels of the round before.
  for (std::size_t k = 3 * nx_; k + 3 * nx_ < z_m_.size(); ++k)
    if (ring_[k] == kNone)
      for (const auto way : ways)
        if (ring_[k + static_cast<std::size_t>(way)] == 0) {
          front.push_back(k);
          break;
        }
  for (std::size_t ring = 1; ring <= rings && !front.empty(); ++ring) {
    std::vector<double> filled;
    filled.reserve(front.size());
    for (const std::size_t k : front) {
      std::size_t most = 0;
      double sum = 0, count = 0;
      for (const auto way : ways) {
        std::array<double, 4> z{};
        std::size_t n = 0;
        for (std::size_t at = k; n < 4; ++n) {
          at += static_cast<std::size_t>(way);
          if (at >= z_m_.size() || ring_[at] >= ring) break;
          z[n] = z_m_[at];
        }
        if (n == 0 || n < most) continue;
        if (n > most) sum = count = 0;
        most = n;
        double value = 0;
        for (std::size_t i = 0; i < n; ++i) value += weights[n - 1][i] * z[i];
        sum += value;
        count += 1;
      }
      filled.push_back(sum / count);
    }
    for (std::size_t i = 0; i < front.size(); ++i) {
      z_m_[front[i]] = filled[i];
      ring_[front[i]] = static_cast<std::uint8_t>(ring);
    }
    next.clear();
    for (const std::size_t k : front)
      for (const auto way : ways)
        if (const std::size_t beside = k + static_cast<std::size_t>(way); ring_[beside] == kNone)
          next.push_back(beside);
    std::sort(next.begin(), next.end());
    next.erase(std::unique(next.begin(), next.end()), next.end());
    front.swap(next);
  }
}

bool Surface::at(double x_m, double y_m, std::size_t rings, SurfacePoint& point) const {
  double x = (x_m - x0_m_) / dx_m_, y = (y_m - y0_m_) / dy_m_;
  if (const double near = std::nearbyint(x); std::abs(x - near) < kOnPixel) x = near;
  if (const double near = std::nearbyint(y); std::abs(y - near) < kOnPixel) y = near;
  if (!(x >= 2 && y >= 2 && x < static_cast<double>(nx_) - 3 && y < static_cast<double>(ny_) - 3))
    return false;
  const auto i = static_cast<std::size_t>(x), j = static_cast<std::size_t>(y);
  const double tx = x - static_cast<double>(i), ty = y - static_cast<double>(j);
  const std::uint8_t* const ring = ring_.data() + j * nx_ + i;
  std::uint8_t farthest = 0;
  const bool left = tx<1 - kBorderTolerance, right = tx> kBorderTolerance,
             below = ty<1 - kBorderTolerance, above = ty> kBorderTolerance;
  if (left && below) farthest = std::max(farthest, ring[0]);
  if (right && below) farthest = std::max(farthest, ring[1]);
  if (left && above) farthest = std::max(farthest, ring[nx_]);
  if (right && above) farthest = std::max(farthest, ring[nx_ + 1]);
  if (farthest > rings || farthest == kNone) return false;
  const std::size_t corner = (j - 2) * nx_ + i - 2;
  const bool has_near = !near_m_.empty(), is_measured = farthest == 0;
  const double* z = (has_near && is_measured ? near_m_ : z_m_).data() + corner;
  const auto sum = [&](const Weights& wx, const Weights& wy, std::size_t first, std::size_t last) {
    double value = 0, slope_x = 0, slope_y = 0;
    for (std::size_t b = first; b <= last; ++b) {
      const double* const row = z + b * nx_;
      double v = 0, s = 0;
      for (std::size_t a = first; a <= last; ++a) {
        v += wx.value[a] * row[a];
        s += wx.slope[a] * row[a];
      }
      value += wy.value[b] * v;
      slope_x += wy.value[b] * s;
      slope_y += wy.slope[b] * v;
    }
    point = {value, slope_x / dx_m_, slope_y / dy_m_};
    return !std::isnan(value) && !std::isnan(slope_x) && !std::isnan(slope_y);
  };
  // Between measured and extrapolated pixels, each corner has the slopes of its own kind, so that
  // the surface and its slopes stay continuous.
  const auto sum_of_corners = [&] {
    SurfacePoint all;
    for (const std::size_t b : {0, 1})
      for (const std::size_t a : {0, 1}) {
        z = (ring[b * nx_ + a] == 0 ? near_m_ : z_m_).data() + corner;
        const bool is_known = sum(six(tx, a == 0, a == 1), six(ty, b == 0, b == 1), 0, 5);
        z = z_m_.data() + corner;
        if (!is_known) return false;
        all = {all.z_m + point.z_m, all.slope_x + point.slope_x, all.slope_y + point.slope_y};
      }
    point = all;
    return true;
  };
  const bool is_mixed =
      has_near && !is_measured && std::min({ring[0], ring[1], ring[nx_], ring[nx_ + 1]}) == 0;
  if (is_mixed && sum_of_corners()) return true;
  if (sum(six(tx), six(ty), 0, 5) || sum(four(tx), four(ty), 1, 4)) return true;
  // Linear interpolation. A pixel with a negligible contribution may be missing.
  const auto pixel = [&](std::size_t a, std::size_t b, double otherwise) {
    const double found = z[(b + 2) * nx_ + a + 2];
    return std::isnan(found) ? otherwise : found;
  };
  const double z00 = pixel(0, 0, 0), z10 = pixel(1, 0, z00), z01 = pixel(0, 1, z00),
               z11 = pixel(1, 1, z10 + z01 - z00);
  const Weights wx = two(tx), wy = two(ty);
  point.z_m = wy.value[2] * (wx.value[2] * z00 + wx.value[3] * z10) +
              wy.value[3] * (wx.value[2] * z01 + wx.value[3] * z11);
  point.slope_x = (wy.value[2] * (z10 - z00) + wy.value[3] * (z11 - z01)) / dx_m_;
  point.slope_y = (wx.value[2] * (z01 - z00) + wx.value[3] * (z11 - z10)) / dy_m_;
  return true;
}

double overshoot_m(const SurfaceMap& map, double x_centre_m, double y_centre_m, double radius_m) {
  // A sine of six pixels leaves the range by 1.24 times the height that its curvature explains.
  constexpr double kShortWaves = 1.25;
  double largest = 0;
  // z[-2 step] ... z[3 step] are six pixels of a row or column. NaN if one of them is missing.
  const auto between = [](const double* z, std::ptrdiff_t step, double t) {
    const double u = 1 - t, first = z[0], last = z[step];
    const double slope0 = (z[-2 * step] - 8 * z[-step] + 8 * last - z[2 * step]) / 12,
                 slope1 = (z[-step] - 8 * first + 8 * z[2 * step] - z[3 * step]) / 12;
    const double bend0 = z[-step] - 2 * first + last, bend1 = first - 2 * last + z[2 * step];
    const double curve = t * u * ((1 - 2 * t) * (first - last) + u * slope0 - t * slope1);
    const double height = u * first + t * last + curve;
    const double beyond =
        curve > 0 ? height - std::max(first, last) : std::min(first, last) - height;
    const double bend = curve > 0 ? std::min(-bend0, -bend1) : std::min(bend0, bend1);
    return beyond - kShortWaves * std::max(0.0, bend) * t * u / 2;
  };
  const auto nx = static_cast<std::ptrdiff_t>(map.nx), ny = static_cast<std::ptrdiff_t>(map.ny);
  for (std::ptrdiff_t j = 0; j < ny; ++j)
    for (std::ptrdiff_t i = 0; i < nx; ++i) {
      const double x = map.x_m(static_cast<std::size_t>(i)) - x_centre_m,
                   y = map.y_m(static_cast<std::size_t>(j)) - y_centre_m;
      if (x * x + y * y > radius_m * radius_m) continue;
      const double* const z = map.z_m.data() + j * nx + i;
      for (const auto& [at, count, step] : {std::tuple(i, nx, std::ptrdiff_t{1}), {j, ny, nx}}) {
        if (at < 2 || at + 3 >= count || !(1.25 * between(z, step, 0.5) > largest)) continue;
        for (const double t : {0.35, 0.5, 0.65})
          if (const double beyond = between(z, step, t); beyond > largest) largest = beyond;
      }
    }
  return largest;
}

InterpolationError::InterpolationError(const SurfaceMap& map, double x_centre_m, double y_centre_m,
                                       double radius_m)
    : pixel_m_(std::min(map.dx_m, map.dy_m)) {
  const double farthest_m = std::hypot(
      std::max(std::abs(map.x_m(0) - x_centre_m), std::abs(map.x_m(map.nx - 1) - x_centre_m)),
      std::max(std::abs(map.y_m(0) - y_centre_m), std::abs(map.y_m(map.ny - 1) - y_centre_m)));
  const double limit_m = std::min(radius_m + 2 * pixel_m_, farthest_m);
  const auto rings = static_cast<std::size_t>(limit_m / pixel_m_) + 1;
  mean_m_.assign(rings, 0);
  const auto add = [&](bool along_x) {
    std::vector<double> sum(rings), count(rings);
    const std::size_t nx = map.nx - (along_x ? std::min<std::size_t>(map.nx, 5) : 0),
                      ny = map.ny - (along_x ? 0 : std::min<std::size_t>(map.ny, 5)),
                      step = along_x ? 1 : map.nx;
    for (std::size_t j = 0; j < ny; ++j)
      for (std::size_t i = 0; i < nx; ++i) {
        const double* const z = map.z_m.data() + j * map.nx + i;
        const double difference =
            z[0] - 3 * z[step] + 2 * z[2 * step] + 2 * z[3 * step] - 3 * z[4 * step] + z[5 * step];
        if (std::isnan(difference)) continue;
        const double x = map.x_m(i) + (along_x ? 2.5 * map.dx_m : 0) - x_centre_m,
                     y = map.y_m(j) + (along_x ? 0 : 2.5 * map.dy_m) - y_centre_m;
        const auto ring = static_cast<std::size_t>(std::sqrt(x * x + y * y) / pixel_m_);
        if (ring >= rings) continue;
        sum[ring] += std::abs(difference) / 96;
        count[ring] += 1;
      }
    for (std::size_t k = 0; k < rings; ++k)
      if (count[k] > 0) mean_m_[k] += sum[k] / count[k];
  };
  add(true);
  add(false);
}

// A height between pixels uses pixels to 3 rows and 3 columns away, so 3 sqrt(2) pixels.
constexpr double kReach_pixels = 4;

double InterpolationError::largest_m(double least_radius_m, double most_radius_m) const {
  const double first = std::max(0.0, least_radius_m / pixel_m_ - kReach_pixels),
               last = std::min(most_radius_m / pixel_m_ + kReach_pixels,
                               static_cast<double>(mean_m_.size() - 1));
  double largest = 0;
  for (double ring = std::floor(first); ring <= last; ++ring)
    largest = std::max(largest, mean_m_[static_cast<std::size_t>(ring)]);
  return largest;
}

}  // namespace mdof::algo
