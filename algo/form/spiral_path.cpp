#include "algo/form/spiral_path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "algo/form/map_figures.h"
#include "schema/base/number/number_text.h"
#include "schema/base/random.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr double kMostPoints = 1e10;
constexpr double kContactConverged =
    1e-6;  // limit for the last change of the iteration, relative to the tool's radius
constexpr int kMostSteps = 40;
constexpr double kNoContact_m = -std::numeric_limits<double>::infinity();
// A place is the new contact only if it is higher than the previous contact by more than this.
constexpr double kContactDifference_m = 1e-9;
constexpr double kBetweenPixels = 4;  // assumed ratio of the largest curvature between pixels to
                                      // the largest curvature at pixels
constexpr int kFewestPlaces = 64, kMostPlaces = 2000;
constexpr int kCircles = 8;
constexpr std::size_t kMostCirclePoints = std::size_t{1} << 17;

// Eq. 9: cubic over s in [0, L], from the heights and slopes at both ends.
double hermite(double s, double L, double z0, double slope0, double z1, double slope1) {
  const double t = s / L, u = 1 - t;
  return (1 + 2 * t) * u * u * z0 + (3 - 2 * t) * t * t * z1 +
         L * t * u * (u * slope0 - t * slope1);
}

// Largest second derivative along rows, columns and diagonals. It is the curvature of the narrowest
// valley.
double sharpest_valley_per_m(const SurfaceMap& map) {
  double sharpest = 0;
  const auto nx = static_cast<std::ptrdiff_t>(map.nx), ny = static_cast<std::ptrdiff_t>(map.ny);
  const auto z = [&](std::ptrdiff_t i, std::ptrdiff_t j) {
    return map.z_m[static_cast<std::size_t>(j * nx + i)];
  };
  for (const auto& [di, dj] : {std::pair{1, 0}, {0, 1}, {1, 1}, {1, -1}}) {
    const double step2 = di * di * map.dx_m * map.dx_m + dj * dj * map.dy_m * map.dy_m;
    const std::ptrdiff_t rows_off = std::abs(dj);
    for (std::ptrdiff_t j = rows_off; j + rows_off < ny; ++j)
      for (std::ptrdiff_t i = di; i + di < nx; ++i) {
        const double second = z(i - di, j - dj) - 2 * z(i, j) + z(i + di, j + dj);
        if (second > sharpest * step2) sharpest = second / step2;
      }
  }
  return sharpest;
}

// The offset with the largest height(offset) for |offset| < r. Takes the best of equally spaced
// offsets, and refines it by a ternary search between its two neighbours.
template <class Height>
double highest(const Height& height, double r, int places) {
  const double step = 2 * r / (places + 1);
  double best = kNoContact_m, at = 0;
  for (int k = 1; k <= places; ++k)
    if (const double off = k * step - r, z = height(off); z > best) {
      best = z;
      at = off;
    }
  double low = std::max(at - step, -r), high = std::min(at + step, r);
  for (int k = 0; k < kMostSteps; ++k) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    if (height(a) < height(b))
      low = a;
    else
      high = b;
  }
  const double refined = (low + high) / 2;
  return height(refined) > best ? refined : at;
}

}  // namespace

SpiralPath::SpiralPath(const SurfaceMap& map, const SpiralRequest& request)
    : request_(request),
      surface_(std::make_shared<const Surface>(map, request.extend_pixels, Extension::line)),
      error_(std::make_shared<const InterpolationError>(map, request.x_centre_m, request.y_centre_m,
                                                        request.outer_radius_m)) {
  const double r = request.tool_radius_m;
  has_sharp_valleys_ = r > 0 && kBetweenPixels * r * sharpest_valley_per_m(map) > 1;
  const double to_a_pixel = 4 * r / std::min(map.dx_m, map.dy_m);
  places_ = static_cast<int>(std::clamp(to_a_pixel, 1.0 * kFewestPlaces, 1.0 * kMostPlaces));
  set_angles();
}

void SpiralPath::set_angles() {
  const std::size_t n = request_.points_per_turn;
  cos_.clear();
  sin_.clear();
  for (std::size_t k = 0; k < n; ++k) {
    const double turns = static_cast<double>(k) / static_cast<double>(n);
    cos_.push_back(sine_of_turns(turns + 0.25));
    sin_.push_back(sine_of_turns(turns));
  }
}

