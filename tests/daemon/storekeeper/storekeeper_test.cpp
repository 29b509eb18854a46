#include "daemon/storekeeper/storekeeper.h"
#include "tests/shown.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <future>
#include <thread>

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
    auto started = Storekeeper::start({folder_ / "mdof.db"},
                                      {[](std::int64_t, std::int64_t) {},
                                       [this](std::int64_t run, const Error&) { failed_ = run; }});
    ASSERT_TRUE(started) << started.error().message;
    keeper_ = std::move(*started);
  }
  void TearDown() override {
    keeper_.reset();
    std::filesystem::remove_all(folder_);
  }

  std::int64_t begin(const std::filesystem::path& recording = {}) {
    std::promise<std::int64_t> id;
    NewRun run;
    run.recording = recording;
    run.header.started_utc = "2026-11-21T00:00:00.000Z";
    run.header.provenance.recording_kind = "replay";
    run.header.provenance.model = "rigid";
    run.header.note = "of a test";
    EXPECT_TRUE(keeper_->begin_run(std::move(run),
                                   [&](const auto& begun) { id.set_value(begun.value()); }));
    return id.get_future().get();
  }
  std::int64_t end(std::int64_t run, const std::vector<MeasuredPoint>& points, bool differs) {
    return try_to_end(run, points, differs).value();
  }
  Result<std::int64_t> try_to_end(std::int64_t run, const std::vector<MeasuredPoint>& points,
                                  bool differs) {
    std::promise<Result<std::int64_t>> id;
    mdof::Run result;
    result.header.state = RunState::complete;
    result.header.scans = 7;
    result.points = points;
    keeper_->end_run(run, result, {differs}, [&](const auto& ended) { id.set_value(ended); });
    return id.get_future().get();
  }
  Status append(std::int64_t run, const std::vector<MeasuredPoint>& points) {
    std::promise<Status> kept;
    keeper_->append_points(run, points, [&](const Status& status) { kept.set_value(status); });
    return kept.get_future().get();
  }
  // Executes SQL on the database without the store, so that the database rejects certain changes
  // later.
  static void spoil(const std::filesystem::path& file, const std::string& sql) {
    auto db = sqlite::Connection::open(file, sqlite::OpenMode::read_write);
    ASSERT_TRUE(db && db->execute(sql));
  }
  static SampleBlock scans(std::int64_t first_ns) {
    SampleBlock block{"d", {{"A", Unit::um}}, {}, {{}}, {}, 0};
    for (int i = 0; i < 10; ++i) {
      block.time_ns.push_back(first_ns + i);
      block.value[0].push_back(i);
    }
    return block;
  }
  mdof::Run stored(std::int64_t id) {
    auto store = store::Store::open(folder_ / "mdof.db", store::Access::read_only);
    return store.value().run(id).value();
  }

  std::filesystem::path folder_;
  std::unique_ptr<Storekeeper> keeper_;
  std::atomic<std::int64_t> failed_{0};
};

TEST_F(StorekeeperTest, ARunWithUnchangedPointsKeepsItsId) {
  const std::int64_t id = begin();
  keeper_->append_points(id, {point(1, 1), point(2, 1)},
                         [](const Status& kept) { EXPECT_TRUE(kept); });
  EXPECT_EQ(end(id, {point(1, 1), point(2, 1)}, false), id);
  const mdof::Run run = stored(id);
  EXPECT_EQ(run.header.state, RunState::complete);
  EXPECT_EQ(run.points.size(), 2u);
  EXPECT_EQ(run.header.scans, 7u);
}

TEST_F(StorekeeperTest, ARenumberedRunIsSupersededByACompleteOne) {
  const std::int64_t id = begin();
  keeper_->append_points(id, {point(1, 1), point(1, 1)},
                         [](const Status& kept) { EXPECT_TRUE(kept); });
  const std::int64_t other = end(id, {point(1, 1), point(2, 1)}, true);
  ASSERT_NE(other, id);
  EXPECT_EQ(stored(id).header.state, RunState::failed);  // nobody may use a run in this state
  const mdof::Run run = stored(other);
  EXPECT_EQ(run.header.state, RunState::complete);
  EXPECT_EQ(run.header.supersedes, id);
  EXPECT_EQ(run.header.note, "of a test");
  EXPECT_EQ(run.points[1].target, 2);
}

// One transaction stores the end of a run and the start of the run that supersedes it. After a
// power cut, both or none of them are stored.
TEST_F(StorekeeperTest, TheSuccessorIsStoredInOneTransactionWithTheEnd) {
  const std::int64_t id = begin();
  ASSERT_TRUE(append(id, {point(1, 1), point(1, 1)}));
  spoil(folder_ / "mdof.db",
        "CREATE TRIGGER full BEFORE INSERT ON run BEGIN SELECT raise(ABORT, 'full'); END");
  const auto ended = try_to_end(id, {point(1, 1), point(2, 1)}, true);
  ASSERT_FALSE(ended);
  keeper_.reset();  // this writes all pending data
  const mdof::Run run = stored(id);
  EXPECT_EQ(run.header.state, RunState::failed);
  EXPECT_EQ(test::shown(run.header.notices), "renumbering_refused\n");
}

