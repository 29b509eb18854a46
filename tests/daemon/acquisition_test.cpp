// A device that fails, comes back, and loses samples: what of that is told.
#include "daemon/acquisition.h"

#include <gtest/gtest.h>

#include <condition_variable>
#include <deque>

namespace mdof::daemon {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

// What the fake device does at each call of open() and read(), in turn; then it stays silent.
struct Script {
  enum class Act { open, slow_open, refuse, block, silence, fail, end };
  std::deque<Act> acts;
  std::int64_t time_ns = 0;  // of the next scan
};

class Scripted final : public drivers::Driver {
 public:
  explicit Scripted(Script script) : script_(std::move(script)) {}
  drivers::DeviceInfo info() const override {
    return {"fake", "fake", "", {{"A", Unit::um}}, 1000, false, {}};
  }
  Status open() override {
    const auto act = next();
    if (act == Script::Act::slow_open) std::this_thread::sleep_for(milliseconds(300));
    return act == Script::Act::refuse ? io_error("10.0.0.9: no route") : Status();
  }
  Result<drivers::ReadState> read(SampleBlock& block, milliseconds) override {
    block = SampleBlock();
    switch (next()) {
      case Script::Act::fail:
        return io_error("10.0.0.9: gone");
      case Script::Act::end:
        return drivers::ReadState::end;
      case Script::Act::block:
        fill(block);
        break;
      default:
        std::this_thread::sleep_for(milliseconds(1));
    }
    return drivers::ReadState::more;
  }

 private:
  Script::Act next() {
    if (script_.acts.empty()) return Script::Act::silence;
    const auto act = script_.acts.front();
    script_.acts.pop_front();
    return act;
  }
  // Ten scans at 1 kHz; after a failure the next block is a second later.
  void fill(SampleBlock& block) {
    block.device = "fake";
    block.channels = info().channels;
    block.value.resize(1);
    for (int i = 0; i < 10; ++i) {
      block.time_ns.push_back(script_.time_ns);
      block.value[0].push_back(i);
      script_.time_ns += 1'000'000;
    }
    if (!script_.acts.empty() && script_.acts.front() == Script::Act::fail)
      script_.time_ns += 1'000'000'000;
  }
  Script script_;
};

// Collects what comes; takes only so many blocks where told so.
class Collector {
 public:
  explicit Collector(std::size_t room = 1000) : room_(room) {}
  Acquisition::Sink sink() {
    Acquisition::Sink sink;
    sink.samples = [this](SampleBlock& block, std::uint64_t, milliseconds) {
      const std::lock_guard lock(mutex_);
      if (refused_ < refuse_ && blocks_.size() == 1) {
        ++refused_;
        return false;
      }
      if (blocks_.size() >= room_) return false;
      blocks_.push_back(std::move(block));
      changed_.notify_all();
      return true;
    };
    sink.ended = [this](std::uint64_t, const std::string& reason, const drivers::SourceInfo&) {
      const std::lock_guard lock(mutex_);
      ended_ = true;
      reason_ = reason;
      changed_.notify_all();
    };
    return sink;
  }
  void refuse_after_the_first(int blocks) { refuse_ = blocks; }
  bool wait_for(std::size_t blocks) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, std::chrono::seconds(20),
                             [&] { return blocks_.size() >= blocks; });
  }
  bool wait_for_end() {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, std::chrono::seconds(20), [&] { return ended_; });
  }
  std::vector<SampleBlock> blocks() {
    const std::lock_guard lock(mutex_);
    return blocks_;
  }
  const std::string& reason() const { return reason_; }

 private:
  std::size_t room_;
  int refuse_ = 0, refused_ = 0;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<SampleBlock> blocks_;
  bool ended_ = false;
  std::string reason_;
};

drivers::DriverSpec spec_of(std::deque<Script::Act> acts, bool live = true) {
  drivers::DriverSpec spec;
  spec.driver = "fake";
  spec.name = "fake";
  spec.live = live;
  spec.make = [acts]() -> Result<std::unique_ptr<drivers::Driver>> {
    return std::make_unique<Scripted>(Script{acts, 0});
  };
  spec.source_info = [](const drivers::Driver&) { return drivers::SourceInfo{}; };
  return spec;
}

using enum Script::Act;