Result<SpiralPath> SpiralPath::over(const SurfaceMap& map, const SpiralRequest& request) {
  const double steps =
      request.outer_radius_m / request.feed_m * static_cast<double>(request.points_per_turn);
  if (!(steps < kMostPoints))
    return fail(ErrorCode::usage,
                "the path would have " + plain_number(steps) + " points (limit " +
                    plain_number(kMostPoints) +
                    "); use a smaller radius, a larger feed or fewer points per turn");
  SpiralPath path(map, request);
  // If the radius is an integer multiple of the feed, the path ends in the centre. The small
  // numbers compensate rounding.
  path.points_ = static_cast<std::size_t>(std::floor(steps * (1 + 1e-12) + 1e-9)) + 1;
  // Checks only that a point with contact exists. each() finds this point again.
  Touch found;
  for (std::size_t k = 0; k < path.points_; ++k)
    if (path.touch(k, found)) return path;
  const auto mm = [](double x_m) { return plain_number(to_mm(x_m), 6); };
  return bad_input(map.name + ": the spiral with radius " + mm(request.outer_radius_m) +
                       " mm about x = " + mm(request.x_centre_m) + " mm, y = " +
                       mm(request.y_centre_m) + " mm has no point on a measured pixel",
                   Remedy::change_spiral);
}

double SpiralPath::rho_m(std::size_t index) const {
  return std::max(0.0, request_.outer_radius_m -
                           request_.feed_m * (static_cast<double>(index) /
                                              static_cast<double>(request_.points_per_turn)));
}

bool SpiralPath::at(double x_m, double y_m, SurfacePoint& point, OnPart& on_part) const {
  if (surface_->at(x_m, y_m, 0, point)) {
    on_part = OnPart::measured;
    return true;
  }
  on_part = OnPart::extended;
  return request_.extend_pixels > 0 && surface_->at(x_m, y_m, request_.extend_pixels, point);
}

// Calculates z, the height of the tool's lowest point, in the plane of rho and z. The circle of the
// tool's edge touches the surface where the slope is d / sqrt(r^2 - d^2); d is the distance from
// the lowest point along rho. If the surface is curved more than the tool, several places have this
// slope. The tool touches the place that gives the largest z.
bool SpiralPath::contact(double rho_m, double cos, double sin, Touch& found) const {
  const double r = request_.tool_radius_m;
  const auto surface_at = [&](double rho, SurfacePoint& point, OnPart& on_part) {
    return at(request_.x_centre_m + rho * cos, request_.y_centre_m + rho * sin, point, on_part);
  };
  SurfacePoint point;
  if (!surface_at(rho_m, point, found.on_part)) return false;
  double d = 0;
  OnPart there = found.on_part;
  bool is_found = r <= 0;
  for (int step = 0; !is_found && step < kMostSteps; ++step) {
    const double slope = point.slope_x * cos + point.slope_y * sin;
    const double next = r * slope / std::sqrt(1 + slope * slope);
    is_found = std::abs(next - d) < kContactConverged * r;
    d = next;
    if (!surface_at(rho_m + d, point, there)) return false;
  }
  const auto lowest = [&](double z, double off) {
    return z - off * off / (r + std::sqrt(r * r - off * off));
  };
  found.z_m = r > 0 ? lowest(point.z_m, d) : point.z_m;
  found.is_too_sharp = !is_found;
  if (has_sharp_valleys_ || !is_found) {
    const auto height = [&](double off) {
      SurfacePoint other;
      return surface_at(rho_m + off, other, there) ? lowest(other.z_m, off) : kNoContact_m;
    };
    const double off = highest(height, r, places_), best = height(off);
    if (found.is_too_sharp || best > found.z_m + kContactDifference_m) {
      if (!surface_at(rho_m + off, point, there)) return false;
      found.z_m = best;
      found.is_too_sharp = true;
    }
  }
  // The path is perpendicular to rho, except for the small feed.
  found.along = point.slope_y * cos - point.slope_x * sin;
  return true;
}

bool SpiralPath::touch(std::size_t index, Touch& found) const {
  const std::size_t k = index % request_.points_per_turn;
  found = {};
  return contact(rho_m(index), cos_[k], sin_[k], found);
}

