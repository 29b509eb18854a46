// Squareness results, compensation tables, and the activation of tables.
#include "schema/sample.h"
#include "tests/daemon/store/fixtures.h"

namespace mdof::store {
namespace {

TEST_F(StoreTest, KeepsSquareness) {
  auto store = writer();
  ASSERT_TRUE(store->add_run(make_run(1)));
  ASSERT_TRUE(store->add_run(make_run(1, Axis::y)));
  ASSERT_TRUE(store->add_run(make_run(1, Axis::z)));
  Squareness s{0,    {},   1, 2, 1e-5, 2e-7, 9e-6, 3e-6, 4e-8, -5e-6, 6e-8, {7e-7, 8e-8, -1},
               true, "utc"};
  EXPECT_EQ(store->add_squareness(s).value(), 1);
  const auto list = store->list_squareness(0, 10).value();
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0].run_b, 2);
  EXPECT_EQ(list[0].error_rad, 1e-5);
  EXPECT_EQ(list[0].u_slope_b_rad, 6e-8);
  EXPECT_EQ(list[0].artefact.angle_error_rad, 7e-7);
  EXPECT_EQ(list[0].artefact.u_rad, 8e-8);
  EXPECT_EQ(list[0].artefact.corner, -1);
  EXPECT_EQ(list[0].form_rad, 9e-6);
  EXPECT_TRUE(list[0].simulated);
  EXPECT_EQ(list[0].axes, AxisPair{});
  s.run_b = 3;  // the axes are taken from the two runs
  ASSERT_TRUE(store->add_squareness(s));
  EXPECT_EQ(store->squareness_of(1, 3).value().front().axes, (AxisPair{Axis::x, Axis::z}));
  s.artefact.u_rad = 0;  // a declared u of 0 differs from no declaration
  ASSERT_TRUE(store->add_squareness(s));
  EXPECT_EQ(store->list_squareness(0, 1).value().front().artefact.u_rad, 0);
  s.artefact.u_rad = std::nullopt;
  ASSERT_TRUE(store->add_squareness(s));
  EXPECT_EQ(store->list_squareness(0, 1).value().front().artefact.u_rad, std::nullopt);
  EXPECT_EQ(
      store->add_squareness({0, {}, 1, 9, 0, 0, 0, 0, 0, 0, 0, {}, false, "utc"}).error().code,
      ErrorCode::not_found);
}

TEST_F(StoreTest, ReturnsACompensationTableBitForBit) {
  auto store = writer();
  for (int i = 0; i < 2; ++i) ASSERT_TRUE(store->add_run(make_run(1)));
  CompensationTable table = make_table({2, 1});
  table.reverse[4][1] = kNaN;
  table.sides = {true, true};
  table.stated = {Reference::tool, {1e-3, -2e-3, 0.1}};
  table.machine = chain_from("w-Y-b-X-Z-t", "Y+ X- Z-").value();
  const CompensationTable back = store->table(store->add_table(table).value()).value();
  EXPECT_EQ(back.id, 1);
  EXPECT_EQ(back.runs, table.runs);
  EXPECT_EQ(back.sides, table.sides);
  EXPECT_EQ(back.stated, table.stated);
  EXPECT_EQ(back.machine, table.machine);
  EXPECT_FALSE(back.lacks_reference_point);
  EXPECT_EQ(bits(back.position_m), bits(table.position_m));
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_EQ(bits(back.forward[k]), bits(table.forward[k]));
    EXPECT_EQ(bits(back.reverse[k]), bits(table.reverse[k]));
    EXPECT_EQ(bits(back.u_forward[k]), bits(table.u_forward[k]));
    EXPECT_EQ(bits(back.u_reverse[k]), bits(table.u_reverse[k]));
  }
  EXPECT_FALSE(back.has_declared());
  for (std::size_t k = 0; k < 5; ++k) table.u_declared[k] = table.u_reverse[(k + 1) % 5];
  const CompensationTable declared = store->table(store->add_table(table).value()).value();
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_EQ(bits(declared.u_declared[k]), bits(table.u_declared[k]));
    EXPECT_EQ(bits(declared.u_reverse[k]), bits(table.u_reverse[k]));
  }
  table.positioning = {
      table.forward[1], table.reverse[2], table.u_forward[3], {kNaN, -0.0, 1e-9}, {}};
  for (const bool with_declared : {true, false}) {
    table.positioning.u_declared = with_declared ? table.forward[4] : std::vector<double>();
    if (!with_declared) table.u_declared = {};
    const CompensationTable along = store->table(store->add_table(table).value()).value();
    EXPECT_EQ(along.has_declared(), with_declared);
    EXPECT_EQ(bits(along.u_reverse[4]), bits(table.u_reverse[4]));
    EXPECT_EQ(bits(along.positioning.forward), bits(table.positioning.forward));
    EXPECT_EQ(bits(along.positioning.reverse), bits(table.positioning.reverse));
    EXPECT_EQ(bits(along.positioning.u_forward), bits(table.positioning.u_forward));
    EXPECT_EQ(bits(along.positioning.u_reverse), bits(table.positioning.u_reverse));
    EXPECT_EQ(bits(along.positioning.u_declared), bits(table.positioning.u_declared));
  }
  table.forward[2].pop_back();
  EXPECT_EQ(store->add_table(table).error().code, ErrorCode::usage);
}

