#include "algo/form/local_parabola.h"

#include <gtest/gtest.h>

namespace mdof::algo {
namespace {

// z = 3 + 2x - y + 5x² - 4xy + 7y² has the second derivatives 10, -4 and 14 in every square.
SurfaceMap paraboloid(std::size_t nx, std::size_t ny) {
  SurfaceMap map{"map", 0, 0, 0.5, 0.25, nx, ny, {}, {}};
  for (std::size_t j = 0; j < ny; ++j)
    for (std::size_t i = 0; i < nx; ++i) {
      const double x = 0.5 * static_cast<double>(i), y = 0.25 * static_cast<double>(j);
      map.z_m.push_back(3 + 2 * x - y + 5 * x * x - 4 * x * y + 7 * y * y);
    }
  return map;
}

// The squares fit into the map, extend beyond its edge, are as large as the map, or are extremely
// large.
TEST(LocalParabola, FindsAParabolaWithAnySquare) {
  const SurfaceMap map = paraboloid(20, 12);
  for (const double side : {2.0, 5.0, 10.0, 100.0, 1e9, 1e300}) {
    const LocalParabola square(map, side, 0);
    ASSERT_TRUE(square.is_large_enough());
    for (const auto& [i, j] : {std::pair<std::size_t, std::size_t>{0, 0}, {10, 6}, {19, 11}}) {
      Parabola found;
      ASSERT_TRUE(square.at(i, j, found)) << side;
      EXPECT_NEAR(found.z_m, map.at(i, j), 1e-9) << side;
      EXPECT_NEAR(found.xx, 10, 1e-9) << side;
      EXPECT_NEAR(found.xy, -4, 1e-9) << side;
      EXPECT_NEAR(found.yy, 14, 1e-9) << side;
    }
  }
}

// The square has 401 x 401 weights. A matrix whose size is the square of this number would need 200
// GB.
TEST(LocalParabola, LargeSquareNeedsLittleMemory) {
  const SurfaceMap map = paraboloid(401, 801);
  Parabola found;
  ASSERT_TRUE(LocalParabola(map, 200, 0.5).at(200, 400, found));
  EXPECT_NEAR(found.yy, 14, 1e-8);
}

}  // namespace
}  // namespace mdof::algo
