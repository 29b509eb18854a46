// Tests the path of a fast tool servo: spiral, tool radius, edges, bridges, undulations.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "algo/form/spiral_path.h"
#include "algo/form/turn_spectrum.h"

namespace mdof::algo {
namespace {

template <class F>
SurfaceMap map_of(F&& z, double d_m = 0.2e-3, std::size_t n = 201) {
  const double x0_m = -d_m * static_cast<double>(n - 1) / 2;
  SurfaceMap map{"map", x0_m, x0_m, d_m, d_m, n, n, {}, {}};
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < n; ++i) map.z_m.push_back(z(map.x_m(i), map.y_m(j)));
  return map;
}

struct PathAndCounts {
  std::vector<PathPoint> points;
  SpiralCounts counts;
};
PathAndCounts walk(const SurfaceMap& map, const SpiralRequest& request) {
  PathAndCounts walked;
  const auto path = SpiralPath::over(map, request);
  EXPECT_TRUE(path) << path.error().message;
  walked.counts = *path->each([&](const PathPoint& p) {
    walked.points.push_back(p);
    return Status();
  });
  EXPECT_EQ(walked.points.size(), path->points());
  return walked;
}

struct XY {
  double x, y;
};
XY place(const PathPoint& p, std::size_t per_turn) {
  const double angle =
      2 * std::numbers::pi * static_cast<double>(p.index) / static_cast<double>(per_turn);
  return {p.rho_m * std::cos(angle), p.rho_m * std::sin(angle)};
}

TEST(SpiralPath, RunsInwardWithGrowingAngles) {
  const auto tilted = [](double x, double y) { return 1e-3 * x + 2e-3 * y; };
  const PathAndCounts walked = walk(map_of(tilted), {0, 0, 15e-3, 0.1e-3, 90, 0, 3});
  ASSERT_EQ(walked.points.size(), 150u * 90 + 1);
  EXPECT_EQ(walked.points.front().rho_m, 15e-3);
  EXPECT_NEAR(walked.points.back().rho_m, 0, 1e-15);
  EXPECT_NEAR(walked.points[90].rho_m, 14.9e-3, 1e-12);
  for (const PathPoint& p : walked.points) {
    const XY at = place(p, 90);
    ASSERT_NEAR(p.z_m, tilted(at.x, at.y), 1e-14);
    ASSERT_EQ(p.on_part, OnPart::measured);
  }
}

// The path of a round tool with the radius r over a sphere with the radius R is a sphere with the
// radius R + r.
TEST(SpiralPath, OffsetsASphereByTheRoundTool) {
  constexpr double kR = 60e-3, r = 0.5e-3;
  const auto ball = [](double x, double y) { return std::sqrt(kR * kR - x * x - y * y) - kR; };
  for (const double sign : {1.0, -1.0}) {
    const SurfaceMap map = map_of([&](double x, double y) { return sign * ball(x, y); });
    const PathAndCounts walked = walk(map, {0, 0, 18e-3, 0.5e-3, 60, r, 3});
    double compensated = 0;
    for (const PathPoint& p : walked.points) {
      const double R = kR + sign * r, expected = sign * (std::sqrt(R * R - p.rho_m * p.rho_m) - R);
      ASSERT_NEAR(p.z_m, expected, 1e-10) << p.rho_m << " " << sign;
      compensated = std::max(compensated, std::abs(p.z_m - sign * ball(p.rho_m, 0)));
    }
    EXPECT_GT(compensated, 20e-6);
    EXPECT_EQ(walked.counts.too_sharp, 0u);
  }
}

TEST(SpiralPath, CountsPointsWhereTheToolDoesNotFit) {
  const PathAndCounts walked =
      walk(map_of([](double x, double) { return 20e-6 * std::cos(x / 0.3e-3); }, 0.05e-3),
           {0, 0, 4e-3, 0.2e-3, 60, 8e-3, 3});
  EXPECT_GT(walked.counts.too_sharp, 0u);
  // The tool touches the crests only.
  for (const PathPoint& p : walked.points) {
    ASSERT_GT(p.z_m, -20e-6);
    ASSERT_LE(p.z_m, 20.1e-6);
  }
}

// The path is compared with the highest of very many tool positions, also at the bottom of a groove
// where the surface is level. The tool must not cut deeper than the surface permits.
TEST(SpiralPath, LargeToolRestsOnTheWallsOfAGroove) {
  constexpr double r = 5e-3, kWave = 2e-3;
  const auto groove = [](double x, double y) {
    return 50e-6 * std::cos(2 * std::numbers::pi * std::hypot(x, y) / kWave);
  };
  const PathAndCounts walked = walk(map_of(groove, 0.05e-3), {0, 0, 2.5e-3, 0.1e-3, 8, r, 3});
  double deepest = 0, most_apart = 0;
  for (const PathPoint& p : walked.points) {
    double expected = -1;
    for (int k = -9999; k < 10000; ++k) {
      const double d = 1e-4 * k * r;
      if (std::abs(p.rho_m + d) < 5e-3)
        expected = std::max(expected, groove(p.rho_m + d, 0) - r + std::sqrt(r * r - d * d));
    }
    deepest = std::min(deepest, p.z_m - expected);
    most_apart = std::max(most_apart, std::abs(p.z_m - expected));
  }
  EXPECT_GT(deepest, -0.1e-6);
  EXPECT_LT(most_apart, 0.1e-6);
  EXPECT_GT(walked.counts.too_sharp, walked.points.size() / 4);
}

// The same test on a map with one row. The path is on the part twice per turn.
TEST(SpiralPath, LargeToolRestsOnTheWallsOfOneRow) {
  constexpr double r = 50e-3, kWave = 1e-3, kPixel = 0.02e-3;
  const auto groove = [](double x) { return 1e-6 * std::cos(2 * std::numbers::pi * x / kWave); };
  constexpr std::size_t n = 1501;
  SurfaceMap row{"row", -kPixel * (n - 1) / 2, 0, kPixel, kPixel, n, 1, {}, {}};
  for (std::size_t i = 0; i < n; ++i) row.z_m.push_back(groove(row.x_m(i)));
  const PathAndCounts walked = walk(row, {0, 0, 5e-3, 0.13e-3, 4, r, 0});
  std::size_t on_row = 0, sharp = 0;
  for (const PathPoint& p : walked.points) {
    if (p.index % 2 != 0) continue;
    ASSERT_EQ(p.on_part, OnPart::measured);
    ++on_row;
    const double x = p.index % 4 == 0 ? p.rho_m : -p.rho_m;
    double expected = -1, flattest = 0;
    for (int k = -9999; k < 10000; ++k) {
      const double d = 1e-4 * k * r;
      const double z = groove(x + d) - d * d / (r + std::sqrt(r * r - d * d));
      if (std::abs(x + d) < 14e-3 && z > expected) {
        expected = z;
        flattest = d;
      }
    }
    sharp += std::abs(flattest) > kWave / 20 ? 1 : 0;
    ASSERT_NEAR(p.z_m, expected, 2e-9) << x;
  }
  EXPECT_GT(on_row, 70u);
  EXPECT_GT(sharp, 10u);
}

// A part that is narrower than long. The heights of the path are measured on the part, extended up
// to three pixels beyond it, and bridged elsewhere.
TEST(SpiralPath, EdgesAreExtendedAndBridged) {
  const double d = 0.2e-3, half = 8e-3;
  const auto wave = [](double x, double y) { return 1e-6 * std::sin(x / 5e-3) + 40e-6 * y; };
  SurfaceMap map = map_of(wave);
  for (std::size_t j = 0; j < map.ny; ++j)
    for (std::size_t i = 0; i < map.nx; ++i)
      if (std::abs(map.y_m(j)) > half + 1e-9) map.z_m[j * map.nx + i] = SurfaceMap::kMissing;
  const std::size_t per_turn = 720;
  const PathAndCounts walked = walk(map, {0, 0, 20e-3, 1e-3, per_turn, 0, 3});
  std::size_t counted[3] = {0, 0, 0};
  double steepest = 0, step = 0;
  for (std::size_t k = 0; k < walked.points.size(); ++k) {
    const PathPoint& p = walked.points[k];
    const XY at = place(p, per_turn);
    ++counted[static_cast<int>(p.on_part)];
    const double little = 0.011 * d;  // the part extends 0.01 pixel beyond its last pixel
    if (std::abs(at.x) < 19.9e-3 && std::abs(std::abs(at.y) - half) > little &&
        std::abs(std::abs(at.y) - half - 3 * d) > little) {
      const OnPart expected = std::abs(at.y) < half           ? OnPart::measured
                              : std::abs(at.y) < half + 3 * d ? OnPart::extended
                                                              : OnPart::bridged;
      ASSERT_EQ(p.on_part, expected) << at.x << " " << at.y;
    }
    if (p.on_part == OnPart::extended) {
      ASSERT_NEAR(p.z_m, wave(at.x, at.y), 0.02e-6);
    }
    if (k > 1) {
      step = std::max(step, std::abs(p.z_m - walked.points[k - 1].z_m));
      steepest = std::max(
          steepest, std::abs(p.z_m - 2 * walked.points[k - 1].z_m + walked.points[k - 2].z_m));
    }
  }
  EXPECT_EQ(counted[0], walked.counts.bridged);
  EXPECT_EQ(counted[1], walked.counts.measured);
  EXPECT_EQ(counted[2], walked.counts.extended);
  EXPECT_GT(counted[0], 1000u);
  EXPECT_LT(step, 0.042e-6);      // no step: 2 pi 20 mm / 720 at a slope of 0.24 um/mm
  EXPECT_LT(steepest, 0.003e-6);  // no sudden change of the slope
  // The path is beside the part at its beginning. Its heights continue from the end of the first
  // turn.
  const double shift_m = half + 6 * d;
  const PathAndCounts beside = walk(map, {0, -shift_m, 20e-3, 1e-5, per_turn, 0, 3});
  ASSERT_EQ(beside.points.front().on_part, OnPart::bridged);
  EXPECT_NEAR(beside.points[0].z_m, beside.points[per_turn].z_m, 0.01e-6);
  EXPECT_NEAR(beside.points[1].z_m - beside.points[0].z_m,
              beside.points[0].z_m - beside.points[per_turn - 1].z_m, 0.02e-6);
}

// The test calculates Eq. 9 independently between the two ends. The path changes its direction at
// most twice.
TEST(SpiralPath, BridgeIsAHermiteCubic) {
  SurfaceMap map =
      map_of([](double x, double y) { return 30e-6 * x - 10e-6 * y * (1 + x / 5e-3); });
  for (std::size_t j = 0; j < map.ny; ++j)
    for (std::size_t i = 0; i < map.nx; ++i)
      if (std::abs(map.y_m(j)) > 5e-3 + 1e-9) map.z_m[j * map.nx + i] = SurfaceMap::kMissing;
  const std::size_t n = 3600;
  const double feed = 1e-8;
  const auto path = SpiralPath::over(map, {0, 0, 15e-3, feed, n, 0, 0});
  ASSERT_TRUE(path) << path.error().message;
  std::vector<PathPoint> p;
  (void)path->each([&](const PathPoint& point) {
    p.push_back(point);
    return p.size() < 2 * n ? Status() : bad_input("enough");
  });
  std::size_t first = 0;
  while (p[first].on_part != OnPart::bridged || p[first - 1].on_part == OnPart::bridged) ++first;
  std::size_t last = first;
  while (p[last].on_part == OnPart::bridged) ++last;
  const std::size_t b = first - 1;  // the points B and A are on the part
  const double ds = 2 * std::numbers::pi * 15e-3 / static_cast<double>(n);
  const double Bk = (3 * p[b].z_m - 4 * p[b - 1].z_m + p[b - 2].z_m) / (2 * ds),
               Ak = (-3 * p[last].z_m + 4 * p[last + 1].z_m - p[last + 2].z_m) / (2 * ds);
  const double L = ds * static_cast<double>(last - b), Bz = p[b].z_m, Az = p[last].z_m;
  for (std::size_t k = first; k < last; ++k) {
    const double l = ds * static_cast<double>(k - b);
    const double z = (L + 2 * l) * (L - l) * (L - l) / (L * L * L) * Bz +
                     (3 * L - 2 * l) * l * l / (L * L * L) * Az +
                     l * (L - l) * (L - l) / (L * L) * Bk + l * l * (l - L) / (L * L) * Ak;
    ASSERT_NEAR(p[k].z_m, z, 0.05e-9) << k;
  }
}

TEST(SpiralPath, RefusesAPathBesideThePart) {
  SurfaceMap map = map_of([](double, double) { return 0; });
  const auto far = SpiralPath::over(map, {1, 0, 5e-3, 1e-4, 90, 0, 3});
  ASSERT_FALSE(far);
  EXPECT_EQ(far.error().remedy, Remedy::change_spiral);
  EXPECT_FALSE(SpiralPath::over(map, {0, 0, 1, 1e-12, 720, 0, 3}));
  // The middle of the map is missing. The bridged heights there are close to the heights beside
  // them.
  map = map_of([](double x, double) { return 1e-3 * x; });
  for (std::size_t j = 0; j < map.ny; ++j)
    for (std::size_t i = 0; i < map.nx; ++i)
      if (std::hypot(map.x_m(i), map.y_m(j)) < 6e-3) map.z_m[j * map.nx + i] = SurfaceMap::kMissing;
  const PathAndCounts walked = walk(map, {0, 0, 12e-3, 0.1e-3, 90, 0, 3});
  for (const PathPoint& p : walked.points) ASSERT_LE(std::abs(p.z_m), 12.1e-6);
  EXPECT_EQ(walked.points.back().on_part, OnPart::bridged);
}

TEST(TurnSpectrum, FindsHarmonicsForAnyLength) {
  for (const std::size_t n : {8u, 30u, 97u, 720u}) {
    TurnSpectrum spectrum(n, 10);
    const std::size_t highest = n / 2 > 15 ? 15 : 3;
    for (int turn = 0; turn < 3; ++turn)
      for (std::size_t k = 0; k < n; ++k) {
        const double a = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n);
        spectrum.add(5 + std::cos(a) + 0.3 * std::sin(3 * a) +
                     0.02 * (turn + 1) / 3 * std::sin(static_cast<double>(highest) * a));
      }
    spectrum.add(6);
    spectrum.add(99);  // a reading of an incomplete turn
    EXPECT_EQ(spectrum.turns(), 3u);
    EXPECT_EQ(spectrum.undulations(0.01), highest) << n;
    EXPECT_EQ(spectrum.undulations(0.1), 3u) << n;
    EXPECT_EQ(spectrum.undulations(0.9), 1u) << n;
    if (highest == 15) {
      EXPECT_NEAR(spectrum.left_out().pv, 0.04, 0.001) << n;
      // RMS of three turns with 1/3, 2/3 and 3/3 of the amplitude.
      EXPECT_NEAR(spectrum.left_out().rms, 0.02 * std::sqrt(14. / 27 / 2), 1e-9) << n;
    } else {
      EXPECT_NEAR(spectrum.left_out().pv, 0, 1e-14);
    }
  }
  TurnSpectrum flat(360, -1);
  for (int k = 0; k < 720; ++k) flat.add(1e-3);
  flat.finish();
  EXPECT_EQ(flat.undulations(0.01), 0u);
}