TEST(Acquisition, ReopensAFailedDeviceAndTellsWhatWasLost) {
  Collector collector;
  Acquisition acquisition(spec_of({open, block, fail, refuse, refuse, open, silence, block}),
                          collector.sink());
  acquisition.start();
  ASSERT_TRUE(collector.wait_for(2));
  const auto blocks = collector.blocks();
  EXPECT_EQ(blocks[0].lost, 0u);
  EXPECT_EQ(blocks[1].lost, 1000u);  // a second at 1 kHz
  const DeviceStatus status = acquisition.status();
  EXPECT_EQ(status.state, "open");
  EXPECT_EQ(status.reopened, 3u);
  EXPECT_EQ(status.lost, 1000u);
  EXPECT_EQ(status.scans, 20u);
  EXPECT_EQ(status.error, "10.0.0.9: no route");  // the last one stays to be read
  EXPECT_TRUE(acquisition.healthy(std::chrono::seconds(5)));
  acquisition.stop();
  EXPECT_EQ(acquisition.status().state, "closed");
}

TEST(Acquisition, ADeviceThatTakesLongToOpenIsNoHungThread) {
  Collector collector;
  Acquisition acquisition(spec_of({slow_open, block}), collector.sink());
  acquisition.start();
  std::this_thread::sleep_for(milliseconds(20));  // the thread has begun
  while (collector.blocks().empty()) {
    ASSERT_TRUE(acquisition.healthy(milliseconds(150)));
    std::this_thread::sleep_for(milliseconds(1));
  }
}

// By themselves the pauses of forty refusals take over a quarter of a minute.
TEST(Acquisition, ADeviceThatIsPluggedInIsNotKeptWaiting) {
  std::deque<Script::Act> acts(40, refuse);
  acts.insert(acts.end(), {open, block});
  Collector collector;
  Acquisition acquisition(spec_of(acts), collector.sink());
  const auto begin = steady_clock::now();
  acquisition.start();
  while (collector.blocks().empty() && steady_clock::now() - begin < std::chrono::seconds(20)) {
    acquisition.wake();
    std::this_thread::sleep_for(milliseconds(1));
  }
  EXPECT_EQ(acquisition.status().reopened, 40u);
  EXPECT_LT(steady_clock::now() - begin, std::chrono::seconds(10));
}

TEST(Acquisition, WhatTheQueueHadNoRoomForIsToldWithTheNextBlock) {
  Collector collector;
  collector.refuse_after_the_first(2);
  Acquisition acquisition(spec_of({open, block, block, block, block}), collector.sink());
  acquisition.start();
  ASSERT_TRUE(collector.wait_for(2));
  EXPECT_EQ(collector.blocks()[1].lost, 20u);
  EXPECT_EQ(acquisition.status().dropped, 2u);
  EXPECT_EQ(acquisition.status().lost, 20u);
}

TEST(Acquisition, AReplayEndsOnceAndForAll) {
  Collector collector;
  Acquisition acquisition(spec_of({open, block, Script::Act::end}, false), collector.sink());
  acquisition.start();
  ASSERT_TRUE(collector.wait_for_end());
  EXPECT_EQ(collector.reason(), "");
  EXPECT_EQ(acquisition.status().state, "ended");
  EXPECT_TRUE(acquisition.healthy(milliseconds(0)));
}

TEST(Acquisition, AReplayThatFailsSaysWhyAndIsNotAskedAgain) {
  Collector collector;
  Acquisition acquisition(spec_of({open, fail, open, block}, false), collector.sink());
  acquisition.start();
  ASSERT_TRUE(collector.wait_for_end());
  EXPECT_EQ(collector.reason(), "10.0.0.9: gone");
  EXPECT_TRUE(collector.blocks().empty());
}

TEST(Acquisition, StopsWhileItWaits) {
  Collector collector;
  Acquisition acquisition(spec_of(std::deque<Script::Act>(1000, refuse)), collector.sink());
  acquisition.start();
  std::this_thread::sleep_for(milliseconds(20));
  const auto begin = steady_clock::now();
  acquisition.stop();
  EXPECT_LT(steady_clock::now() - begin, std::chrono::seconds(5));
  EXPECT_EQ(acquisition.status().scans, 0u);
}

}  // namespace
}  // namespace mdof::daemon
