// A run is recorded, measured and ended. In one test the program crashes between any two writes.
// In another test the disk is full from any write on. In all cases:
// - acknowledged data are not lost
// - nothing is partly stored
// - the program continues
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <future>
#include <iterator>
#include <map>
#include <set>

#include "daemon/storekeeper/storekeeper.h"
#include "drivers/recording/recording_log.h"
#include "tests/daemon/storekeeper/watched_disk.h"

namespace mdof::daemon {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kScansOfBlock = 50;

MeasuredPoint solved_point(int target) {
  MeasuredPoint p;
  p.target = target;
  p.run = 1;
  p.target_m = p.point.position_m = 1e-3 * target;
  p.point.direction = 1;
  p.point.probe_m = p.point.probe_u_m = {1e-6, 2e-6, 3e-6, 4e-6, 5e-6};
  p.point.samples = 100;
  p.errors.valid = true;
  return p;
}

SampleBlock some_scans(std::int64_t k) {
  SampleBlock block{"d", {{"A", Unit::um}}, {}, {{}}, {}, 0};
  for (std::size_t i = 0; i < kScansOfBlock; ++i) {
    block.time_ns.push_back(1 + k * 1'000'000 + static_cast<std::int64_t>(i));
    block.value[0].push_back(static_cast<double>(i));
  }
  return block;
}

// Acknowledgements that a client has received so far. Used on the store's thread only.
struct Told {
  std::int64_t run = 0;    // id of the run that was started
  std::size_t points = 0;  // number of stored points
  std::int64_t chunks = 0;
  std::int64_t ended = 0;  // id of the run that has the result
  bool refused = false;    // true if a write failed or the run has failed
};

class EveryWrite : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "mdof-writes-XXXXXX").string();
    ASSERT_TRUE(::mkdtemp(name.data()));
    folder_ = name;
    ASSERT_TRUE(store::Store::open(folder_ / "fresh.db", store::Access::read_write));
  }
  void TearDown() override { fs::remove_all(folder_); }

  // Makes a data folder with the database of an earlier start of mdofd.
  fs::path make_data_folder(const std::string& name) {
    const fs::path life = folder_ / name;
    fs::create_directories(life);
    fs::copy_file(folder_ / "fresh.db", life / "mdof.db");
    return life;
  }
  std::unique_ptr<Storekeeper> keeper_of(const fs::path& life, Told& reported) {
    Storekeeper::Options options{life / "mdof.db"};
    options.commit_interval = std::chrono::milliseconds(1);
    return Storekeeper::start(options,
                              {[&](std::int64_t, std::int64_t seq) { reported.chunks = seq; },
                               [&](std::int64_t, const Error&) { reported.refused = true; }})
        .value();
  }
  static bool begin(Storekeeper& keeper, const fs::path& recording, Told& reported) {
    std::promise<bool> begun;
    NewRun run;
    run.recording = recording;
    run.header.started_utc = "2026-11-23T00:00:00.000Z";
    run.header.provenance.recording_kind = "recording";
    run.header.provenance.recording_path = recording.string();
    run.header.provenance.model = "rigid";
    keeper.begin_run(std::move(run), [&](const auto& id) {
      reported.run = id.value_or(0);
      begun.set_value(id.has_value());
    });
    return begun.get_future().get();
  }
  static void append(Storekeeper& keeper, int block, std::vector<MeasuredPoint> points,
                     Told& reported) {
    EXPECT_TRUE(keeper.record(reported.run, {some_scans(block)}, true));
    std::promise<void> done;
    keeper.append_points(reported.run, points, [&](const Status& kept) {
      if (kept) reported.points += points.size();
      reported.refused = reported.refused || !kept;
      done.set_value();
    });
    done.get_future().get();
  }
  // Measures a run of three points in two portions. If `otherwise` is true, the points are
  // renumbered at the end, and a second run with four points supersedes the run.
  static void measure(Storekeeper& keeper, const fs::path& recording, bool otherwise,
                      Told& reported) {
    if (!begin(keeper, recording, reported)) return;
    append(keeper, 0, {solved_point(1), solved_point(2)}, reported);
    append(keeper, 1, {solved_point(3)}, reported);
    mdof::Run result;
    result.header.state = RunState::complete;
    for (int target = 1; target <= (otherwise ? 4 : 3); ++target)
      result.points.push_back(solved_point(target));
    std::promise<void> done;
    keeper.end_run(reported.run, result, {otherwise}, [&](const auto& id) {
      reported.ended = id.value_or(0);
      reported.refused = reported.refused || !id;
      done.set_value();
    });
    done.get_future().get();
  }

  // Checks the data that the next start of the program finds.
  static void expect_sound(store::Store& store, const fs::path& recording, const Told& reported,
                           std::size_t points_at_end) {
    const auto findings = store.verify();
    ASSERT_TRUE(findings) << findings.error().message;
    EXPECT_TRUE(findings->empty()) << findings->front();
    if (reported.run == 0) return;
    const auto run = store.run(reported.run);
    ASSERT_TRUE(run) << run.error().message;
    EXPECT_GE(run->points.size(), reported.points);
    const auto by = store.superseded_by(reported.run).value();
    if (by) {
      EXPECT_EQ(run->header.state, RunState::failed);
      EXPECT_EQ(store.run(*by)->points.size(), points_at_end) << "both, or neither";
      EXPECT_EQ(store.run(*by)->header.state, RunState::complete);
    }
    if (reported.ended != 0) {
      const auto read = store.run(reported.ended);
      ASSERT_TRUE(read) << read.error().message;
      EXPECT_EQ(read->header.state, RunState::complete);
      EXPECT_EQ(read->points.size(), points_at_end);
    }
    drivers::RecordingLog log("recording", recording);
    const Status opened = log.open();
    ASSERT_TRUE(opened || reported.chunks == 0) << opened.error().message;
    std::size_t scans = 0;
    SampleBlock block;
    while (opened) {
      const auto state = log.read(block, std::chrono::milliseconds(0));
      if (!state || *state == drivers::ReadState::end) break;
      scans += block.scans();
    }
    EXPECT_GE(scans, kScansOfBlock * static_cast<std::size_t>(reported.chunks));
    EXPECT_GE(scans, kScansOfBlock * (reported.points / 2 + reported.points % 2))
        << "of the points";
  }

  fs::path folder_;
};