// A spiral over a sphere ends each turn higher than it begins. This difference is not an
// undulation.
TEST(TurnSpectrum, FeedIsNoUndulation) {
  constexpr std::size_t n = 72;
  for (const double wave_m : {0.0, 1e-6}) {
    TurnSpectrum spectrum(n, 5);
    for (std::size_t k = 0; k <= 40 * n; ++k) {
      const double turns = static_cast<double>(k) / n, rho_m = 10e-3 - turns * 4e-6;
      spectrum.add(-rho_m * rho_m / 0.2 + wave_m * std::cos(4 * std::numbers::pi * turns));
    }
    EXPECT_EQ(spectrum.turns(), 40u);
    EXPECT_EQ(spectrum.undulations(0.01), wave_m > 0 ? 2u : 0u);
    EXPECT_LT(spectrum.left_out().pv, 1e-10);
  }
}

// A step of 5 um over 0.5 mm (2.5 turns), and waves of 0.1 um.
double ring_m(double rho_m, double angle, double wave_m, double step_m = 5e-6) {
  const double s = std::clamp((rho_m - 5.75e-3) / 0.5e-3, 0.0, 1.0);
  return step_m * s * s * (3 - 2 * s) + wave_m * std::cos(12 * angle);
}

// The bend of a surface of revolution causes no undulations and does not hide the undulations of
// other turns.
TEST(TurnSpectrum, RingIsNoUndulationAndHidesNone) {
  constexpr std::size_t n = 720;
  for (const double wave_m : {0.0, 0.1e-6}) {
    TurnSpectrum spectrum(n, -1);
    for (std::size_t k = 0; k <= 45 * n; ++k) {
      const double turns = static_cast<double>(k) / n;
      spectrum.add(ring_m(9e-3 - 0.2e-3 * turns, 2 * std::numbers::pi * turns, wave_m));
    }
    EXPECT_EQ(spectrum.undulations(0.01), wave_m > 0 ? 12u : 0u);
  }
}

