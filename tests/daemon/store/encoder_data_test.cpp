// Positions of an axis that a user set. The store keeps the user's name, and the hashes of the
// ledger cover both.
#include <gtest/gtest.h>

#include "daemon/store/file/migrate.h"
#include "daemon/store/ledger.h"
#include "daemon/store/store.h"
#include "tests/daemon/store/fixtures.h"

namespace mdof::store {
namespace {

DatumSetting setting(Axis axis, double position_m) {
  return {0, axis, "t7", 0.00003125, position_m, position_m - 0.00003125, "2026-11-23T07:00:00Z"};
}

HistoryEntry set_by_anna() {
  return {.name = "encoder.set", .by = {1000, 100, 4711, "anna"}, .utc = "2026-11-23T07:00:00Z"};
}

class EncoderData : public StoreTest {};

TEST_F(EncoderData, TheLastSettingOfAnAxisIsReadBackUnchanged) {
  auto store = writer();
  EXPECT_FALSE(store->last_datum(Axis::x)->has_value());
  ASSERT_EQ(store->add_datum(setting(Axis::x, 0.0125), set_by_anna()).value(), 1);
  ASSERT_EQ(store->add_datum(setting(Axis::y, -0.2), set_by_anna()).value(), 2);
  ASSERT_EQ(store->add_datum(setting(Axis::x, 0.037), set_by_anna()).value(), 3);
  ASSERT_EQ(store->add_datum(setting(Axis::z, 0.1), set_by_anna()).value(), 4);
  DatumSetting expected = setting(Axis::x, 0.037);
  expected.id = 3;
  EXPECT_EQ(store->last_datum(Axis::x).value(), expected);
  EXPECT_EQ(reader()->last_datum(Axis::y).value()->position_m, -0.2);
  EXPECT_TRUE(store->verify()->empty());
}

TEST_F(EncoderData, ItsActionStatesThePositionOfTheAxis) {
  auto store = writer();
  ASSERT_TRUE(store->add_datum(setting(Axis::y, 0.0125), set_by_anna()));
  const auto actions = store->list_actions(0, 9).value();
  ASSERT_EQ(actions.size(), 1u);
  EXPECT_EQ(actions[0].name, "encoder.set");
  EXPECT_EQ(actions[0].subject, "encoder_datum");
  EXPECT_EQ(actions[0].row, 1);
  EXPECT_EQ(actions[0].by.user, "anna");
  EXPECT_EQ(actions[0].detail, "Y set to 12.5 mm; the position before was 0.03125 mm");
  EXPECT_TRUE(store->add_run(make_run(3), set_by_anna()));
  EXPECT_EQ(store->list_actions(0, 1).value()[0].detail, "");
}

TEST_F(EncoderData, AnyChangeIsDetected) {
  for (const char* change :
       {"UPDATE encoder_datum SET position_m = 0 WHERE id = 1", "DELETE FROM encoder_datum",
        "UPDATE encoder_datum SET offset_m = -offset_m", "UPDATE encoder_datum SET before_m = 1",
        "UPDATE encoder_datum SET axis = 'Y'", "UPDATE encoder_datum SET device = 't8'",
        "UPDATE encoder_datum SET utc = '2026-11-23T08:00:00Z'",
        "INSERT INTO encoder_datum VALUES (9, 'X', 't7', 0, 0, 0, 'now')"}) {
    std::filesystem::remove(file_);
    { ASSERT_TRUE(writer()->add_datum(setting(Axis::x, 0.0125), set_by_anna())); }
    ASSERT_TRUE(reader()->verify()->empty());
    tamper(std::string("DROP TRIGGER encoder_datum_no_update; DROP TRIGGER "
                       "encoder_datum_no_delete; ") +
           change);
    EXPECT_FALSE(reader()->verify()->empty()) << change;
  }
  const auto reported = reader()->last_datum(Axis::x);
  ASSERT_FALSE(reported);
  EXPECT_TRUE(contains(reported.error().message, "encoder datum 9: was not stored by mdof"));
}

TEST_F(EncoderData, IsAppendOnly) {
  { ASSERT_TRUE(writer()->add_datum(setting(Axis::x, 0.0125), set_by_anna())); }
  auto db = sqlite::Connection::open(file_, sqlite::OpenMode::read_write);
  for (const char* sql : {"UPDATE encoder_datum SET offset_m = 0", "DELETE FROM encoder_datum",
                          "UPDATE deed SET uid = 0", "DELETE FROM deed"})
    EXPECT_TRUE(contains(db->execute(sql).error().message, "append only")) << sql;
}

// A database of schema version 9, which had no actions of encoders.
TEST_F(EncoderData, ActionsOfOlderVersionsKeepTheirHashes) {
  constexpr std::size_t kBefore = 9;
  {
    auto db = sqlite::Connection::open(file_, sqlite::OpenMode::create);
    ASSERT_TRUE(migrate(*db, sql::migrations().first(kBefore)));
    ASSERT_TRUE(db->execute(
        "INSERT INTO deed VALUES (1, 'run.start', 'run', 1, 1000, 100, 4711, 'anna', 'then'), "
        "(2, 'run.stop', 'run', 1, 1001, 101, 4712, 'bert', 'now')"));
    for (const std::int64_t row : {1, 2}) ASSERT_TRUE(add_link(*db, Fact::action, row));
  }
  auto store = writer();
  ASSERT_TRUE(store) << store.error().message;
  EXPECT_TRUE(store->verify()->empty());
  ASSERT_TRUE(store->add_datum(setting(Axis::x, 0.0125), set_by_anna()));
  const auto actions = store->list_actions(0, 9).value();
  ASSERT_EQ(actions.size(), 3u);
  EXPECT_EQ(actions[1].by.user, "bert");
  EXPECT_EQ(actions[2].by.pid, 4711);
  EXPECT_TRUE(store->verify()->empty());
}

}  // namespace
}  // namespace mdof::store
