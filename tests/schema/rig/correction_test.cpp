// Which errors of a table have a correction: by hand, of chains with a rotary axis on the way from
// the measured axis to the correcting one.
#include "schema/rig/correction.h"

#include <gtest/gtest.h>

namespace mdof {
namespace {

CorrectionSigns of_X(const char* chain) {
  return correction_signs(parse_chain(chain).value(), Axis::x, {}, Reference::fixture);
}

constexpr std::size_t kEYX = 0, kEZX = 1;

TEST(Correction, TurnsWithARotaryAxisOnTheWay) {
  // X and Y carry the work, Z the tool: c = -E in Y, +E in Z.
  EXPECT_EQ(of_X("w-X-Y-b-Z-t").factor[kEYX], -1);
  EXPECT_EQ(of_X("w-X-Y-b-Z-t").factor[kEZX], 1);
  // C turns Y against X, on the work's side and beyond the bed, and leaves Z.
  for (const char* chain : {"w-X-C-Y-b-Z-t", "w-X-C-b-Y-Z-t", "w-X-b-C-Y-Z-t"}) {
    EXPECT_EQ(of_X(chain).factor[kEYX], 0) << chain;
    EXPECT_NE(of_X(chain).gap[kEYX], "") << chain;
    EXPECT_EQ(of_X(chain).factor[kEZX], 1) << chain;
  }
  // B turns Z, and leaves Y; outside of the way nothing is turned.
  EXPECT_EQ(of_X("w-X-B-Y-b-Z-t").factor[kEYX], -1);
  EXPECT_EQ(of_X("w-X-B-Y-b-Z-t").factor[kEZX], 0);
  EXPECT_EQ(of_X("w-C-X-Y-b-Z-B-t").factor[kEYX], -1);
  EXPECT_EQ(of_X("w-C-X-Y-b-Z-B-t").factor[kEZX], 1);
}

}  // namespace
}  // namespace mdof
