// The path of a servo over gaps of more than one turn, at its beginning and at its end. The
// expected Hermite cubics are calculated from their four terms, over the arc length of the spiral.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "algo/form/spiral_path.h"
#include "algo/form/turn_spectrum.h"
#include "tests/algo/form/known_maps.h"

namespace mdof::algo {
namespace {

constexpr std::size_t kPointsPerTurn = 90;
constexpr double kFeed_m = 0.5e-3;
constexpr double kAlongX = 2e-3, kAlongY = -1e-3;  // slopes of the plane

// A plane that is measured where `is_part(radius, x, y)` is true.
template <class IsPart>
SurfaceMap plane_with_gaps(IsPart&& is_part) {
  SurfaceMap map{"plane", -16e-3, -16e-3, 0.2e-3, 0.2e-3, 161, 161, {}, {}};
  for (std::size_t j = 0; j < map.ny; ++j)
    for (std::size_t i = 0; i < map.nx; ++i) {
      const double x = map.x_m(i), y = map.y_m(j);
      map.z_m.push_back(is_part(std::hypot(x, y), x, y) ? kAlongX * x + kAlongY * y
                                                        : SurfaceMap::kMissing);
    }
  return map;
}

std::vector<PathPoint> points_over(const SurfaceMap& map, double outer_m,
                                   std::size_t extend_pixels = 0) {
  SpiralRequest request{0, 0, outer_m, kFeed_m, kPointsPerTurn, 0, extend_pixels};
  const auto path = SpiralPath::over(map, request);
  EXPECT_TRUE(path) << path.error().message;
  std::vector<PathPoint> points;
  const auto counts = path->each([&](const PathPoint& p) {
    points.push_back(p);
    return Status();
  });
  EXPECT_EQ(counts->points, points.size());
  EXPECT_EQ(counts->measured + counts->extended + counts->bridged, points.size());
  return points;
}

double angle_of(double index) {
  return 2 * std::numbers::pi * index / kPointsPerTurn;
}
double slope_along(std::size_t index) {
  const double angle = angle_of(static_cast<double>(index));
  return kAlongY * std::cos(angle) - kAlongX * std::sin(angle);
}
double arc_between(const std::vector<PathPoint>& p, std::size_t from, std::size_t to) {
  const double across = p[from].rho_m - p[to].rho_m;
  const double around =
      angle_of(static_cast<double>(to - from)) * (p[from].rho_m + p[to].rho_m) / 2;
  return std::hypot(across, around);
}
// Hermite cubic at the arc length s of a gap of the length L, from the heights and slopes at both
// ends.
double cubic(double s, double L, double z0, double slope0, double z1, double slope1) {
  const double t = s / L;
  return z0 * (2 * t * t * t - 3 * t * t + 1) + L * slope0 * (t * t * t - 2 * t * t + t) +
         z1 * (3 * t * t - 2 * t * t * t) + L * slope1 * (t * t * t - t * t);
}

// A ring from 4 to 9 mm is missing, which is ten turns. Within half a turn from each end, the path
// reaches the mean of the heights of both ends.
TEST(PathGaps, OfManyTurnsUseTheMeanOfTheEnds) {
  const auto points = points_over(
      plane_with_gaps([](double r, double, double) { return r < 4e-3 || r > 9e-3; }), 14e-3);
  std::size_t begin = 0;
  while (points[begin].on_part != OnPart::bridged) ++begin;
  std::size_t end = points.size() - 1;
  // The edge of the ring consists of pixels, so the spiral has several gaps. The test uses the
  // longest gap.
  std::size_t longest = 0, from = 0;
  for (std::size_t k = begin, first = begin; k <= end; ++k) {
    if (points[k].on_part != OnPart::bridged) first = k + 1;
    if (k + 1 - first > longest) {
      longest = k + 1 - first;
      from = first;
    }
  }
  const std::size_t before = from - 1, after = from + longest, half = kPointsPerTurn / 2 + 1;
  ASSERT_GT(longest, 8 * kPointsPerTurn);
  const double mean = (points[before].z_m + points[after].z_m) / 2;
  const double first_arc = arc_between(points, before, before + half),
               last_arc = arc_between(points, after - half, after);
  for (std::size_t k = from; k < after; ++k) {
    ASSERT_EQ(points[k].on_part, OnPart::bridged);
    double expected = mean;
    if (k < before + half)
      expected = cubic(arc_between(points, before, k), first_arc, points[before].z_m,
                       slope_along(before), mean, 0);
    else if (k > after - half)
      expected = cubic(arc_between(points, after - half, k), last_arc, mean, 0, points[after].z_m,
                       slope_along(after));
    ASSERT_NEAR(points[k].z_m, expected, 1e-12) << k - before << " of " << longest;
  }
}

// A sector is missing, so each gap is a fraction of a turn.
TEST(PathGaps, OfLessThanATurnUseOneCubic) {
  const auto points = points_over(
      plane_with_gaps([](double r, double x, double y) { return !(r > 5e-3 && x > 0 && y > 0); }),
      14e-3);
  std::size_t gaps = 0;
  for (std::size_t k = kPointsPerTurn; k + 1 < points.size(); ++k) {
    if (points[k].on_part != OnPart::bridged || points[k - 1].on_part == OnPart::bridged) continue;
    const std::size_t before = k - 1;
    std::size_t after = k;
    while (points[after].on_part == OnPart::bridged) ++after;
    for (std::size_t i = k; i < after; ++i)
      ASSERT_NEAR(
          points[i].z_m,
          cubic(arc_between(points, before, i), arc_between(points, before, after),
                points[before].z_m, slope_along(before), points[after].z_m, slope_along(after)),
          1e-12);
    ++gaps;
  }
  EXPECT_GT(gaps, 10u);
}

// The middle is missing, so the path keeps the last measured height.
TEST(PathGaps, AtTheEndKeepTheLastHeight) {
  const auto points =
      points_over(plane_with_gaps([](double r, double, double) { return r > 5e-3; }), 12e-3);
  std::size_t last = points.size() - 1;
  ASSERT_EQ(points[last].on_part, OnPart::bridged);
  while (points[last].on_part == OnPart::bridged) --last;
  for (std::size_t k = last; k < points.size(); ++k) ASSERT_EQ(points[k].z_m, points[last].z_m);
  EXPECT_GT(points.size() - last, 5 * kPointsPerTurn);
}

// The path is beside the part for more than a turn at its beginning. There it has the first height
// on the part.
TEST(PathGaps, AtALongBeginningHaveTheFirstHeight) {
  const auto points =
      points_over(plane_with_gaps([](double r, double, double) { return r < 6e-3; }), 12e-3);
  std::size_t first = 0;
  while (points[first].on_part == OnPart::bridged) ++first;
  ASSERT_GT(first, 8 * kPointsPerTurn);
  for (std::size_t k = 0; k <= first; ++k) ASSERT_EQ(points[k].z_m, points[first].z_m);
}

// The path is beside the part at its beginning and reaches the part within the first turn. The
// heights at the beginning continue from the end of this turn.
TEST(PathGaps, AtAShortBeginningContinueTheFirstTurn) {
  const auto points = points_over(
      plane_with_gaps([](double r, double x, double) { return r < 3e-3 || x < 1e-3; }), 12e-3);
  std::size_t first = 0;
  while (points[first].on_part == OnPart::bridged) ++first;
  std::size_t last = kPointsPerTurn;  // the end of the first turn
  while (points[last].on_part == OnPart::bridged) --last;
  ASSERT_GT(first, 10u);
  ASSERT_LT(last, kPointsPerTurn - 10);
  // The path before the beginning is assumed to be a turn at the outermost radius.
  const double outer = points[0].rho_m;
  const std::size_t back = kPointsPerTurn - last;
  const auto arc_from_before = [&](std::size_t k) {
    const double around = angle_of(static_cast<double>(k + back)) * (outer + points[k].rho_m) / 2;
    return std::hypot(outer - points[k].rho_m, around);
  };
  for (std::size_t k = 0; k < first; ++k)
    ASSERT_NEAR(points[k].z_m,
                cubic(arc_from_before(k), arc_from_before(first), points[last].z_m,
                      slope_along(last), points[first].z_m, slope_along(first)),
                1e-12)
        << k;
}

// The map is extended by two pixels. The path ends there, and not one pixel later.
TEST(PathGaps, EndAtTheExtendedPixels) {
  const auto map = plane_with_gaps([](double, double x, double) { return x < 5e-3; });
  const double edge = [&] {
    double most = -1;
    for (std::size_t i = 0; i < map.nx; ++i)
      if (!std::isnan(map.at(i, 80))) most = std::max(most, map.x_m(i));
    return most;
  }();
  std::size_t extended = 0;
  for (const PathPoint& p : points_over(map, 12e-3, 2)) {
    const double x = p.rho_m * std::cos(angle_of(static_cast<double>(p.index)));
    if (std::abs(x - edge) < 1e-9 || std::abs(x - edge - 0.4e-3) < 1e-9) continue;
    ASSERT_EQ(p.on_part, x < edge            ? OnPart::measured
                         : x < edge + 0.4e-3 ? OnPart::extended
                                             : OnPart::bridged)
        << x;
    extended += p.on_part == OnPart::extended ? 1 : 0;
    if (p.on_part != OnPart::bridged) {
      ASSERT_NEAR(
          p.z_m, kAlongX * x + kAlongY * p.rho_m * std::sin(angle_of(static_cast<double>(p.index))),
          1e-12);
    }
  }
  EXPECT_GT(extended, 20u);
  for (const PathPoint& p : points_over(map, 12e-3, 0)) ASSERT_NE(p.on_part, OnPart::extended);
}

TEST(PathGaps, CallbackErrorEndsThePath) {
  const auto map = plane_with_gaps([](double, double x, double) { return x < 5e-3; });
  const auto path = SpiralPath::over(map, {0, 0, 12e-3, kFeed_m, kPointsPerTurn, 0, 0});
  for (const std::size_t most : {1u, 20u, 300u}) {
    std::size_t taken = 0;
    const auto counts = path->each(
        [&](const PathPoint&) { return ++taken < most ? Status() : bad_input("enough"); });
    EXPECT_FALSE(counts);
    EXPECT_EQ(taken, most);
  }
}

// Defaults of a request: 720 points per turn, a pointed tool, three extended pixels beyond the
// edge.
TEST(PathGaps, RequestHasDefaults) {
  const auto map = plane_with_gaps([](double, double x, double) { return x < 5e-3; });
  SpiralRequest request;
  request.outer_radius_m = 12e-3;
  request.feed_m = 1e-3;
  const auto path = SpiralPath::over(map, request);
  ASSERT_TRUE(path);
  EXPECT_EQ(path->points(), 12u * 720 + 1);
  double farthest = 0, edge = 0;
  EXPECT_TRUE(path->each([&](const PathPoint& p) {
    const double x = p.rho_m * std::cos(2 * std::numbers::pi * static_cast<double>(p.index) / 720);
    if (p.on_part == OnPart::extended) farthest = std::max(farthest, x);
    if (p.on_part == OnPart::measured) edge = std::max(edge, x);
    if (p.on_part != OnPart::bridged) {
      EXPECT_NEAR(
          p.z_m,
          kAlongX * x + kAlongY * p.rho_m *
                            std::sin(2 * std::numbers::pi * static_cast<double>(p.index) / 720),
          1e-12);
    }
    return Status();
  }));
  EXPECT_NEAR(farthest - edge, 3 * 0.2e-3, 0.1e-3);
}

// For an even number of points the highest harmonic has no conjugate, so its amplitude is not
// halved.
TEST(TurnSpectrumByHand, HighestHarmonicIsNotHalved) {
  TurnSpectrum spectrum(8, 1);
  EXPECT_EQ(spectrum.turns(), 0u);
  EXPECT_EQ(spectrum.left_out().pv, 0);
  EXPECT_EQ(spectrum.left_out().rms, 0);
  EXPECT_EQ(spectrum.undulations(0.1), 0u);
  const auto add_turn = [](TurnSpectrum& to) {
    for (int k = 0; k < 8; ++k)
      to.add(3 + std::cos(k * std::numbers::pi / 4) + (k % 2 == 0 ? 0.6 : -0.6));
    to.finish();
  };
  add_turn(spectrum);
  EXPECT_EQ(spectrum.turns(), 1u);
  EXPECT_EQ(spectrum.undulations(0.59), 4u);
  EXPECT_EQ(spectrum.undulations(0.61), 1u);
  EXPECT_EQ(spectrum.undulations(1), 1u);
  EXPECT_NEAR(spectrum.left_out().pv, 1.2, 1e-12);
  EXPECT_NEAR(spectrum.left_out().rms, 0.6, 1e-12);
  // A band from 1 to below 4 contains the first harmonic but not the fourth. A band below 1
  // contains neither.
  for (const double band : {0.0, 0.9, 1.0, 3.9, 4.0}) {
    TurnSpectrum other(8, band);
    add_turn(other);
    const double expected = band < 1 ? std::sqrt(0.5 + 0.36) : band < 4 ? 0.6 : 0;
    EXPECT_NEAR(other.left_out().rms, expected, 1e-12) << band;
  }
}

// Amplitudes far below 1 are also distinguished.
TEST(TurnSpectrumSmall, UndulationsAreRelativeToTheLargest) {
  TurnSpectrum spectrum(36, -1);
  for (int k = 0; k < 36; ++k) {
    const double angle = 2 * std::numbers::pi * k / 36;
    spectrum.add(1e-6 * std::cos(2 * angle) + 0.3e-6 * std::sin(7 * angle));
  }
  spectrum.finish();
  EXPECT_EQ(spectrum.undulations(0.29), 7u);
  EXPECT_EQ(spectrum.undulations(0.31), 2u);
}

TEST(PathGaps, EdgeIsMissingIfNoEdgePixelIsMeasured) {
  SurfaceMap map = map_of([](double, double) { return 0.0; }, 0, 0, 1e-3, 4, 5);
  for (std::size_t k = 0; k < 20; ++k)
    if (k != 1 * 4 + 2 && k != 3 * 4 + 1) map.z_m[k] = SurfaceMap::kMissing;
  EXPECT_TRUE(is_edge_missing(map));
  for (const std::size_t k : {0u, 3u, 2u * 4, 3u * 4 + 3, 4u * 4 + 1, 19u}) {
    SurfaceMap other = map;
    other.z_m[k] = 0;
    EXPECT_FALSE(is_edge_missing(other)) << k;
  }
}

}  // namespace
}  // namespace mdof::algo