// Length of the path in the XY plane. Combines the length around the centre (mean rho times angle)
// and the change of rho.
double SpiralPath::arc_m(std::ptrdiff_t from, std::ptrdiff_t to) const {
  const double steps = static_cast<double>(to - from);
  const double angle = 2 * std::numbers::pi * steps / static_cast<double>(request_.points_per_turn);
  const auto rho = [this](std::ptrdiff_t index) {
    return rho_m(static_cast<std::size_t>(std::max<std::ptrdiff_t>(index, 0)));
  };
  const double across = rho(from) - rho(to), around = angle * (rho(from) + rho(to)) / 2;
  return std::sqrt(around * around + across * across);
}

// Path over a gap (successive points without contact), between the contact before and the contact
// after the gap:
// - Gap of at most one turn: the cubic of Eq. 9 over the arc of the gap.
// - Longer gap: within half a turn, a cubic leads to the mean of the heights at both ends of the
//   gap. The path keeps this mean until half a turn before the end of the gap. One cubic over the
//   whole gap could have very large heights.
// - Gap at the end of the path: keeps the height before the gap.
// - Gap at the beginning of the path: the last contact of the first turn, moved back by one turn,
//   is the contact before the gap. A constant height would cause a jump after one turn.
struct SpiralPath::Gap {
  const SpiralPath& path;
  bool has_before = false, has_after = false;
  std::ptrdiff_t before_at = 0, after_at = 0;  // before_at may be negative
  Touch before, after;

  double z_m(std::ptrdiff_t index) const {
    if (!has_before) return after.z_m;
    if (!has_after) return before.z_m;
    const auto turn = static_cast<std::ptrdiff_t>(path.request_.points_per_turn),
               half = turn / 2 + 1;
    if (after_at - before_at <= turn)
      return hermite(path.arc_m(before_at, index), path.arc_m(before_at, after_at), before.z_m,
                     before.along, after.z_m, after.along);
    const double mean = (before.z_m + after.z_m) / 2;
    if (index - before_at < half)
      return hermite(path.arc_m(before_at, index), path.arc_m(before_at, before_at + half),
                     before.z_m, before.along, mean, 0);
    if (after_at - index < half)
      return hermite(path.arc_m(after_at - half, index), path.arc_m(after_at - half, after_at),
                     mean, 0, after.z_m, after.along);
    return mean;
  }
};

void SpiralPath::find_touch_before(std::size_t first, Gap& gap) const {
  const std::size_t turn = request_.points_per_turn;
  for (std::size_t k = std::min(turn, points_); k-- > first;)  // from the end of the first turn
                                                               // backwards
    if (touch(k, gap.before)) {
      gap.has_before = true;
      gap.before_at = static_cast<std::ptrdiff_t>(k) - static_cast<std::ptrdiff_t>(turn);
      return;
    }
}

Result<SpiralCounts> SpiralPath::each(const std::function<Status(const PathPoint&)>& take) const {
  SpiralCounts counts;
  counts.points = points_;
  Gap gap{*this, false, false, 0, 0, {}, {}};
  Touch found;
  for (std::size_t k = 0; k < points_; ++k) {
    if (touch(k, found)) {
      ++(found.on_part == OnPart::measured ? counts.measured : counts.extended);
      counts.too_sharp += found.is_too_sharp ? 1 : 0;
      MDOF_CHECK(take({rho_m(k), found.z_m, k, found.on_part}));
      gap.has_before = true;
      gap.before_at = static_cast<std::ptrdiff_t>(k);
      gap.before = found;
      continue;
    }
    std::size_t end = k + 1;
    while (end < points_ && !touch(end, gap.after)) ++end;
    gap.has_after = end < points_;
    gap.after_at = static_cast<std::ptrdiff_t>(end);
    if (!gap.has_before && gap.has_after) find_touch_before(end, gap);
    for (; k < end; ++k) {
      ++counts.bridged;
      MDOF_CHECK(take({rho_m(k), gap.z_m(static_cast<std::ptrdiff_t>(k)), k, OnPart::bridged}));
    }
    --k;
  }
  return counts;
}

