#include "schema/base/number/number_text.h"

#include <gtest/gtest.h>

#include <limits>

namespace mdof {
namespace {

TEST(PlainNumber, IsWrittenInReadableForm) {
  const std::pair<double, const char*> cases[] = {
      {5000, "5000"},     {4999.6, "5000"},           {200, "200"},        {0.25, "0.25"},
      {12.3456, "12.35"}, {-0.0001234, "-0.0001234"}, {123456, "123456"},  {1, "1"},
      {-0.0, "0"},        {1e300, "1e+300"},          {2.5e-9, "2.5e-09"}, {0.9999999, "1"}};
  for (const auto& [x, text] : cases) EXPECT_EQ(plain_number(x), text);
  EXPECT_EQ(plain_number(std::numeric_limits<double>::quiet_NaN()), "unknown");
  EXPECT_EQ(plain_number(12.3456, 3), "12.3");
}

}  // namespace
}  // namespace mdof