// A kink anywhere in a turn. Without the factor |sin|, the wave of 4 nm is larger than the limit
// only for harmonics above 5: 1 um / (5 pi)^2 = 4.05 nm.
TEST(TurnSpectrum, KinkLeavesAmplitudesBelowTheInverseSquareOfTheHarmonic) {
  for (const std::size_t n : {7u, 12u, 72u, 720u})
    for (const double place : {0.0, 0.01, 0.25, 1. / 3, 0.5, 0.9, 0.999}) {
      TurnSpectrum spectrum(n, -1);
      for (std::size_t k = 0; k <= 5 * n; ++k)
        spectrum.add(1e-6 *
                     std::max(0.0, static_cast<double>(k) / static_cast<double>(n) - 2 - place));
      EXPECT_EQ(spectrum.undulations(1e-9), 0u) << n << ' ' << place;
    }
  for (const double wave_h : {1.0, 2.0, 6.0, 20.0}) {
    TurnSpectrum spectrum(72, -1);
    for (std::size_t k = 0; k <= 3 * 72; ++k) {
      const double turns = static_cast<double>(k) / 72, wave = 2 * std::numbers::pi * wave_h;
      spectrum.add(4e-9 * std::cos(wave * turns) - 1e-6 * turns * turns / 2);
    }
    EXPECT_EQ(spectrum.undulations(0.5), wave_h > 7 ? 20u : 0u) << wave_h;
  }
}

