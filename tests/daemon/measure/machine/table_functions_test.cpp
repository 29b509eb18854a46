// Columns of a table as error functions of a machine: unknown values, and the position at which
// angles are zero.
#include "daemon/measure/machine/table_functions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "schema/sample.h"

namespace mdof::daemon {
namespace {

TEST(TableFunctions, AnUnknownUIsReplacedByTheLargestKnownU) {
  const ErrorFunction f =
      error_function({0, 1, 2}, {5, 6, 7}, {5, kNaN, 7}, {0.1, kNaN, 0.3}, {0.01, kNaN, 0.02});
  EXPECT_EQ(f.reverse, (std::vector<double>{5, 6, 7}));
  EXPECT_EQ(f.u, (std::vector<double>{0.1, 0.3, 0.3}));
  const ErrorFunction none = error_function({0, 1}, {5, 6}, {5, 6}, {kNaN, kNaN}, {kNaN, kNaN});
  EXPECT_TRUE(none.u.empty());
  EXPECT_TRUE(none.u_independent.empty());
}

// The mean of both approaches is 0, 4, 6 at the positions -2, 0, 4. At position 1 the interpolated
// mean is 4.5.
TEST(TableFunctions, AnAngleIsSetToZeroAtTheGivenPosition) {
  const ErrorFunction table =
      error_function({-2, 0, 4}, {-1, 3, 5}, {1, 5, 7}, {0.3, 0.4, 0.8}, {0.1, 0.1, 0.1});
  ErrorFunction f = table;
  set_angle_zero_at(f, 1);
  EXPECT_EQ(f.forward, (std::vector<double>{-5.5, -1.5, 0.5}));
  EXPECT_EQ(f.reverse, (std::vector<double>{-3.5, 0.5, 2.5}));
  EXPECT_EQ(f.u, table.u);
  EXPECT_EQ(f.u_independent, table.u_independent);
  bound_angle_u(f, 1);  // u at position 1 is 0.5
  EXPECT_NEAR(f.u[0], 0.8, 1e-15);
  EXPECT_NEAR(f.u[2], 1.3, 1e-15);
  ErrorFunction held = table;
  set_angle_zero_at(held, 9);  // position 9 is beyond the end, so the value at the end is used
  EXPECT_EQ(held.forward, (std::vector<double>{-7, -3, -1}));
  for (const double first : {-2.0, -9.0}) {
    ErrorFunction same = table;
    set_angle_zero_at(same, first);
    bound_angle_u(same, first);
    EXPECT_EQ(same.forward, table.forward);
    EXPECT_EQ(same.u, table.u);
  }
}

}  // namespace
}  // namespace mdof::daemon
