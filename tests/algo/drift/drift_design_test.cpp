#include "algo/drift/drift_design.h"

#include <gtest/gtest.h>

namespace mdof::algo {
namespace {

TEST(DriftDesign, UsesOnlyOrdersThatRepeatedVisitsDetermine) {
  std::vector<TimedVisit> visits;
  for (int i = 0; i < 20; ++i) visits.push_back({static_cast<std::size_t>(i % 10), 1.0 * i});
  const DriftDesign twice(visits);
  EXPECT_GE(twice.orders(), 1);
  EXPECT_LT(twice.orders(), DriftDesign::kMostOrders);  // one order is nearly equal in both runs
  EXPECT_DOUBLE_EQ(twice.freedom(), 20 - 10 - twice.orders());
  visits.resize(10);
  EXPECT_EQ(DriftDesign(visits).orders(), 0);
  EXPECT_EQ(DriftDesign({}).orders(), 0);
  EXPECT_EQ(DriftDesign({{0, 1}, {0, 1}, {0, 1}, {0, 1}, {0, 1}, {0, 1}}).orders(), 0);
}

}  // namespace
}  // namespace mdof::algo
