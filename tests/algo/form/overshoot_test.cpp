// Overshoot of the cubics between pixels, by hand for a step and for a ridge, and compared with the
// heights of the surface.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "algo/form/surface.h"

namespace mdof::algo {
namespace {

// z along one direction; the other direction has `across` equal rows or columns.
SurfaceMap profile_map(const std::vector<double>& z, bool along_x, std::size_t across) {
  const std::size_t nx = along_x ? z.size() : across, ny = along_x ? across : z.size();
  SurfaceMap map{"profile", 4e-3, 7e-3, 2e-3, 3e-3, nx, ny, {}, {}};
  for (std::size_t j = 0; j < ny; ++j)
    for (std::size_t i = 0; i < nx; ++i) map.z_m.push_back(z[along_x ? i : j]);
  return map;
}

double overshoot_of(const std::vector<double>& z, bool along_x = true) {
  return overshoot_m(profile_map(z, along_x, 1), 0, 0, 1);
}

// Pixels 0, 0, 0, 0, h, h: the slopes at the two middle pixels are -h/12 and 7 h/12, so that the
// cubic is -t (1 - t) ((1 - t) + 7 t) h/12. At t = 0.65 it is -0.0929 h. Six pixels are needed.
TEST(OvershootByHand, OfAStepIsNinePercent) {
  const double expected = 0.65 * 0.35 * (0.35 + 7 * 0.65) / 12;
  EXPECT_NEAR(expected, 0.093, 5e-4);
  for (const bool along_x : {true, false})
    for (const double h : {1e-6, -1e-6}) {
      EXPECT_NEAR(overshoot_of({0, 0, 0, 0, h, h}, along_x), expected * 1e-6, 1e-18);
      EXPECT_NEAR(overshoot_of({h, h, 0, 0, 0, 0}, along_x), expected * 1e-6, 1e-18);
      EXPECT_NEAR(overshoot_of({0, 0, 0, 0, 0, 0, 0, h, h, h, h, h, h}, along_x), expected * 1e-6,
                  1e-18);
      EXPECT_EQ(overshoot_of({0, 0, 0, h, h}, along_x), 0);
      // Only the last pixel differs: the slope at the second middle pixel is -h/12.
      EXPECT_NEAR(overshoot_of({0, 0, 0, 0, 0, h}, along_x), 0.65 * 0.65 * 0.35 / 12 * 1e-6, 1e-18);
    }
}

// Pixels 0, 0, 1, 1, 0, 0: the slopes are ±8/12, so that the cubic is 1 + t (1 - t) 8/12. The
// curvature -1 at both pixels explains 1.25 t (1 - t)/2. In the middle 1/6 - 5/32 = 1/96 remains.
TEST(OvershootByHand, OfARidgeExceedsItsCurvature) {
  for (const bool along_x : {true, false}) {
    EXPECT_NEAR(overshoot_of({0, 0, 1, 1, 0, 0}, along_x), 1.0 / 96, 1e-15);
    EXPECT_NEAR(overshoot_of({1, 1, 0, 0, 1, 1}, along_x), 1.0 / 96, 1e-15);
  }
  // A parabola and a straight line are explained.
  EXPECT_EQ(overshoot_of({-25, -9, -1, -1, -9, -25}), 0);
  EXPECT_EQ(overshoot_of({25, 9, 1, 1, 9, 25}), 0);
  EXPECT_EQ(overshoot_of({0, 1, 2, 3, 4, 5}), 0);
  EXPECT_EQ(overshoot_of({0, 0, 1, SurfaceMap::kMissing, 0, 0}), 0);
}

// Only the left or lower one of the two pixels, at (8, 7) or (4, 13) mm, must be within the radius.
TEST(OvershootByHand, CountsOnlyPixelsWithinTheRadius) {
  const std::vector<double> ridge = {0, 0, 1, 1, 0, 0};
  const SurfaceMap x = profile_map(ridge, true, 1), y = profile_map(ridge, false, 1);
  EXPECT_GT(overshoot_m(x, 5e-3, 3e-3, 5.001e-3), 0);  // 3 and 4 mm beside the pixel
  EXPECT_EQ(overshoot_m(x, 5e-3, 3e-3, 4.999e-3), 0);
  EXPECT_GT(overshoot_m(y, 16e-3, 8e-3, 13.001e-3), 0);  // 12 and 5 mm
  EXPECT_EQ(overshoot_m(y, 16e-3, 8e-3, 12.999e-3), 0);
}

// Six random pixels. The surface gives the heights between the two middle pixels; the second
// differences at both pixels give what is explained.
TEST(Overshoot, MatchesTheHeightsOfTheSurface) {
  std::mt19937_64 engine(4);
  std::uniform_real_distribution<> height(-1, 1);
  int compared = 0;
  for (int trial = 0; trial < 400; ++trial) {
    std::vector<double> z(6);
    for (double& of_pixel : z) of_pixel = height(engine);
    const SurfaceMap map = profile_map(z, true, 6);
    const Surface surface(map, 0, Extension::parabola);
    const auto beyond = [&](double t) {
      SurfacePoint p;
      EXPECT_TRUE(surface.at(4e-3 + (2 + t) * 2e-3, 7e-3 + 2 * 3e-3, 0, p));
      const double line = (1 - t) * z[2] + t * z[3];
      const double bend_2 = z[1] - 2 * z[2] + z[3], bend_3 = z[2] - 2 * z[3] + z[4];
      const bool is_above = p.z_m > line;
      const double out = is_above ? p.z_m - std::max(z[2], z[3]) : std::min(z[2], z[3]) - p.z_m;
      const double bend = is_above ? -std::max(bend_2, bend_3) : std::min(bend_2, bend_3);
      return out - 1.25 * std::max(0.0, bend) * t * (1 - t) / 2;
    };
    if (beyond(0.5) <= 0) continue;  // the middle is looked at first
    ++compared;
    const double expected = std::max({beyond(0.35), beyond(0.5), beyond(0.65)});
    EXPECT_NEAR(overshoot_m(map, 0, 0, 1), expected, 1e-12) << trial;
  }
  EXPECT_GT(compared, 20);
}

}  // namespace
}  // namespace mdof::algo
