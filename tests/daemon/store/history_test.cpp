// The user who made a change. The store keeps the user together with the change, and the hashes of
// the ledger cover both.
#include "daemon/store/store.h"
#include "tests/daemon/store/fixtures.h"

namespace mdof::store {
namespace {

HistoryEntry by_anna(const std::string& name) {
  return {.name = name, .by = {1000, 100, 4711, "anna"}, .utc = "2026-11-22T18:00:00.000Z"};
}

class RecordedActions : public StoreTest {
 protected:
  // The user anna starts and stops a run. At the end its points are renumbered, so a second run
  // has the result. Returns the second run.
  static std::int64_t measured(Store& store) {
    mdof::Run run = make_run(3);
    const auto id = store.begin_run(run.header, by_anna("run.start")).value();
    RunEnd end;
    end.state = RunState::failed;
    end.action = by_anna("run.stop");
    return store.end_and_supersede(id, end, run).value();
  }

  std::string names(const std::vector<HistoryEntry>& actions) {
    std::string all;
    for (const HistoryEntry& action : actions)
      all += action.name + " " + action.subject + " " + std::to_string(action.row) + "; ";
    return all;
  }
};

// The second run supersedes the first run and has the result. A run that was interrupted and
// resumed is still listed.
TEST_F(RecordedActions, ARenumberedRunIsNotListedAsAResult) {
  using Listed = store::Store::Listed;
  auto store = writer();
  const auto result = measured(*store);
  const auto listed = store->list_runs(0, 9, Axis::x, Listed::results).value();
  ASSERT_EQ(listed.size(), 1u);
  EXPECT_EQ(listed[0].id, result);
  EXPECT_EQ(store->count_runs({}, Listed::results).value(), 1);
  EXPECT_EQ(store->list_runs(0, 9).value().size(), 2u);
  mdof::Run resumed = make_run(3);
  resumed.header.state = RunState::failed;
  const auto cut_off = store->add_run(resumed).value();
  resumed.header.supersedes = cut_off;
  resumed.header.started_utc = "2026-11-22T19:00:00.000Z";
  ASSERT_TRUE(store->add_run(resumed));
  EXPECT_EQ(store->count_runs(Axis::x, Listed::results).value(), 3);
}

TEST_F(RecordedActions, EachChangeHasItsAction) {
  auto store = writer();
  const auto run = measured(*store);
  const auto actions = store->run_actions(run).value();
  EXPECT_EQ(names(actions),
            "run.start run 1; run.stop run 1; ");  // actions of the superseded run
  EXPECT_EQ(actions[1].by.uid, 1000);
  EXPECT_EQ(actions[1].by.gid, 100);
  EXPECT_EQ(actions[1].by.pid, 4711);
  EXPECT_EQ(actions[1].by.user, "anna");
  EXPECT_EQ(actions[1].utc, "2026-11-22T18:00:00.000Z");
  const auto table = store->add_table(make_table({run}), by_anna("compensation.build")).value();
  const auto on = store->activate(table, "anna", "x", by_anna("compensation.activate")).value();
  const auto off = store->deactivate(Axis::x, "anna", "x", by_anna("compensation.deactivate"));
  EXPECT_EQ(names(store->list_actions(0, 3).value()),
            "compensation.deactivate deactivation " + std::to_string(off->generation) +
                "; compensation.activate activation " + std::to_string(on.generation) +
                "; compensation.build compensation_table 1; ");
  const auto changes = store->list_actions(0, 2).value();
  EXPECT_EQ(changes[0].detail, "table 1 of X");
  EXPECT_EQ(changes[1].detail, "table 1 of X");
  EXPECT_EQ(store->count_actions().value(), 5);
  EXPECT_TRUE(store->verify()->empty());
}

TEST_F(RecordedActions, AReasonIsReadBackAndAChangeIsDetected) {
  {
    auto store = writer();
    const auto table =
        store->add_table(make_table({measured(*store)}), by_anna("compensation.build")).value();
    HistoryEntry action = by_anna("compensation.activate");
    action.detail = "after \"scraping\"";
    ASSERT_TRUE(store->activate(table, "anna", "x", action));
    const auto actions = store->list_actions(0, 2).value();
    EXPECT_EQ(actions[0].detail, "table 1 of X: after \"scraping\"");
    EXPECT_EQ(actions[1].detail, "");
    EXPECT_TRUE(store->verify()->empty());
  }
  tamper("DROP TRIGGER deed_reason_no_update; UPDATE deed_reason SET text = 'no reason'");
  EXPECT_FALSE(reader()->verify()->empty());
  const auto reported = reader()->list_actions(0, 1);
  ASSERT_FALSE(reported);
  EXPECT_TRUE(contains(reported.error().message, "reason of action")) << reported.error().message;
}

TEST_F(RecordedActions, AFailedChangeStoresNoAction) {
  auto store = writer();
  EXPECT_FALSE(store->add_table(make_table({99}), by_anna("compensation.build")));
  EXPECT_EQ(store->count_actions().value(), 0);
}

TEST_F(RecordedActions, AChangedActionIsDetected) {
  for (const char* change :
       {"UPDATE deed SET uid = 0 WHERE id = 1", "DELETE FROM deed WHERE id = 1",
        "UPDATE deed SET row = 2 WHERE id = 2", "UPDATE deed SET user = 'bert' WHERE id = 1"}) {
    std::filesystem::remove(file_);
    {
      auto store = writer();
      measured(*store);
    }
    tamper(std::string("DROP TRIGGER deed_no_update; DROP TRIGGER deed_no_delete; ") + change);
    EXPECT_FALSE(reader()->verify()->empty()) << change;
  }
  const auto reported = reader()->list_actions(0, 10);
  ASSERT_FALSE(reported);
  EXPECT_TRUE(contains(reported.error().message, "action 1: was changed after it was stored"))
      << reported.error().message;
}

}  // namespace
}  // namespace mdof::store