// If the samples of a point are not stored, the point must not be stored either.
TEST_F(StorekeeperTest, APointWithoutStoredSamplesIsNotAcknowledged) {
  const auto recording = folder_ / "run.mdofrec";
  const std::int64_t id = begin(recording);
  ASSERT_TRUE(keeper_->record(id, {scans(1)}, true));
  ASSERT_TRUE(append(id, {point(1, 1)}));
  spoil(recording,
        "CREATE TRIGGER full BEFORE INSERT ON chunk BEGIN SELECT raise(ABORT, 'full'); "
        "END");
  ASSERT_TRUE(keeper_->record(id, {scans(100)}, true));
  EXPECT_FALSE(append(id, {point(2, 1)}));
  EXPECT_EQ(failed_, id);
  EXPECT_EQ(stored(id).points.size(), 1u);
}

TEST_F(StorekeeperTest, DetectsADeletedOrReplacedDatabase) {
  const auto database = folder_ / "mdof.db", aside = folder_ / "aside.db";
  const auto fault_after = [&](bool expected) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(1);
    while (keeper_->fault().empty() == expected && std::chrono::steady_clock::now() < end)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return keeper_->fault();
  };
  EXPECT_EQ(fault_after(false), "");
  std::filesystem::rename(database, aside);
  EXPECT_NE(fault_after(true).find("mdof.db was deleted"), std::string::npos);
  std::filesystem::copy_file(aside, database);
  std::promise<Result<std::int64_t>> begun;
  keeper_->begin_run(NewRun{}, [&](const auto& id) { begun.set_value(id); });
  EXPECT_FALSE(begun.get_future().get());
  std::filesystem::rename(aside, database);  // the original file is restored
  EXPECT_EQ(fault_after(false), "");
  std::filesystem::resize_file(database, 100);
  EXPECT_NE(fault_after(true).find("was truncated"), std::string::npos);
}

// Another program that holds a transaction open and thereby locks the database.
class ForeignLock {
 public:
  explicit ForeignLock(const std::filesystem::path& file)
      : connection_(sqlite::Connection::open(file, sqlite::OpenMode::read_write).value()) {
    EXPECT_TRUE(connection_.execute("BEGIN IMMEDIATE"));
  }
  void end() { EXPECT_TRUE(connection_.execute("COMMIT")); }

 private:
  sqlite::Connection connection_;
};

class HeldDatabase : public StorekeeperTest {
 protected:
  void SetUp() override {
    StorekeeperTest::SetUp();
    restart(std::chrono::milliseconds(20));
  }
  void restart(std::chrono::milliseconds busy_timeout) {
    keeper_.reset();
    Storekeeper::Options options{folder_ / "mdof.db"};
    options.busy_timeout = busy_timeout;
    options.max_pending_points = 3;
    keeper_ =
        Storekeeper::start(options, {[](std::int64_t, std::int64_t) {},
                                     [this](std::int64_t run, const Error&) { failed_ = run; }})
            .value();
  }
};

