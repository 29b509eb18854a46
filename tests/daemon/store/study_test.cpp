// Sensitivity studies in the store: begin, interruption, continuation and end. No result is ever
// changed.
#include "tests/daemon/store/fixtures.h"

namespace mdof::store {
namespace {

StudyRecord make_study() {
  return {0,       "simulation-2", "preset = \"simulation-2\"\n", "",     "seed = 7\n", 7,
          1000000, "fingerprint",  "2026-11-21T06:00:00Z",        "0.1.0"};
}

StudyOutcome make_outcome(StudyState state, std::uint64_t trials) {
  return {state,   trials,
          1.5,     "2026-11-21T06:01:00Z",
          "0.1.0", "{\"trials\":" + std::to_string(trials) + "}"};
}

TEST_F(StoreTest, AStudyIsReadBackUnchanged) {
  auto store = writer();
  const std::int64_t id = store->begin_study(make_study()).value();
  StudyRecord adaptive = make_study();
  adaptive.trials_wanted.reset();
  adaptive.source = "plan.toml";
  const std::int64_t second = store->begin_study(adaptive).value();
  const StudyRecord back = store->study(id).value();
  EXPECT_EQ(back.name, "simulation-2");
  EXPECT_EQ(back.plan_toml, make_study().plan_toml);
  EXPECT_EQ(back.settings_toml, "seed = 7\n");
  EXPECT_EQ(back.seed, 7);
  EXPECT_EQ(back.trials_wanted, 1000000);
  EXPECT_EQ(back.fingerprint, "fingerprint");
  EXPECT_EQ(back.started_utc, "2026-11-21T06:00:00Z");
  EXPECT_FALSE(store->study_outcome(id)->has_value());
  EXPECT_FALSE(store->study_checkpoint(id)->has_value());
  const auto list = store->list_studies(0, 10).value();
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0].id, second);
  EXPECT_FALSE(list[0].trials_wanted);
  EXPECT_EQ(list[0].source, "plan.toml");
  EXPECT_EQ(store->count_studies().value(), 2);
  EXPECT_TRUE(store->verify()->empty());
}

TEST_F(StoreTest, ACheckpointIsReplacedAndDeletedAtCompletion) {
  std::int64_t id = 0;
  const std::string bytes("\0\1\2 checkpoint", 14);
  {
    auto store = writer();
    id = store->begin_study(make_study()).value();
    ASSERT_TRUE(store->save_checkpoint(id, {1000, "first"}));
    ASSERT_TRUE(store->save_checkpoint(id, {2000, "second"}));
    ASSERT_TRUE(store->end_study(id, make_outcome(StudyState::interrupted, 3000),
                                 StudyCheckpoint{3000, bytes}));
    EXPECT_TRUE(store->verify()->empty());
  }
  auto store = writer();  // another store object may continue the study
  const auto kept = store->study_checkpoint(id).value();
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->trials, 3000u);
  EXPECT_EQ(kept->bytes, bytes);
  EXPECT_EQ(store->study_outcome(id).value()->state, StudyState::interrupted);
  ASSERT_TRUE(store->end_study(id, make_outcome(StudyState::complete, 9000), std::nullopt));
  const auto last = store->study_outcome(id).value();
  EXPECT_EQ(last->state, StudyState::complete);
  EXPECT_EQ(last->trials, 9000u);
  EXPECT_EQ(last->elapsed_s, 1.5);
  EXPECT_EQ(last->figures_json, "{\"trials\":9000}");
  EXPECT_FALSE(store->study_checkpoint(id).value());
  auto db = sqlite::Connection::open(file_, sqlite::OpenMode::read_only);
  EXPECT_EQ(db->integer("SELECT count(*) FROM study_result").value(),
            2);  // no result was overwritten
}

TEST_F(StoreTest, NamesAMissingStudy) {
  auto store = writer();
  for (const Status& done : {store->save_checkpoint(5, {1, "x"}),
                             store->end_study(5, make_outcome(StudyState::complete, 1), {})}) {
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().code, ErrorCode::not_found);
    EXPECT_TRUE(contains(done.error().message, "no study 5")) << done.error().message;
  }
  EXPECT_EQ(store->study(5).error().code, ErrorCode::not_found);
}

TEST_F(StoreTest, StudiesAreAppendOnly) {
  {
    auto store = writer();
    const std::int64_t id = store->begin_study(make_study()).value();
    ASSERT_TRUE(store->end_study(id, make_outcome(StudyState::complete, 1), std::nullopt));
  }
  auto db = sqlite::Connection::open(file_, sqlite::OpenMode::read_write);
  for (const char* sql : {"UPDATE study SET seed = 8", "DELETE FROM study",
                          "UPDATE study_result SET trials = 8", "DELETE FROM study_result"}) {
    const Status done = db->execute(sql);
    ASSERT_FALSE(done) << sql;
    EXPECT_TRUE(contains(done.error().message, "append only")) << done.error().message;
  }
}

TEST_F(StoreTest, AChangedFigureOrCheckpointIsDetected) {
  {
    auto store = writer();
    const std::int64_t id = store->begin_study(make_study()).value();
    ASSERT_TRUE(store->end_study(id, make_outcome(StudyState::interrupted, 10),
                                 StudyCheckpoint{10, "bytes"}));
  }
  tamper(
      "DROP TRIGGER study_result_no_update; UPDATE study_result SET figures = '{}';"
      "UPDATE study_checkpoint SET bytes = x'00'");
  auto store = writer();
  const auto findings = store->verify().value();
  ASSERT_EQ(findings.size(), 2u);
  EXPECT_TRUE(contains(findings[0], "the figures of study 1")) << findings[0];
  EXPECT_TRUE(contains(findings[1], "checkpoint of study 1")) << findings[1];
  EXPECT_FALSE(store->study_checkpoint(1));
}

}  // namespace
}  // namespace mdof::store
