// Compares the hash of a table with the hash of the bytes that the header of table_sha256
// describes. Another program assembled these bytes (Python's struct and hashlib).
#include "schema/compensation_table.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mdof {
namespace {

CompensationTable table() {
  CompensationTable t;
  t.axis = Axis::y;
  t.simulated = true;
  t.slope_removed = false;
  t.runs = {3, 7};
  t.sides.against_encoder = true;
  t.machine = chain_from("w-Y-X-b-Z-t", "Y+ X- Z+").value();
  t.stated = {Reference::tool, {0.001, -0.002, 0.03}};
  t.position_m = {0, 0.0125, 0.025};
  int number = 0;
  for (auto* group : {&t.forward, &t.reverse, &t.u_forward, &t.u_reverse})
    for (auto& series : *group) series = {1e-6 * ++number, std::nan(""), -0.0};
  t.positioning.forward = {2e-6, 3e-6, 4e-6};
  t.positioning.u_forward = {5e-7, 5e-7, 5e-7};
  return t;
}

TEST(TableHash, MatchesTheBytesStatedInTheHeader) {
  EXPECT_EQ(table_sha256(table()),
            "83fd5c05342ee5db20b1db86a4a29127f8fd112e2cbdac5ddeebf88097615f60");
}

TEST(TableHash, DoesNotDependOnIdAndDate) {
  CompensationTable same = table();
  same.id = 5;
  same.created_utc = "2026-11-25T00:00:00Z";
  same.not_declared = {"temperature"};
  same.sha256 = "before";
  EXPECT_EQ(table_sha256(same), table_sha256(table()));
}

// If one bit of any member changes, the hash must change.
TEST(TableHash, DiffersWithEachMember) {
  const std::string before = table_sha256(table());
  const auto differs = [&](auto change) {
    CompensationTable other = table();
    change(other);
    EXPECT_NE(table_sha256(other), before);
  };
  differs([](auto& t) { t.axis = Axis::x; });
  differs([](auto& t) { t.simulated = false; });
  differs([](auto& t) { t.slope_removed = true; });
  differs([](auto& t) { t.runs = {7, 3}; });
  differs([](auto& t) { t.sides.fixture_moves = true; });
  differs([](auto& t) { t.sides.against_encoder = false; });
  differs([](auto& t) { t.machine = {}; });
  differs([](auto& t) { t.stated.reference = Reference::carriage; });
  differs([](auto& t) { t.stated.point_m[2] = std::nextafter(0.03, 1); });
  differs([](auto& t) { t.position_m[1] = std::nextafter(0.0125, 1); });
  differs([](auto& t) { std::swap(t.forward, t.reverse); });
  differs([](auto& t) { t.u_reverse[4][0] = std::nextafter(t.u_reverse[4][0], 1); });
  differs([](auto& t) { t.u_declared[0] = {1e-9, 1e-9, 1e-9}; });
  differs([](auto& t) { std::swap(t.positioning.forward, t.positioning.reverse); });
  differs([](auto& t) { t.positioning.u_declared = {1e-9, 1e-9, 1e-9}; });
}

}  // namespace
}  // namespace mdof