TEST_F(HeldDatabase, IsWaitedForAndReceivesAllPointsAndTheEnd) {
  const std::int64_t id = begin(folder_ / "run.mdofrec");
  ForeignLock foreign(folder_ / "mdof.db");
  std::promise<Status> kept;
  std::promise<Result<std::int64_t>> ended;
  ASSERT_TRUE(keeper_->record(id, {scans(1)}, true));
  keeper_->append_points(id, {point(1, 1)}, [&](const Status& status) { kept.set_value(status); });
  mdof::Run result;
  result.header.state = RunState::complete;
  result.points = {point(1, 1)};
  keeper_->end_run(id, result, {}, [&](const auto& read) { ended.set_value(read); });
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  EXPECT_EQ(failed_, 0);
  EXPECT_EQ(keeper_->storage().state, "held");
  EXPECT_NE(keeper_->storage().reason.find("End that program"), std::string::npos);
  EXPECT_NE(keeper_->still_open_reason(id).find("not stored yet"), std::string::npos);
  foreign.end();
  EXPECT_TRUE(kept.get_future().get());
  EXPECT_EQ(ended.get_future().get().value(), id);
  const mdof::Run run = stored(id);
  EXPECT_EQ(run.header.state, RunState::complete);
  EXPECT_EQ(run.points.size(), 1u);
  EXPECT_TRUE(run.header.notices.empty());
  EXPECT_EQ(keeper_->still_open_reason(id), "");
  for (int i = 0; i < 100 && keeper_->storage().state != "ok"; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_EQ(keeper_->storage().state, "ok");
}

// Points that cannot be stored yet use a bounded amount of memory. They are acknowledged in their
// order, and the end of the run stores all of them.
TEST_F(HeldDatabase, PointsBeyondTheBoundAreStoredAtTheEnd) {
  const std::int64_t id = begin(), other = begin();
  ForeignLock foreign(folder_ / "mdof.db");
  std::vector<MeasuredPoint> all;
  std::vector<std::future<Status>> kept;
  const auto append = [&](std::int64_t run, const MeasuredPoint& p) {
    auto reported = std::make_shared<std::promise<Status>>();
    kept.push_back(reported->get_future());
    keeper_->append_points(run, {p},
                           [reported](const Status& status) { reported->set_value(status); });
  };
  for (int target = 1; target <= 5; ++target) {
    all.push_back(point(target, 1));
    append(id, all.back());
  }
  EXPECT_FALSE(kept[3].get());  // the rejection is immediate, although the database is still locked
  EXPECT_FALSE(kept[4].get());
  EXPECT_EQ(keeper_->dropped_points(), 2u);
  EXPECT_EQ(keeper_->storage().state, "held");
  EXPECT_NE(keeper_->storage().reason.find("more than 3 points are pending"), std::string::npos)
      << keeper_->storage().reason;
  foreign.end();
  for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(kept[i].get()) << i;
  EXPECT_EQ(stored(id).points.size(), 3u);
  all.push_back(point(6, 1));
  append(id, all.back());  // rejected, because points 4 and 5 before it are not stored
  EXPECT_FALSE(kept.back().get());
  append(other, point(1, 1));  // the other run is not affected
  EXPECT_TRUE(kept.back().get());
  EXPECT_EQ(keeper_->dropped_points(), 3u);
  const std::int64_t read = end(id, all, false);
  EXPECT_NE(read, id);
  EXPECT_EQ(stored(read).points.size(), 6u);
  EXPECT_TRUE(stored(read).header.notices.empty());
  EXPECT_EQ(test::shown(stored(id).header.notices.front()), "points_not_stored points=3");
  // When the database is no longer locked, further points are accepted.
  ForeignLock again(folder_ / "mdof.db");
  for (int target = 2; target <= 4; ++target) append(other, point(target, 1));
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_EQ(keeper_->dropped_points(), 3u);
  again.end();
  EXPECT_TRUE(kept.back().get());
  EXPECT_EQ(end(other, {point(1, 1), point(2, 1), point(3, 1), point(4, 1)}, false), other);
}

// Each attempt to write to the locked database takes the whole timeout.
TEST_F(HeldDatabase, DoesNotDelayOtherWork) {
  restart(std::chrono::milliseconds(300));
  const std::int64_t id = begin();
  const ForeignLock foreign(folder_ / "mdof.db");
  keeper_->append_points(id, {point(1, 1)}, [](const Status&) {});
  const auto start = std::chrono::steady_clock::now();
  std::promise<void> last;
  constexpr int kJobs = 50;
  for (int i = 1; i <= kJobs; ++i)
    ASSERT_TRUE(keeper_->post([&last, i](store::Store&) {
      if (i == kJobs) last.set_value();
    }));
  last.get_future().wait();
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
  keeper_.reset();
}

TEST_F(HeldDatabase, EndOfARunFailsWithARemedyIfTheDaemonEnds) {
  const std::int64_t id = begin();
  ForeignLock foreign(folder_ / "mdof.db");
  std::promise<Result<std::int64_t>> ended;
  mdof::Run result;
  result.header.state = RunState::complete;
  keeper_->end_run(id, result, {}, [&](const auto& read) { ended.set_value(read); });
  keeper_.reset();
  const auto read = ended.get_future().get();
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().remedy, Remedy::resume_or_replay) << read.error().message;
}

TEST_F(HeldDatabase, ARunThatDoesNotBeginLeavesNoRecording) {
  const ForeignLock foreign(folder_ / "mdof.db");
  NewRun run;
  run.recording = folder_ / "orphan.mdofrec";
  run.begun.emplace(keeper_->create_recording(run).value());  // a resumed run has this state
  std::promise<Result<std::int64_t>> begun;
  ASSERT_TRUE(keeper_->begin_run(std::move(run), [&](const auto& id) { begun.set_value(id); }));
  EXPECT_FALSE(begun.get_future().get());
  for (const auto& entry : std::filesystem::directory_iterator(folder_))
    EXPECT_FALSE(entry.path().string().find("orphan") != std::string::npos) << entry.path();
}

TEST_F(StorekeeperTest, ADeletedRecordingFailsItsRun) {
  const auto recording = folder_ / "run.mdofrec";
  const std::int64_t id = begin(recording);
  std::filesystem::remove(recording);
  for (int i = 0; i < 100 && failed_ != id; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_EQ(failed_, id);
}

}  // namespace
}  // namespace mdof::daemon
