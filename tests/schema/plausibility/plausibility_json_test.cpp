#include "schema/plausibility/plausibility_json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <regex>

namespace mdof {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Plausibility example() {
  Plausibility p;
  p.cycle = "standard";
  p.runs = 2;
  p.n_ij = {{0.0123456789, {1, 0}, {1, 1}}, {30.1e-3, {1, 2}, {0, 1}}};
  p.left_out = {{-5e-3, 123'456'789'012, "the axis was \"parked\" there"}};
  p.short_stops = 3;
  p.rate_hz = 1000 / 3.0;
  p.encoder_min_m = -1e-3, p.encoder_max_m = 61e-3;
  p.scans = 123456, p.scans_lost = 7, p.gaps = 2;
  p.probes = {{"A", 78, 10.4e-9, 12e-6, -3e-6, 9e-6}, {"B", 0, kNaN, kNaN, kNaN, kNaN}};
  return p;
}

TEST(PlausibilityJson, IsReadAsItWasWritten) {
  const std::string json = plausibility_json(example());
  const auto back = read_plausibility_json(json);
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(plausibility_json(*back), json);
  EXPECT_TRUE(std::isnan(back->probes[1].sd_m));
}

// Renames one member after another. A missing member must be an error and must not be read as 0.
// Members that only people read are an exception (target, targets, left_out_total), and duration_s,
// which older documents do not contain.
TEST(PlausibilityJson, ReportsAMissingMember) {
  const std::string json = plausibility_json(example());
  const std::regex key(R"re("([A-Za-z_]+)":)re");
  int members = 0;
  for (auto at = std::sregex_iterator(json.begin(), json.end(), key); at != std::sregex_iterator();
       ++at, ++members) {
    const std::string name = (*at)[1];
    const bool for_people =
        name == "target" || name == "targets" || name == "left_out_total" || name == "duration_s";
    std::string damaged = json;
    damaged[static_cast<std::size_t>(at->position(1))] ^= 1;
    const auto back = read_plausibility_json(damaged);
    EXPECT_EQ(back.has_value(), for_people) << damaged;
    if (back) continue;
    EXPECT_EQ(back.error().message, "the value of \"" + name + "\" cannot be read");
  }
  EXPECT_GE(members, 25);
}

TEST(PlausibilityJson, RejectsMembersOfAnotherType) {
  const std::string json = plausibility_json(example());
  const std::pair<const char*, const char*> changes[] = {
      {"\"runs\":2", "\"runs\":4294967298"},
      {"\"runs\":2", "\"runs\":-2"},
      {"[1,0]", "[1,\"0\"]"},
      {"[1,2]", "[1,4294967298]"},
      {"\"gaps\":2", "\"gaps\":null"},
      {"\"scans_lost\":7", "\"scans_lost\":7.5"},
      {"\"cycle\":\"standard\"", "\"cycle\":5"},
      {"\"encoder_min_mm\":", "\"encoder_min_mm\":[],\"_\":"},
      {"\"left_out\":[", "\"left_out\":[5,"},
      {"\"left_out\":[", "\"left_out\":5,\"_\":["},
  };
  for (const auto& [what, by] : changes) {
    std::string damaged = json;
    ASSERT_NE(damaged.find(what), std::string::npos) << what;
    damaged.replace(damaged.find(what), std::string(what).size(), by);
    EXPECT_FALSE(read_plausibility_json(damaged)) << damaged;
  }
  EXPECT_FALSE(read_plausibility_json("{"));
  EXPECT_FALSE(read_plausibility_json("[]"));
}

}  // namespace
}  // namespace mdof
