// The effect of a rotation by 180° on a surface. It is compared with the rotation of two vectors:
// the normal of the surface and the direction of motion.
#include "algo/separation/set_up.h"

#include <gtest/gtest.h>

namespace mdof::algo {
namespace {

// A rotation by 180° about an axis does not change the component along this axis and inverts the
// others.
double sign_after(Axis about, Axis of) {
  return about == of ? 1 : -1;
}

TEST(HalfTurn, SignsMatchTheTurnedVectors) {
  for (const Axis motion : {Axis::x, Axis::y, Axis::z}) {
    for (const Surface surface : {Surface::side, Surface::top}) {
      const Axis normal = across(motion, surface).normal;
      ASSERT_NE(normal, motion);
      for (const Axis about : {Axis::x, Axis::y, Axis::z}) {
        const HalfTurn turn = half_turn(motion, normal, about);
        EXPECT_EQ(turn.height_sign, sign_after(about, normal));
        EXPECT_EQ(turn.end_for_end ? -1 : 1, sign_after(about, motion));
      }
    }
  }
}

TEST(HalfTurn, NormalsAreAlongYAndZOfTheLocalFrame) {
  EXPECT_EQ(across(Axis::x, Surface::side).normal, Axis::y);
  EXPECT_EQ(across(Axis::x, Surface::top).normal, Axis::z);
  EXPECT_EQ(across(Axis::y, Surface::side).normal, Axis::x);
  EXPECT_EQ(across(Axis::y, Surface::top).normal, Axis::z);
  EXPECT_EQ(across(Axis::z, Surface::side).normal, Axis::x);
  EXPECT_EQ(across(Axis::z, Surface::top).normal, Axis::y);
  for (const Axis motion : {Axis::x, Axis::y, Axis::z})
    for (const Surface surface : {Surface::side, Surface::top}) {
      const AcrossSurface a = across(motion, surface);
      EXPECT_EQ(error_names(motion)[a.named].name[1], letter(a.normal));
    }
}

}  // namespace
}  // namespace mdof::algo