// The last turn is complete, but the height of its end is unknown.
TEST(TurnSpectrum, BendOfTheLastTurnIsNoUndulation) {
  TurnSpectrum spectrum(72, -1);
  for (std::size_t k = 0; k < 4 * 72; ++k) spectrum.add(-1e-6 * std::pow(k / 72.0, 2));
  spectrum.finish();
  EXPECT_EQ(spectrum.turns(), 4u);
  EXPECT_EQ(spectrum.undulations(1e-9), 0u);
}

// Interpolation between pixels gives a step along a ring small angular waves (to 5 nm).
TEST(SpiralPath, InterpolationOfARingIsNoUndulation) {
  for (const double feed_m : {0.2e-3, 0.02e-3})
    for (const double wave_m : {0.0, 0.1e-6}) {
      const SurfaceMap map = map_of(
          [&](double x, double y) { return ring_m(std::hypot(x, y), std::atan2(y, x), wave_m); },
          0.1e-3);
      const auto path = SpiralPath::over(map, {0, 0, 9e-3, feed_m, 720, 0, 3});
      ASSERT_TRUE(path);
      TurnSpectrum spectrum = path->spectrum(-1);
      ASSERT_TRUE(path->each([&](const PathPoint& p) {
        if (p.rho_m > 3e-3) spectrum.add(p.z_m);
        return Status();
      }));
      EXPECT_EQ(spectrum.undulations(0.01), wave_m > 0 ? 12u : 0u) << feed_m;
    }
}

