#include "algo/machine/tiny_angle.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mdof::algo {
namespace {

// The error is at most 1 ulp up to 0.1 rad, as documented.
TEST(TinyAngle, MatchesTheStandardLibrary) {
  for (int k = -1000; k <= 1000; ++k) {
    const double x = 1e-4 * k, sine = std::sin(x), cosine = std::cos(x);
    EXPECT_LE(std::abs(tiny_sin(x) - sine), std::nextafter(std::abs(sine), 1) - std::abs(sine));
    EXPECT_LE(std::abs(tiny_cos(x) - cosine), std::nextafter(cosine, 2) - cosine) << x;
  }
  EXPECT_EQ(tiny_cos(0.0), 1);
  EXPECT_EQ(tiny_sin(0.0), 0);
}

}  // namespace
}  // namespace mdof::algo
