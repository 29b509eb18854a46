// Which errors of a table have a correction, for chains with a rotary axis between the measured
// axis and the correcting axis. Calculated by hand.
#include "schema/rig/correction.h"

#include <gtest/gtest.h>

namespace mdof {
namespace {

CorrectionSigns of_X(const char* chain) {
  return correction_signs(parse_chain(chain).value(), Axis::x, {}, Reference::fixture);
}

constexpr std::size_t kEYX = 0, kEZX = 1;

TEST(Correction, DependsOnRotaryAxesBetweenTheAxes) {
  // X and Y move the work, Z moves the tool: c = -E in Y, +E in Z.
  EXPECT_EQ(of_X("w-X-Y-b-Z-t").factor[kEYX], -1);
  EXPECT_EQ(of_X("w-X-Y-b-Z-t").factor[kEZX], 1);
  // C rotates Y against X, on the work side and beyond the bed, and does not rotate Z.
  for (const char* chain : {"w-X-C-Y-b-Z-t", "w-X-C-b-Y-Z-t", "w-X-b-C-Y-Z-t"}) {
    EXPECT_EQ(of_X(chain).factor[kEYX], 0) << chain;
    EXPECT_NE(of_X(chain).gap[kEYX], "") << chain;
    EXPECT_EQ(of_X(chain).factor[kEZX], 1) << chain;
  }
  // B rotates Z, but not Y. A rotary axis outside the two axes has no effect.
  EXPECT_EQ(of_X("w-X-B-Y-b-Z-t").factor[kEYX], -1);
  EXPECT_EQ(of_X("w-X-B-Y-b-Z-t").factor[kEZX], 0);
  EXPECT_EQ(of_X("w-C-X-Y-b-Z-B-t").factor[kEYX], -1);
  EXPECT_EQ(of_X("w-C-X-Y-b-Z-B-t").factor[kEZX], 1);
}

}  // namespace
}  // namespace mdof