// A copy of all files of a folder at this moment, without SQLite's shared memory.
class Snapshot {
 public:
  Snapshot(const fs::path& folder, const Told& reported) : told_(reported) {
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (entry.path().extension() == ".lock" || entry.path().string().ends_with("-shm")) continue;
      std::ifstream in(entry.path(), std::ios::binary);
      files_[entry.path().filename()] = {std::istreambuf_iterator<char>(in), {}};
    }
  }
  void put_into(const fs::path& folder) const {
    fs::create_directories(folder);
    for (const auto& [name, bytes] : files_)
      std::ofstream(folder / name, std::ios::binary)
          .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
  const Told& reported() const { return told_; }

 private:
  std::map<std::string, std::string> files_;
  Told told_;
};

TEST_F(EveryWrite, ACrashBetweenTwoWritesLosesNothingAcknowledged) {
  for (const bool otherwise : {false, true}) {
    std::vector<Snapshot> crashes;
    {
      const fs::path life = make_data_folder(otherwise ? "superseded" : "plain");
      Told reported;
      const WatchedDisk disk([&] {
        crashes.emplace_back(life, reported);
        return SQLITE_OK;
      });
      auto keeper = keeper_of(life, reported);
      measure(*keeper, life / "run.mdofrec", otherwise, reported);
      EXPECT_EQ(reported.ended, otherwise ? 2 : 1);
      EXPECT_FALSE(reported.refused);
      keeper.reset();
      crashes.emplace_back(life, reported);
    }
    EXPECT_GT(crashes.size(), 40u);
    std::set<std::size_t> kept;
    std::size_t number = 0;
    for (const Snapshot& crash : crashes) {
      const fs::path after = folder_ / ("after_" + std::to_string(number));
      SCOPED_TRACE("write " + std::to_string(number++) + " of " + std::to_string(crashes.size()));
      crash.put_into(after);
      auto store = store::Store::open(after / "mdof.db", store::Access::read_write,
                                      {store::Durability::off, 50});
      ASSERT_TRUE(store) << store.error().message;
      expect_sound(*store, after / "run.mdofrec", crash.reported(), otherwise ? 4 : 3);
      kept.insert(crash.reported().points);
      const auto run = store->run_header(1);
      EXPECT_TRUE(!run || run->state != RunState::open);
      EXPECT_TRUE(store->begin_run({})) << "it goes on";
      fs::remove_all(after);
    }
    EXPECT_EQ(kept, (std::set<std::size_t>{0, 2, 3}));
  }
}

TEST_F(EveryWrite, AFullDiskFromAnyWriteLosesNothingAndRecovers) {
  int refused_lives = 0, whole_lives = 0;
  for (int first_refused = 0;; ++first_refused) {
    SCOPED_TRACE("full from write " + std::to_string(first_refused));
    const bool otherwise = first_refused % 2 == 1;
    const fs::path life = make_data_folder("life" + std::to_string(first_refused));
    std::atomic<bool> begun = false, has_room = false;
    std::atomic<int> writes = 0;
    Told reported, next;
    {
      std::unique_ptr<Storekeeper> keeper;
      const WatchedDisk disk([&] {
        return begun && !has_room && writes++ >= first_refused ? SQLITE_FULL : SQLITE_OK;
      });
      keeper = keeper_of(life, reported);
      begun = true;
      measure(*keeper, life / "run.mdofrec", otherwise, reported);
      has_room = true;
      EXPECT_TRUE(reported.run != 0 || !fs::exists(life / "run.mdofrec")) << "of no run";
      const Told before = reported;
      measure(*keeper, life / "next.mdofrec", otherwise, next);
      reported.chunks = before.chunks;  // the chunks of the next run were counted here too
      reported.refused = before.refused;
      keeper.reset();
    }
    EXPECT_GT(next.ended, 0) << "what comes once there is room again is stored";
    EXPECT_FALSE(next.refused);
    auto store = store::Store::open(life / "mdof.db", store::Access::read_only);
    ASSERT_TRUE(store) << store.error().message;
    expect_sound(*store, life / "run.mdofrec", reported, otherwise ? 4 : 3);
    expect_sound(*store, life / "next.mdofrec", next, otherwise ? 4 : 3);
    const bool whole = reported.ended > 0 && !reported.refused;
    EXPECT_TRUE(whole || reported.run == 0 || reported.refused) << "lost in silence";
    if (reported.run > 0) {
      const RunHeader run = store->run_header(reported.run).value();
      EXPECT_NE(run.state, RunState::open);
      EXPECT_TRUE(whole || (run.state == RunState::failed && !run.notices.empty()))
          << "it does not say why";
    }
    fs::remove_all(life);
    refused_lives += !whole;
    whole_lives += whole;
    // All writes succeeded, so there is no further case.
    if (whole && writes <= first_refused) break;
    ASSERT_LT(first_refused, 1000);
  }
  EXPECT_GT(refused_lives, 20);
  EXPECT_GT(whole_lives, 0);
}

}  // namespace
}  // namespace mdof::daemon