std::vector<double> SpiralPath::circle(double radius_m, std::size_t points) const {
  SpiralPath turn = *this;
  turn.request_.outer_radius_m = radius_m;
  turn.request_.feed_m = 0;
  turn.request_.points_per_turn = points;
  turn.points_ = 2 * points;  // a gap at the end of the circle ends in the second turn
  turn.set_angles();
  std::vector<double> z_m;
  static_cast<void>(turn.each([&](const PathPoint& point) {  // only `take` could fail
    if (z_m.size() < points) z_m.push_back(point.z_m);
    return Status();
  }));
  return z_m;
}

// An error e of the heights changes an amplitude by at most 2 mean(|e|).
TurnSpectrum SpiralPath::spectrum(double band_harmonic) const {
  const auto error = [error = error_, outer_m = request_.outer_radius_m,
                      feed_m = request_.feed_m](std::size_t turn) {
    const double most_m = outer_m - feed_m * static_cast<double>(turn);
    return 2 * error->largest_m(most_m - feed_m, most_m);
  };
  return {request_.points_per_turn, band_harmonic, error};
}

std::size_t SpiralPath::surface_undulations(double pixel_m, double share) const {
  const double radius_m = request_.outer_radius_m;
  const double wanted = 2 * 2 * std::numbers::pi * radius_m / pixel_m;
  std::size_t points = 4;
  while (points < kMostCirclePoints && static_cast<double>(points) < wanted) points *= 2;
  if (static_cast<double>(request_.points_per_turn) >= wanted || request_.points_per_turn >= points)
    return 0;
  const auto error = [this, radius_m](std::size_t turn) {
    const double rho_m = radius_m * static_cast<double>(turn + 1) / kCircles;
    return 2 * error_->largest_m(rho_m, rho_m);
  };
  TurnSpectrum spectrum(points, -1, error);
  for (int k = 1; k <= kCircles; ++k) {
    for (const double z_m : circle(radius_m * k / kCircles, points)) spectrum.add(z_m);
    spectrum.finish();  // the next circle does not continue this circle
  }
  return spectrum.undulations(share);
}

MapMiddle middle_of(const SurfaceMap& map) {
  const MeasuredExtent extent = measured_extent(map);
  return {(map.x_m(extent.left) + map.x_m(extent.right)) / 2,
          (map.y_m(extent.low) + map.y_m(extent.high)) / 2};
}

MapMiddle mean_pixel(const SurfaceMap& map) {
  double x_m = 0, y_m = 0;
  for (std::size_t j = 0; j < map.ny; ++j)
    for (std::size_t i = 0; i < map.nx; ++i) {
      if (std::isnan(map.at(i, j))) continue;
      x_m += map.x_m(i);
      y_m += map.y_m(j);
    }
  const auto count = static_cast<double>(map.measured());
  return {x_m / count, y_m / count};
}

FarthestPixel farthest_pixel(const SurfaceMap& map, double x_centre_m, double y_centre_m) {
  double square = -1;
  FarthestPixel found;
  for (std::size_t j = 0; j < map.ny; ++j)
    for (std::size_t i = 0; i < map.nx; ++i) {
      if (std::isnan(map.at(i, j))) continue;
      const double x = map.x_m(i) - x_centre_m, y = map.y_m(j) - y_centre_m;
      if (x * x + y * y <= square) continue;
      square = x * x + y * y;
      found = {std::sqrt(square), map.x_m(i), map.y_m(j)};
    }
  return found;
}

bool is_edge_missing(const SurfaceMap& map) {
  for (std::size_t j = 0; j < map.ny; ++j)
    for (std::size_t i = 0; i < map.nx; ++i) {
      const bool is_inside = i > 0 && j > 0 && i + 1 < map.nx && j + 1 < map.ny;
      if (!is_inside && !std::isnan(map.at(i, j))) return false;
    }
  return true;
}

FeedRoughness feed_roughness(double tool_radius_m, double feed_m) {
  const double r = tool_radius_m, half = feed_m / 2;
  if (!(r > half)) return {r, r};  // the arcs of two turns do not intersect
  const double Rt = half * half / (r + std::sqrt(r * r - half * half));
  return {Rt, 4 * Rt / (9 * std::numbers::sqrt3)};
}

}  // namespace mdof::algo
