// Signs of the correction for each error of a table. A rotary axis between the measured axis and
// the correcting axis can make the correction impossible. Expected values were found by hand.
#include "schema/rig/correction.h"

#include <gtest/gtest.h>

namespace mdof {
namespace {

CorrectionSigns of_X(const char* chain) {
  return correction_signs(parse_chain(chain).value(), Axis::x, {}, Reference::fixture);
}

constexpr std::size_t kEYX = 0, kEZX = 1;

TEST(Correction, DependsOnRotaryAxesBetweenTheAxes) {
  // X and Y move the workpiece, Z moves the tool. The correction is minus the error EYX in Y, and
  // plus the error EZX in Z.
  EXPECT_EQ(of_X("w-X-Y-b-Z-t").factor[kEYX], -1);
  EXPECT_EQ(of_X("w-X-Y-b-Z-t").factor[kEZX], 1);
  // C rotates the direction of Y relative to X, on the workpiece side and on the tool side of the
  // bed. C does not rotate the direction of Z.
  for (const char* chain : {"w-X-C-Y-b-Z-t", "w-X-C-b-Y-Z-t", "w-X-b-C-Y-Z-t"}) {
    EXPECT_EQ(of_X(chain).factor[kEYX], 0) << chain;
    EXPECT_NE(of_X(chain).gap[kEYX], "") << chain;
    EXPECT_EQ(of_X(chain).factor[kEZX], 1) << chain;
  }
  // B rotates the direction of Z, but not the direction of Y. A rotary axis that is not between
  // the two axes has no effect.
  EXPECT_EQ(of_X("w-X-B-Y-b-Z-t").factor[kEYX], -1);
  EXPECT_EQ(of_X("w-X-B-Y-b-Z-t").factor[kEZX], 0);
  EXPECT_EQ(of_X("w-C-X-Y-b-Z-B-t").factor[kEYX], -1);
  EXPECT_EQ(of_X("w-C-X-Y-b-Z-B-t").factor[kEZX], 1);
}

}  // namespace
}  // namespace mdof
