// Tests the parts of the deformation by clamping, the factor K, and the stress of bent plates.
#include "algo/form/clamping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

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

// A form without symmetry; row 0 is the lowest.
SurfaceMap skew_form(std::size_t nx, std::size_t ny) {
  SurfaceMap map{"skew", 0, 0, 1e-3, 1e-3, nx, ny, {}, {}};
  for (std::size_t j = 0; j < ny; ++j)
    for (std::size_t i = 0; i < nx; ++i) {
      const double x = static_cast<double>(i), y = static_cast<double>(j);
      map.z_m.push_back(1e-6 * (std::sin(0.7 * x + 0.2) + std::cos(0.9 * y + 0.5 + 0.1 * x)));
    }
  return map;
}

SurfaceMap reversed_form(const SurfaceMap& map, bool in_x, bool in_y) {
  SurfaceMap out = map;
  for (std::size_t j = 0; j < map.ny; ++j)
    for (std::size_t i = 0; i < map.nx; ++i)
      out.z_m[(in_y ? map.ny - 1 - j : j) * map.nx + (in_x ? map.nx - 1 - i : i)] = map.at(i, j);
  return out;
}

// The map is changed by a small wave and a plane, then reversed.
TEST(MirroredMatch, FindsTheReversedDirections) {
  const SurfaceMap before = skew_form(20, 15);
  SurfaceMap after = before, wave = before;
  for (std::size_t j = 0; j < 15; ++j)
    for (std::size_t i = 0; i < 20; ++i) {
      const std::size_t k = j * 20 + i;
      wave.z_m[k] = 0.02e-6 * std::cos(static_cast<double>(3 * i + 5 * j));
      after.z_m[k] += wave.z_m[k] + 1e-6 * static_cast<double>(i) - 3e-6;
    }
  remove_plane(wave);
  EXPECT_FALSE(mirrored_match(before, after));
  for (const auto& [in_x, in_y, name] :
       {std::tuple{true, false, "x"}, {false, true, "y"}, {true, true, "x, y"}}) {
    const SurfaceMap turned = reversed_form(after, in_x, in_y);
    SurfaceMap given = turned;
    for (std::size_t k = 0; k < given.z_m.size(); ++k) given.z_m[k] -= before.z_m[k];
    remove_plane(given);
    const auto found = mirrored_match(before, turned);
    ASSERT_TRUE(found) << name;
    EXPECT_EQ(found->mirrored, name);
    EXPECT_NEAR(found->mirrored_rms_m, figures_of(wave).rms_m, 1e-14);
    EXPECT_NEAR(found->rms_m, figures_of(given).rms_m, 1e-14);
  }
}

// The wave that remains is 0.49 or 0.51 times the difference of the maps as given: in one column on
// each side of the middle, x is reversed.
TEST(MirroredMatch, NeedsHalfOfTheDifference) {
  for (const double share : {0.49, 0.51}) {
    SurfaceMap before{"wave", 0, 0, 1, 1, 8, 8, {}, {}};
    // p is odd about the middle in x, q is even; both are free of planes.
    const double p[] = {1, -3, 3, -1, 1, -3, 3, -1}, q[] = {1, -1, -1, 1, 1, -1, -1, 1};
    for (std::size_t j = 0; j < 8; ++j)
      for (std::size_t i = 0; i < 8; ++i) before.z_m.push_back(q[j] * (p[i] - p[7 - i]) / 2);
    SurfaceMap after = reversed_form(before, true, false), even = before;
    // The reversed map has the opposite sign, so the difference as given is twice the map.
    for (std::size_t j = 0; j < 8; ++j)
      for (std::size_t i = 0; i < 8; ++i) even.z_m[j * 8 + i] = q[j] * q[i];
    const double odd_rms = figures_of(before).rms_m;
    // after = -before + w even: given² = (2 odd)² + w², mirrored = w.
    const double w = share / std::sqrt(1 - share * share) * 2 * odd_rms;
    for (std::size_t k = 0; k < 64; ++k) after.z_m[k] += w * even.z_m[k];
    EXPECT_EQ(mirrored_match(before, after).has_value(), share < 0.5) << share;
  }
}

// Each map lacks the last columns. The reversed map lacks the first ones, so the two have fewer
// common columns: at least 90 % of those as given are necessary.
TEST(MirroredMatch, NeedsTheCommonPixels) {
  for (const std::size_t missing : {1u, 2u}) {
    SurfaceMap before = skew_form(20, 15), after = reversed_form(before, true, false);
    for (SurfaceMap* map : {&before, &after})
      for (std::size_t j = 0; j < 15; ++j)
        for (std::size_t i = 20 - missing; i < 20; ++i) map->z_m[j * 20 + i] = SurfaceMap::kMissing;
    EXPECT_EQ(mirrored_match(before, after).has_value(), missing == 1) << missing;
  }
  const SurfaceMap before = skew_form(20, 15);
  SurfaceMap empty = before;
  empty.z_m.assign(empty.z_m.size(), SurfaceMap::kMissing);
  EXPECT_FALSE(mirrored_match(before, empty));
}

// The plastic part is K times the elastic part and a part that K does not explain.
TEST(Clamping, SpringsPastIfANegativeKExplainsHalf) {
  const SurfaceMap flat = map_of([](double, double) { return 0.0; });
  const auto x_wave = [](double x, double) { return 1e-6 * std::cos(x / 10e-3); };
  const auto y_wave = [](double, double y) { return 1e-6 * std::cos(y / 4e-3); };
  const auto past = [&](double K, double rest) {
    const SurfaceMap released =
        map_of([&](double x, double y) { return K * x_wave(x, y) + rest * y_wave(x, y); });
    SurfaceMap after = released;
    const SurfaceMap elastic = map_of(x_wave);
    for (std::size_t k = 0; k < after.z_m.size(); ++k) after.z_m[k] += elastic.z_m[k];
    const auto found = clamping_by_release(flat, after, released);
    EXPECT_TRUE(found);
    return springs_past(*found);
  };
  EXPECT_TRUE(past(-0.3, 0));
  EXPECT_TRUE(past(-0.3, 0.1));
  EXPECT_FALSE(past(-0.3, 0.3));
  EXPECT_FALSE(past(0.3, 0));
  EXPECT_FALSE(springs_past(*clamping_by_K(flat, map_of(x_wave), -0.3)));
}

}  // namespace
}  // namespace mdof::algo