// Differences between the cubics over six and four pixels: 1/96 of 1 -3 2 2 -3 1.
TEST(InterpolationErrorByHand, IsTheMeanOfARing) {
  SurfaceMap map = map_of([](double, double) { return 0.0; }, 1e-3, 21);
  map.z_m[10 * 21 + 10] = 96;  // a spike in the centre
  const InterpolationError error(map, 0, 0, 10e-3);
  // Ring 0: in each direction the two middles beside the spike have the difference 2.
  EXPECT_NEAR(error.largest_m(0, 0), 4, 1e-12);
  EXPECT_EQ(error.largest_m(8e-3, 9e-3), 0);
  EXPECT_EQ(error.largest_m(1, 2), 0);
  const InterpolationError small(map_of([](double x, double) { return x; }, 1e-3, 3), 0, 0, 1);
  EXPECT_EQ(small.largest_m(0, 1e-3), 0);
}

TEST(FeedRoughness, MatchesThePaper) {
  const FeedRoughness rough = feed_roughness(0.2e-3, 4e-6);
  EXPECT_NEAR(rough.Ra_m, 2.6e-9, 0.05e-9);
  EXPECT_NEAR(rough.Rt_m, 10e-9, 0.01e-9);
}

}  // namespace
}  // namespace mdof::algo
