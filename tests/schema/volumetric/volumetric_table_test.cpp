// The hash of a volumetric table covers all members except id and date. The order of the nodes is X
// fastest, then Y, then Z.
#include "schema/volumetric/volumetric_table.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "schema/volumetric/volumetric_json.h"

namespace mdof {
namespace {

VolumetricTable small_table() {
  VolumetricTable t;
  t.name = "mill";
  t.machine = parse_chain("w-X-b-Y-t").value();
  t.description = "name = \"mill\"";
  t.runs = {3, 5};
  t.command_m = {{{0, 0.01, 0.02}, {0, 0.05}, {0.03}}};
  for (std::size_t i = 0; i < 6; ++i) {
    const double x = static_cast<double>(i);
    t.correction_m.push_back({1e-6 * x, 2e-6, -3e-6});
    t.u_m.push_back({1e-8, 2e-8 * x, 3e-8});
  }
  t.not_measured = {"EXX"};
  return t;
}

TEST(VolumetricTable, NodesAreOrderedByXThenYThenZ) {
  const VolumetricTable t = small_table();
  ASSERT_EQ(t.nodes(), 6u);
  EXPECT_EQ(t.command_at(0), (Vec3{0, 0, 0.03}));
  EXPECT_EQ(t.command_at(2), (Vec3{0.02, 0, 0.03}));
  EXPECT_EQ(t.command_at(3), (Vec3{0, 0.05, 0.03}));
  EXPECT_EQ(t.command_at(5), (Vec3{0.02, 0.05, 0.03}));
  for (std::size_t node = 0; node < 6; ++node) EXPECT_EQ(t.node(node % 3, node / 3, 0), node);
}

TEST(VolumetricTable, HashCoversAllMembersButIdAndDate) {
  const std::vector<std::function<void(VolumetricTable&)>> changes = {
      [](auto& t) { t.name = "other"; },
      [](auto& t) { t.machine = parse_chain("w-X-b-Y-Z-t").value(); },
      [](auto& t) { t.machine.axes[0].against_command = true; },
      [](auto& t) { t.description += "\n"; },
      [](auto& t) {
        t.runs = {5, 3};
      },
      [](auto& t) { t.simulated = true; },
      [](auto& t) { t.noise_only = NoiseOnly::some; },
      [](auto& t) { t.noise_only = NoiseOnly::all; },
      [](auto& t) { t.approach = "forward"; },
      [](auto& t) { t.tool_m[1] = 1e-9; },
      [](auto& t) { t.rotary_rad[2] = 1; },
      [](auto& t) { t.command_m[0][1] += 1e-12; },
      [](auto& t) { t.correction_m[5][2] = -t.correction_m[5][2]; },
      [](auto& t) { t.u_m[0][0] *= 2; },
      [](auto& t) { t.u_independent_m.assign(6, Vec3{}); },
      [](auto& t) {
        t.u_independent_m.assign(6, Vec3{1e-9, 0, 0});
      },
      [](auto& t) { t.noise[0].resize(t.command_m[0].size()); },
      [](auto& t) {
        t.noise[0].resize(t.command_m[0].size());
        t.noise[0][1].covariance_with_next[2][5] = 1e-18;
      },
      [](auto& t) { t.interpolation_m[1] = 1e-9; },
      [](auto& t) { t.reversal_m[2] = 1e-9; },
      [](auto& t) { t.place_left_m = 1e-9; },
      [](auto& t) { t.turn_left_rad = 1e-9; },
      [](auto& t) { t.not_measured = {}; },
      [](auto& t) { std::swap(t.not_measured, t.u_not_declared); },
      [](auto& t) { t.beyond_tables = {"EXX"}; },
      [](auto& t) { t.doubtful = {notice(NoticeCode::run_partial)}; },
      [](auto& t) { t.doubtful = {notice(NoticeCode::probes_dead)}; },
      [](auto& t) { EXPECT_TRUE(set_u_between(t, std::vector<double>(9, 0.0))); },
      [](auto& t) {
        EXPECT_TRUE(set_u_between(t, {0, 0, 0, 0, 0, 1e-9, 0, 0, 0}));
      },
  };
  std::set<std::string> hashes{volumetric_sha256(small_table())};
  for (const auto& change : changes) {
    VolumetricTable t = small_table();
    change(t);
    hashes.insert(volumetric_sha256(t));
  }
  EXPECT_EQ(hashes.size(), changes.size() + 1);
  VolumetricTable stored = small_table();
  // The store adds these two; the hash does not cover them.
  stored.id = 7, stored.created_utc = "now";
  EXPECT_TRUE(hashes.contains(volumetric_sha256(stored)));
}

// SHA-256 of the bytes in volumetric_table.h, calculated by Python. Stored tables stay valid.
TEST(VolumetricTable, HashOfAnOlderTableIsUnchanged) {
  EXPECT_EQ(volumetric_sha256(small_table()),
            "924a5ef872493caba82f4e0954517356118355d1b94dc297aac6e9c0895dfaaa");
}

TEST(VolumetricTable, UBetweenNodesHasOneNumberForEachCellAndComponent) {
  VolumetricTable t = small_table();
  const std::vector<double> numbers{1, 2, 3, 4, 5, 6, 7, 8, 9};
  EXPECT_FALSE(set_u_between(t, {1, 2, 3}));
  EXPECT_NE(covers_text(t).find("an older version of mdof built this table"), std::string::npos);
  ASSERT_TRUE(set_u_between(t, numbers));
  EXPECT_EQ(t.u_between_m[0], (std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(t.u_between_m[1], (std::vector<Vec3>{{7, 8, 9}}));
  EXPECT_TRUE(t.u_between_m[2].empty());
  EXPECT_EQ(u_between_numbers(t), numbers);
  EXPECT_EQ(covers_text(t).find("older version"), std::string::npos);
  EXPECT_NE(covers_text(t).find("between their measured positions"), std::string::npos);
}

TEST(VolumetricTable, NodeHasCommandsCorrectionsAndU) {
  JsonWriter json;
  write_volumetric_node(json, small_table(), 4, false);
  EXPECT_EQ(json.take(), "[10,50,30,4,2,-3,0.01,0.08,0.03]");
}

TEST(VolumetricTable, UHasTwoPartsIfTheyAreKnown) {
  VolumetricTable t = small_table();
  JsonWriter unknown;
  write_volumetric_node(unknown, t, 4, true);
  EXPECT_EQ(unknown.take(), "[10,50,30,4,2,-3,0.01,0.08,0.03,null,null,null,null,null,null]");
  t.u_m[4] = {5e-8, 3e-8, 1e-8};
  t.u_independent_m.assign(6, Vec3{3e-8, 3e-8, 1.0000000001e-8});
  EXPECT_NEAR(t.u_common_at(4)[0], 4e-8, 1e-20);
  EXPECT_EQ(t.u_common_at(4)[1], 0);
  // The difference is negative because of rounding; the result must be 0, not NaN.
  EXPECT_EQ(t.u_common_at(4)[2], 0);
  EXPECT_EQ(t.u_independent_at(4)[0], 3e-8);
  EXPECT_NE(covers_text(t).find("u_common"), std::string::npos);
}

TEST(VolumetricTable, TextStatesWhatUDoesNotInclude) {
  VolumetricTable t = small_table();
  EXPECT_EQ(covers_text(t).find("noise"), std::string::npos);
  t.noise_only = NoiseOnly::some;
  EXPECT_NE(covers_text(t).find("at least one error contains only noise"), std::string::npos);
  t.noise_only = NoiseOnly::all;
  EXPECT_NE(covers_text(t).find("noise and repeatability only"), std::string::npos);
  EXPECT_EQ(covers_text(t).find("errors without a u are not included"), std::string::npos);
  t.u_not_declared = {"EYX"};
  EXPECT_NE(covers_text(t).find("errors without a u are not included"), std::string::npos);
}

}  // namespace
}  // namespace mdof
