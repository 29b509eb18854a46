// Volumetric tables. They are stored without changing a bit, they share the numbers of the axis
// tables, and only one is active.
#include "schema/sample.h"
#include "tests/daemon/store/fixtures.h"

namespace mdof::store {
namespace {

TEST_F(StoreTest, ReturnsAVolumetricTableBitForBit) {
  auto store = writer();
  for (int i = 0; i < 2; ++i) ASSERT_TRUE(store->add_run(make_run(1)));
  const VolumetricTable table = make_volume({2, 1});
  const auto id = store->add_volumetric(table);
  ASSERT_TRUE(id) << id.error().message;
  const auto back = store->volumetric(*id);
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->name, "mill");
  EXPECT_EQ(back->machine, table.machine);
  EXPECT_EQ(back->description, table.description);
  EXPECT_EQ(back->runs, table.runs);
  EXPECT_TRUE(back->simulated);
  EXPECT_EQ(back->noise_only, NoiseOnly::none);
  EXPECT_EQ(back->approach, "reverse");
  EXPECT_EQ(bits(back->tool_m), bits(table.tool_m));
  EXPECT_EQ(bits(back->rotary_rad), bits(table.rotary_rad));
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(bits(back->command_m[k]), bits(table.command_m[k]));
  ASSERT_EQ(back->nodes(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(bits(back->correction_m[i]), bits(table.correction_m[i]));
    EXPECT_EQ(std::isnan(back->u_m[i][1]), true);
    EXPECT_EQ(back->u_m[i][2], table.u_m[i][2]);
  }
  EXPECT_EQ(back->u_independent_m, table.u_independent_m);
  EXPECT_EQ(back->noise, table.noise);
  EXPECT_EQ(back->interpolation_m, table.interpolation_m);
  EXPECT_EQ(back->u_between_m, table.u_between_m);
  EXPECT_EQ(back->reversal_m, (Vec3{5e-9, 0, 6e-9}));
  EXPECT_EQ(back->place_left_m, 4e-9);
  EXPECT_EQ(back->turn_left_rad, 5e-6);
  EXPECT_EQ(back->not_measured, table.not_measured);
  EXPECT_EQ(back->u_not_declared, table.u_not_declared);
  EXPECT_EQ(back->beyond_tables, table.beyond_tables);
  EXPECT_EQ(back->doubtful, table.doubtful);
  EXPECT_EQ(volumetric_sha256(*back), table.sha256);
  VolumetricTable short_of_one = make_volume();
  short_of_one.u_m.pop_back();
  EXPECT_EQ(store->add_volumetric(short_of_one).error().code, ErrorCode::usage);
  VolumetricTable half = make_volume();
  half.u_independent_m.pop_back();
  EXPECT_EQ(store->add_volumetric(half).error().code, ErrorCode::usage);
  VolumetricTable other_axes = make_volume();
  other_axes.noise[0].pop_back();
  EXPECT_EQ(store->add_volumetric(other_axes).error().code, ErrorCode::usage);
  VolumetricTable no_cell = make_volume();
  no_cell.u_between_m[1].pop_back();
  EXPECT_EQ(store->add_volumetric(no_cell).error().code, ErrorCode::usage);
  VolumetricTable without_parts = make_volume();
  without_parts.u_between_m = {};
  without_parts.noise = {};
  without_parts.u_independent_m.clear();
  without_parts.doubtful.clear();
  without_parts.sha256 = volumetric_sha256(without_parts);
  const auto older = store->volumetric(store->add_volumetric(without_parts).value());
  ASSERT_TRUE(older) << older.error().message;
  EXPECT_TRUE(older->u_independent_m.empty());
  EXPECT_FALSE(older->has_u_between());
  EXPECT_EQ(store->add_volumetric(make_volume({9})).error().code, ErrorCode::not_found);
}

// These columns were added in a later version. Only the hash of the table covers them.
TEST_F(StoreTest, RejectsAVolumetricTableWithChangedColumns) {
  for (const char* change : {"noise = zeroblob(length(noise))", "reversal_m = NULL",
                             "u_independent_m = zeroblob(length(u_independent_m))",
                             "doubtful = NULL", "u_between_m = NULL"}) {
    const std::int64_t id = writer()->add_volumetric(make_volume()).value();
    ASSERT_TRUE(reader()->volumetric(id));
    EXPECT_TRUE(reader()->verify().value().empty());
    tamper("DROP TRIGGER volumetric_table_no_update; UPDATE volumetric_table SET " +
           std::string(change) + " WHERE id = " + std::to_string(id));
    auto again = writer();
    const auto back = again->volumetric(id);
    ASSERT_FALSE(back) << change;
    EXPECT_NE(back.error().message.find("volumetric table " + std::to_string(id)),
              std::string::npos);
    ASSERT_EQ(again->verify().value().size(), 1u) << change;
    TearDown();
    SetUp();
  }
}

TEST_F(StoreTest, VolumetricAndAxisTablesShareNumbersAndGenerations) {
  auto store = writer();
  ASSERT_TRUE(store->add_run(make_run(1)));
  EXPECT_EQ(store->add_table(make_table({1})).value(), 1);
  EXPECT_EQ(store->add_volumetric(make_volume({1})).value(), 2);
  EXPECT_EQ(store->add_table(make_table({1}, Axis::y)).value(), 3);
  EXPECT_EQ(store->add_volumetric(make_volume()).value(), 4);
  EXPECT_TRUE(store->is_volumetric(2).value());
  EXPECT_FALSE(store->is_volumetric(3).value());
  EXPECT_FALSE(store->is_volumetric(9).value());
  EXPECT_EQ(store->list_volumetric(0, 10).value().front().id, 4);
  EXPECT_EQ(store->list_volumetric(1, 10).value().front().id, 2);
  EXPECT_EQ(store->volumetric(1).error().code, ErrorCode::not_found);
  EXPECT_EQ(store->active_volumetric().error().code, ErrorCode::not_found);

  const auto axis = store->activate(1, "me", "utc").value();
  const auto first = store->change_volumetric(2, "me", "utc").value();
  EXPECT_TRUE(first.changed);
  EXPECT_GT(first.generation, axis.generation);
  EXPECT_FALSE(store->change_volumetric(2, "me", "utc").value().changed);
  EXPECT_EQ(store->active_volumetric()->table.id, 2);
  EXPECT_GT(store->activate(3, "me", "utc").value().generation, first.generation);
  EXPECT_TRUE(store->change_volumetric(4, "me", "utc").value().changed);
  EXPECT_EQ(store->active_volumetric()->table.id, 4);
  const auto off = store->change_volumetric(std::nullopt, "me", "utc").value();
  EXPECT_TRUE(off.changed);
  EXPECT_EQ(store->active_volumetric().error().code, ErrorCode::not_found);
  EXPECT_EQ(store->generation().value(), off.generation);
  EXPECT_FALSE(store->change_volumetric(std::nullopt, "me", "utc").value().changed);
  EXPECT_EQ(store->change_volumetric(3, "me", "utc").error().code, ErrorCode::not_found);
  EXPECT_TRUE(store->verify().value().empty());
}

TEST_F(StoreTest, AChangedVolumetricTableIsNotServed) {
  {
    auto store = writer();
    ASSERT_TRUE(store->add_run(make_run(1)));
    ASSERT_TRUE(store->add_volumetric(make_volume({1})));
    ASSERT_TRUE(store->change_volumetric(1, "me", "utc"));
  }
  for (const char* sql :
       {"UPDATE volumetric_table SET machine = 'x'", "DELETE FROM volumetric_table",
        "DELETE FROM volumetric_activation", "DELETE FROM volumetric_source",
        "UPDATE volumetric_activation SET actor = 'x'"}) {
    auto connection = sqlite::Connection::open(file_, sqlite::OpenMode::read_write);
    EXPECT_FALSE(connection->execute(sql)) << sql;
  }
  tamper("DROP TRIGGER volumetric_table_no_update");
  tamper("UPDATE volumetric_table SET correction_m = zeroblob(144)");
  auto store = reader();
  EXPECT_EQ(store->active_volumetric().error().code, ErrorCode::bad_input);
  EXPECT_TRUE(contains(store->active_volumetric().error().message, "volumetric table 1"));
  EXPECT_FALSE(store->verify().value().empty());
}

TEST_F(StoreTest, ADeletedVolumetricActivationIsDetected) {
  {
    auto store = writer();
    for (int i = 0; i < 2; ++i) ASSERT_TRUE(store->add_volumetric(make_volume()));
    ASSERT_TRUE(store->change_volumetric(1, "me", "utc"));
    ASSERT_TRUE(store->change_volumetric(2, "me", "utc"));
  }
  tamper("DROP TRIGGER volumetric_activation_no_delete");
  tamper("DELETE FROM volumetric_activation WHERE volumetric_table = 2");
  EXPECT_EQ(reader()->active_volumetric().error().code, ErrorCode::bad_input);
}

}  // namespace
}  // namespace mdof::store
