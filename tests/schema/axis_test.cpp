#include "schema/axis.h"

#include <gtest/gtest.h>

namespace mdof {
namespace {

TEST(Axis, NamedAndLocalErrorsAreInverse) {
  const Errors5 e{1, 2, 3, 4, 5};
  for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
    EXPECT_EQ(local_from_named(axis, named_from_local(axis, e)), e);
  }
  const Errors5 y = named_from_local(Axis::y, e);  // formulas in schema/axis.h
  EXPECT_EQ(y, (Errors5{-1, 2, -4, 3, 5}));
}

// All local frames are right-handed, so a roll about the axis of motion has the same sign for each
// axis.
TEST(Axis, LocalFramesAreRightHanded) {
  for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
    const auto a = local_axes(axis);
    for (std::size_t k = 0; k < 3; ++k) {  // the third row is the product of the first two
      const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
      EXPECT_EQ(a[0][l] * a[1][m] - a[0][m] * a[1][l], a[2][k]);
    }
    EXPECT_EQ(a[static_cast<std::size_t>(axis)][0], 1);  // the local x axis is along the motion
  }
}

}  // namespace
}  // namespace mdof
