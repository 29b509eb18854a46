// Tests the parts of the deformation by clamping, the factor K, and the stress of bent plates.
#include "algo/form/clamping.h"

#include <gtest/gtest.h>

#include <cmath>

#include "algo/form/map_figures.h"
#include "tests/algo/form/known_maps.h"

namespace mdof::algo {
namespace {

// The expected parts are calculated separately; the expected K comes from sums over all pixels.
TEST(Clamping, SeparatesElasticAndPlasticPartsAndFindsK) {
  const SurfaceMap before = map_of(bumps);
  const auto elastic = [](double x, double y) {
    return 1e-6 * std::sin(x / 10e-3) * (1 + y / 40e-3);
  };
  const auto rest = [](double x, double y) { return 0.05e-6 * std::cos(x / 4e-3 + y / 3e-3); };
  const SurfaceMap after = map_of([&](double x, double y) {
    return bumps(x, y) + 1.2 * elastic(x, y) + rest(x, y) + 2e-6 + 1e-5 * x;
  });
  const SurfaceMap released = map_of([&](double x, double y) {
    return bumps(x, y) + 0.2 * elastic(x, y) + rest(x, y) - 1e-6 * x;
  });
  const auto found = clamping_by_release(before, after, released);
  ASSERT_TRUE(found);
  SurfaceMap e = map_of(elastic), r = map_of(rest);
  remove_plane(e);
  remove_plane(r);
  double er = 0, ee = 0;
  for (std::size_t k = 0; k < e.z_m.size(); ++k) {
    er += e.z_m[k] * r.z_m[k];
    ee += e.z_m[k] * e.z_m[k];
  }
  EXPECT_NEAR(found->K, 0.2 + er / ee, 1e-9);
  EXPECT_NEAR(figures_of(found->elastic).rms_m, figures_of(e).rms_m, 1e-14);
  EXPECT_NEAR(*found->K_unexplained_rms_m, figures_of(r).rms_m, 0.001e-6);
  const auto by_K = clamping_by_K(before, after, 0.25);
  EXPECT_NEAR(figures_of(by_K->elastic).rms_m * 1.25, figures_of(by_K->clamping).rms_m, 1e-15);
  EXPECT_NEAR(figures_of(by_K->plastic).pv_m * 4, figures_of(by_K->elastic).pv_m, 1e-15);
  EXPECT_FALSE(clamping_by_K(before, after, -1));
  EXPECT_FALSE(clamping_by_release(before, after, after));
}

// Closed forms for a plate that is bent to a cylinder, and for one bent to a saddle (pure shear at
// 45 degrees).
TEST(PlateStress, MatchesClosedForms) {
  const Plate plate{2.5e-3, 70e9, 0.33};
  const double c = 1 / 50.0;  // 1/m
  const auto cylinder =
      plate_stress(map_of([&](double x, double) { return c * x * x / 2; }), plate, 5e-3);
  ASSERT_TRUE(cylinder);
  const double s = 70e9 * 2.5e-3 / 2 / (1 - 0.33 * 0.33) * c;
  EXPECT_NEAR(cylinder->max_Pa, s * std::sqrt(1 - 0.33 + 0.33 * 0.33), 1e-6 * s);
  // Twelve pixels at each corner of the map are omitted: less than half of their square exists.
  EXPECT_EQ(cylinder->pixels, 121u * 81u - 4 * 12u);
  const auto twist =
      plate_stress(map_of([&](double x, double y) { return c * x * y; }), plate, 5e-3);
  EXPECT_NEAR(twist->max_Pa, std::sqrt(3) * 70e9 * 2.5e-3 / 2 / 1.33 * c, 1e-6 * s);
  // The form is a paraboloid with a hole. The stress must be the same at the edge of the hole.
  SurfaceMap dish = map_of([&](double x, double y) { return c * (x * x + y * y) / 2; });
  for (std::size_t j = 30; j < 50; ++j)
    for (std::size_t i = 20; i < 60; ++i) dish.z_m[j * dish.nx + i] = SurfaceMap::kMissing;
  EXPECT_NEAR(plate_stress(dish, plate, 5e-3)->max_Pa, s * 1.33, 1e-6 * s);
  EXPECT_FALSE(plate_stress(dish, plate, 0.9e-3));
}

// The square has 5 x 3 pixels, the map has nine pixels. About a pixel of the middle row, nine of
// the fifteen pixels of the square exist; about other pixels six exist, which is less than half.
// The curvatures are a and b, the twist is c.
TEST(PlateStress, NeedsHalfOfTheSquare) {
  const Plate plate{2e-3, 200e9, 0.3};
  const double a = 0.02, b = -0.05, face = 200e9 * 2e-3 / 2;
  for (const double c : {0.0, 0.2}) {
    SurfaceMap form{"nine", -1e-3, -2e-3, 1e-3, 2e-3, 3, 3, {}, {}};
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t i = 0; i < 3; ++i) {
        const double x = form.x_m(i), y = form.y_m(j);
        form.z_m.push_back(a * x * x / 2 + b * y * y / 2 + c * x * y + 1e-3 * x - 2e-3 * y);
      }
    const auto found = plate_stress(form, plate, 4e-3);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->pixels, 3u);
    const double x = face / 0.91 * (a + 0.3 * b), y = face / 0.91 * (b + 0.3 * a),
                 t = face / 1.3 * c;
    EXPECT_NEAR(found->max_Pa, std::sqrt(x * x - x * y + y * y + 3 * t * t), 1e-3 * face * 0.05);
  }
}

}  // namespace
}  // namespace mdof::algo
