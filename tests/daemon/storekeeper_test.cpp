#include "daemon/storekeeper.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <future>

namespace mdof::daemon {
namespace {

MeasuredPoint point(int target, int direction) {
  MeasuredPoint p;
  p.target = target;
  p.run = 1;
  p.target_m = p.point.position_m = 1e-3 * target;
  p.point.direction = direction;
  p.point.probe_m = p.point.probe_u_m = {1e-6, 2e-6, 3e-6, 4e-6, 5e-6};
  p.point.samples = 100;
  p.errors.valid = true;
  return p;
}

class StorekeeperTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("mdof_keeper_" + std::to_string(getpid()));
    auto started = Storekeeper::start({folder_ / "mdof.db"}, {[](std::int64_t, std::int64_t) {},
                                                              [](std::int64_t, const Error&) {}});
    ASSERT_TRUE(started) << started.error().message;
    keeper_ = std::move(*started);
  }
  void TearDown() override {
    keeper_.reset();
    std::filesystem::remove_all(folder_);
  }

  std::int64_t begin() {
    std::promise<std::int64_t> id;
    NewRun run;
    run.header.started_utc = "2026-11-21T00:00:00.000Z";
    run.header.provenance.recording_kind = "replay";
    run.header.provenance.model = "rigid";
    run.header.note = "of a test";
    EXPECT_TRUE(keeper_->begin_run(std::move(run),
                                   [&](const auto& begun) { id.set_value(begun.value()); }));
    return id.get_future().get();
  }
  std::int64_t end(std::int64_t run, const std::vector<MeasuredPoint>& points, bool differs) {
    std::promise<std::int64_t> id;
    mdof::Run result;
    result.header.state = RunState::complete;
    result.header.scans = 7;
    result.points = points;
    keeper_->end_run(run, result, differs, [&](const auto& ended) { id.set_value(ended.value()); });
    return id.get_future().get();
  }
  mdof::Run stored(std::int64_t id) {
    auto store = store::Store::open(folder_ / "mdof.db", store::Access::read_only);
    return store.value().run(id).value();
  }

  std::filesystem::path folder_;
  std::unique_ptr<Storekeeper> keeper_;
};

TEST_F(StorekeeperTest, ARunThatTurnsOutAsStoredKeepsItsId) {
  const std::int64_t id = begin();
  keeper_->append_points(id, {point(1, 1), point(2, 1)},
                         [](const Status& kept) { EXPECT_TRUE(kept); });
  EXPECT_EQ(end(id, {point(1, 1), point(2, 1)}, false), id);
  const mdof::Run run = stored(id);
  EXPECT_EQ(run.header.state, RunState::complete);
  EXPECT_EQ(run.points.size(), 2u);
  EXPECT_EQ(run.header.scans, 7u);
}

TEST_F(StorekeeperTest, ARunThatTurnsOutOtherwiseIsSupersededByACompleteOne) {
  const std::int64_t id = begin();
  keeper_->append_points(id, {point(1, 1), point(1, 1)},
                         [](const Status& kept) { EXPECT_TRUE(kept); });
  const std::int64_t other = end(id, {point(1, 1), point(2, 1)}, true);
  ASSERT_NE(other, id);
  EXPECT_EQ(stored(id).header.state, RunState::failed);  // nobody is to build on it
  const mdof::Run run = stored(other);
  EXPECT_EQ(run.header.state, RunState::complete);
  EXPECT_EQ(run.header.supersedes, id);
  EXPECT_EQ(run.header.note, "of a test");
  EXPECT_EQ(run.points[1].target, 2);
}

}  // namespace
}  // namespace mdof::daemon
