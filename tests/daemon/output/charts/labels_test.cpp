#include "daemon/output/charts/labels.h"

#include <gtest/gtest.h>

#include <limits>

namespace mdof::charts {
namespace {

// Rounded by hand to two significant digits of u (GUM 7.2.6).
TEST(Labels, ValuesEndAtTheSecondDigitOfTheirUncertainty) {
  const struct {
    double value, u;
    const char *value_text, *u_text;
  } cases[] = {{30.0671, 0.056, "30.067", "0.056"},  {-2.385361, 0.000524, "−2.38536", "0.00052"},
               {12.3612, 0.0996, "12.36", "0.10"},   {3998.4, 201.3, "4000", "200"},
               {-3996.6, 43.7, "−3997", "44"},       {12.4, 8778, "0", "8800"},
               {1234567, 99600, "1230000", "100000"}};
  for (const auto& c : cases) {
    EXPECT_EQ(value_text(c.value, c.u), c.value_text) << c.value;
    EXPECT_EQ(uncertainty_text(c.u), c.u_text) << c.u;
  }
  EXPECT_EQ(uncertainty_text(0), "0");
  EXPECT_EQ(uncertainty_text(std::numeric_limits<double>::quiet_NaN()), "–");
}

}  // namespace
}  // namespace mdof::charts