TEST_F(StoreTest, ARepeatedActivationOrDeactivationChangesNothing) {
  auto store = writer();
  ASSERT_TRUE(store->add_run(make_run(1)));
  for (const Axis axis : {Axis::x, Axis::x, Axis::y})
    ASSERT_TRUE(store->add_table(make_table({1}, axis)));
  EXPECT_FALSE(store->deactivate(Axis::x, "anna", "t0")->changed);
  const auto first = store->activate(1, "anna", "t1");
  ASSERT_TRUE(first->changed);
  ASSERT_TRUE(store->activate(3, "anna", "t2")->changed);
  const auto again = store->activate(1, "ben", "t3");
  EXPECT_FALSE(again->changed);
  EXPECT_EQ(again->generation, first->generation);
  EXPECT_EQ(store->active(Axis::x)->actor, "anna");
  const auto out = store->deactivate(Axis::x, "ben", "t4");
  EXPECT_GT(out->generation, first->generation + 1);
  EXPECT_EQ(store->active(Axis::x).error().code, ErrorCode::not_found);
  EXPECT_EQ(store->active(Axis::y)->table.id, 3);
  EXPECT_EQ(store->generation().value(), out->generation);
  EXPECT_FALSE(store->deactivate(Axis::x, "ben", "t5")->changed);
  const auto back = store->activate(1, "ben", "t6");  // activates the table again
  EXPECT_GT(back->generation, out->generation);
  EXPECT_EQ(store->active(Axis::x)->generation, back->generation);
}

// A user decides from the state that a client shows. If any table has changed since then, the
// store rejects the change.
TEST_F(StoreTest, RejectsAChangeThatExpectsAnotherGeneration) {
  auto store = writer();
  ASSERT_TRUE(store->add_run(make_run(1)));
  for (const Axis axis : {Axis::x, Axis::x, Axis::y})
    ASSERT_TRUE(store->add_table(make_table({1}, axis)));
  ASSERT_TRUE(store->add_volumetric(make_volume({1})));
  const auto first = store->activate(1, "anna", "t1", {}, 0);
  ASSERT_TRUE(first->changed);
  const auto other = store->activate(3, "ben", "t2", {}, first->generation);
  ASSERT_TRUE(other->changed);
  const auto head = store->chain_head().value();
  for (const std::int64_t old : {std::int64_t{0}, first->generation, other->generation + 1})
    for (const auto& refused :
         {store->activate(2, "anna", "t3", {}, old), store->activate(1, "anna", "t3", {}, old),
          store->deactivate(Axis::x, "anna", "t3", {}, old),
          store->deactivate(Axis::z, "anna", "t3", {}, old),
          store->change_volumetric(4, "anna", "t3", {}, old),
          store->change_volumetric(std::nullopt, "anna", "t3", {}, old)}) {
      ASSERT_FALSE(refused) << old;
      EXPECT_EQ(refused.error().code, ErrorCode::changed);
      for (const std::string& named : {std::to_string(other->generation), std::string("table 1"),
                                       std::string("table 3"), std::string("axis Y")})
        EXPECT_NE(refused.error().message.find(named), std::string::npos)
            << refused.error().message;
    }
  EXPECT_EQ(store->generation().value(), other->generation);
  EXPECT_EQ(store->chain_head().value(), head);
  EXPECT_EQ(store->active(Axis::x)->table.id, 1);
  const auto volume = store->change_volumetric(4, "anna", "t4", {}, other->generation);
  ASSERT_TRUE(volume->changed);
  EXPECT_TRUE(store->deactivate(Axis::x, "anna", "t5", {}, volume->generation)->changed);
}

// Clients cache tables by generation. Therefore no generation is used twice, even if the database
// is replaced by a new one.
TEST_F(StoreTest, GenerationsContinueInANewDatabase) {
  std::int64_t last = 0;
  for (int database = 0; database < 2; ++database) {
    auto store = writer();
    ASSERT_TRUE(store->add_run(make_run(1)));
    ASSERT_TRUE(store->add_table(make_table({1})));
    const std::string utc = "2026-11-22T15:30:0" + std::to_string(database) + ".5Z";
    const auto first = store->activate(1, "anna", utc);
    // The generation is the time `utc` in seconds since 1970, here from `date -u -d ... +%s`.
    EXPECT_EQ(first->generation, 1'795'361'400 + database);
    EXPECT_GT(first->generation, last);
    last = first->generation;
    fs::remove(file_);
  }
}

TEST_F(StoreTest, GenerationsIncreaseOverAllAxes) {
  auto store = writer();
  ASSERT_TRUE(store->add_run(make_run(1)));
  for (const Axis axis : {Axis::x, Axis::x, Axis::y})
    ASSERT_TRUE(store->add_table(make_table({1}, axis)));
  EXPECT_EQ(store->generation().value(), 0);
  const std::int64_t first = store->activate(2, "anna", "t1")->generation;
  EXPECT_GT(first, 0);
  const std::int64_t second = store->activate(3, "anna", "t2")->generation;
  EXPECT_GT(second, first);
  const std::int64_t third = store->activate(1, "ben", "t3")->generation;
  EXPECT_GT(third, second);
  const ActiveTable x = store->active(Axis::x).value();
  EXPECT_EQ(x.table.id, 1);
  EXPECT_EQ(x.generation, third);
  EXPECT_EQ(x.actor, "ben");
  EXPECT_EQ(x.activated_utc, "t3");
  EXPECT_EQ(store->active(Axis::y)->generation, second);
  EXPECT_EQ(store->generation().value(), third);
  EXPECT_EQ(store->list_tables(0, 9).value().size(), 3u);
  EXPECT_EQ(store->list_tables(0, 9, Axis::y).value().at(0).id, 3);
}

}  // namespace
}  // namespace mdof::store
