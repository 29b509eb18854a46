// What half a turn does to a surface, by turning its normal and the motion as vectors.
#include "algo/separation/set_up.h"

#include <gtest/gtest.h>

namespace mdof::algo {
namespace {

// By 180° about an axis a vector keeps its part along it and loses the sign of the rest.
double sign_after(Axis about, Axis of) {
  return about == of ? 1 : -1;
}

TEST(HalfTurn, SignsAreThoseOfTheTurnedVectors) {
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

TEST(HalfTurn, SurfacesAreAlongYAndZOfTheLocalFrame) {
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
