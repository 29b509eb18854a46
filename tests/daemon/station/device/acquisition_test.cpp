// Reports about a device that fails, returns or loses samples.
#include "daemon/station/device/acquisition.h"
#include "drivers/long_step.h"

#include <gtest/gtest.h>

#include <condition_variable>
#include <deque>

namespace mdof::daemon {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

// Actions of the fake device, one for each call of open() and read(). After the last action the
// device sends nothing.
struct Script {
  enum class Act {
    open,
    slow_open,
    reopen_at_zero,
    open_with_new_clock,
    refuse,
    block,
    late_block,
    block_after_jump,
    silence,
    fail,
    end,
    slow_read,
    hang
  };
  std::deque<Act> acts;
  std::int64_t time_ns = 0;  // time of the next scan
  double rate_hz = 1000;     // 0: the device states no rate
};

class Scripted final : public drivers::Driver {
 public:
  explicit Scripted(Script script) : script_(std::move(script)) {}
  drivers::DeviceInfo info() const override {
    return {"fake", "fake",         "",         {{"A", Unit::um}}, script_.rate_hz,
            false,  clock_.state(), datum_lost_};
  }
  const drivers::DeviceClock* clock() const override { return &clock_; }
  Status open() override {
    const auto act = next();
    if (act == Script::Act::reopen_at_zero) datum_lost_ = "it counts from 0 again";
    if (act == Script::Act::open_with_new_clock) clock_ = drivers::DeviceClock(1.0);
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
      case Script::Act::late_block:
        clock_.add(script_.time_ns, script_.time_ns + 300'000'000);
        fill(block);
        break;
      case Script::Act::block_after_jump:  // the clock jumps forward by 1 s
        clock_.add(script_.time_ns + 1'000'000'000, script_.time_ns);
        fill(block);
        break;
      case Script::Act::slow_read:
        drivers::expect_long_step(milliseconds(1500));
        [[fallthrough]];
      case Script::Act::hang:
        std::this_thread::sleep_for(milliseconds(700));
        break;
      case Script::Act::block:
        clock_.add(script_.time_ns, script_.time_ns);
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
  // Ten scans at 1 kHz. The first block after a failure is one second later.
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
  std::string datum_lost_;
  drivers::DeviceClock clock_{1.0};  // one tick of the clock is 1 ns
};

// Collects blocks. If `room` is given, it accepts only this number of blocks.
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
    sink.trouble = [this](const Trouble& trouble) {
      const std::lock_guard lock(mutex_);
      troubles_.push_back(trouble_line(trouble));
    };
    return sink;
  }
  std::vector<std::string> troubles() {
    const std::lock_guard lock(mutex_);
    return troubles_;
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
  std::vector<std::string> troubles_;
  bool ended_ = false;
  std::string reason_;
};

drivers::DriverSpec scripted_spec(std::deque<Script::Act> acts, bool live = true,
                                  double rate_hz = 1000) {
  drivers::DriverSpec spec;
  spec.driver = "fake";
  spec.name = "fake";
  spec.live = live;
  spec.make = [acts, rate_hz]() -> Result<std::unique_ptr<drivers::Driver>> {
    return std::make_unique<Scripted>(Script{acts, 0, rate_hz});
  };
  spec.source_info = [](const drivers::Driver&) { return drivers::SourceInfo{}; };
  return spec;
}

using enum Script::Act;

TEST(Acquisition, ReopensAFailedDeviceAndReportsLostSamples) {
  Collector collector;
  Acquisition acquisition(scripted_spec({open, block, fail, refuse, refuse, open, silence, block}),
                          collector.sink());
  acquisition.start();
  ASSERT_TRUE(collector.wait_for(2));
  const auto blocks = collector.blocks();
  EXPECT_EQ(blocks[0].lost, 0u);
  EXPECT_EQ(blocks[1].lost, 1000u);  // one second at 1 kHz
  const DeviceStatus status = acquisition.status();
  EXPECT_EQ(status.state, "open");
  EXPECT_EQ(status.reopened, 3u);
  EXPECT_EQ(status.lost, 1000u);
  EXPECT_EQ(status.scans, 20u);
  EXPECT_EQ(status.error, "");  // the device works again, so there is no current error
  EXPECT_EQ(status.last_error, "10.0.0.9: no route");
  EXPECT_FALSE(status.recovered_utc.empty());
  EXPECT_TRUE(status.standing.empty());
  EXPECT_TRUE(acquisition.healthy(std::chrono::seconds(5)));
  acquisition.stop();
  EXPECT_EQ(acquisition.status().state, "closed");
}

// Returns whether healthy() is true during the whole time of a read that takes 0.7 s.
bool is_healthy_throughout(Script::Act act) {
  Collector collector;
  Acquisition acquisition(scripted_spec({open, block, act, block}), collector.sink());
  acquisition.start();
  bool healthy = true;
  while (collector.blocks().size() < 2) {
    healthy = healthy && acquisition.healthy(milliseconds(500));
    std::this_thread::sleep_for(milliseconds(5));
  }
  return healthy;
}

TEST(Acquisition, EstimatesLostScansByTheMeasuredRateIfTheDeviceStatesNone) {
  Collector collector;
  Acquisition fake(scripted_spec({open, block, fail, open, block}, true, 0), collector.sink());
  fake.start();
  ASSERT_TRUE(collector.wait_for(2));
  EXPECT_EQ(collector.blocks()[1].lost, 1000u);  // one second at 1 kHz
}

TEST(Acquisition, AnAnnouncedLongReadIsNotAHang) {
  EXPECT_TRUE(is_healthy_throughout(slow_read));
  EXPECT_FALSE(is_healthy_throughout(hang));
}

TEST(Acquisition, ReportsALossAndARecoveryOnceEach) {
  Collector collector;
  Acquisition acquisition(scripted_spec({open, block, fail, refuse, refuse, open, silence, block}),
                          collector.sink());
  acquisition.start();
  ASSERT_TRUE(collector.wait_for(2));
  const auto reported = collector.troubles();
  ASSERT_EQ(reported.size(), 2u);
  EXPECT_EQ(reported[0], "device \"fake\": lost: 10.0.0.9: gone");
  EXPECT_TRUE(
      reported[1].starts_with("device \"fake\": back: the device sends samples again after "))
      << reported[1];
  EXPECT_TRUE(reported[1].ends_with("; scans lost in this time: 1000")) << reported[1];
}

TEST(Acquisition, ReportsALostDatumAndKeepsItSuspect) {
  Collector collector;
  Acquisition acquisition(
      scripted_spec({open, block, fail, reopen_at_zero, block, fail, open, block}),
      collector.sink());
  acquisition.start();
  ASSERT_TRUE(collector.wait_for(3));
  const auto reported = collector.troubles();
  ASSERT_EQ(reported.size(), 5u);  // reports: lost, suspect, back, lost, back
  EXPECT_NE(reported[1].find("suspect: the encoder's datum is lost"), std::string::npos)
      << reported[1];
  EXPECT_NE(reported[1].find("it counts from 0 again"), std::string::npos) << reported[1];
  const auto standing = acquisition.status().standing;
  ASSERT_EQ(standing.size(), 1u);
  EXPECT_EQ(standing[0].kind, Trouble::Kind::suspect);
}

TEST(Acquisition, ReportsOnceThatADeviceCannotBeOpened) {
  Collector collector;
  Acquisition acquisition(scripted_spec(std::deque<Script::Act>(100, refuse)), collector.sink());
  acquisition.start();
  while (acquisition.status().reopened < 3) std::this_thread::sleep_for(milliseconds(1));
  EXPECT_EQ(collector.troubles(),
            std::vector<std::string>{"device \"fake\": lost: 10.0.0.9: no route"});
  const DeviceStatus status = acquisition.status();
  ASSERT_EQ(status.standing.size(), 1u);
  EXPECT_EQ(status.standing[0].kind, Trouble::Kind::lost);
  EXPECT_EQ(status.error, "10.0.0.9: no route");
}

// At 1 kHz, 5000 scans are expected in 5 s. The device delivers only 10.
TEST(Acquisition, ReportsASlowDevice) {
  Collector collector;
  Acquisition acquisition(scripted_spec({open, block}), collector.sink());
  acquisition.start();
  const auto begin = steady_clock::now();
  while (collector.troubles().empty() && steady_clock::now() - begin < std::chrono::seconds(20))
    std::this_thread::sleep_for(milliseconds(10));
  ASSERT_EQ(collector.troubles().size(), 1u);
  EXPECT_NE(collector.troubles()[0].find("slow: the device sends "), std::string::npos)
      << collector.troubles()[0];
}

TEST(Acquisition, ADeviceThatOpensSlowlyIsNotAHungThread) {
  Collector collector;
  Acquisition acquisition(scripted_spec({slow_open, block}), collector.sink());
  acquisition.start();
  std::this_thread::sleep_for(milliseconds(20));  // the thread has started now
  while (collector.blocks().empty()) {
    ASSERT_TRUE(acquisition.healthy(milliseconds(150)));
    std::this_thread::sleep_for(milliseconds(1));
  }
}

// Forty attempts to open the device fail. Without the plug-in event, the pauses between the
// attempts would take over 15 s.
TEST(Acquisition, OpensAPluggedInDeviceWithoutDelay) {
  std::deque<Script::Act> acts(40, refuse);
  acts.insert(acts.end(), {open, block});
  Collector collector;
  Acquisition acquisition(scripted_spec(acts), collector.sink());
  const auto begin = steady_clock::now();
  acquisition.start();
  while (collector.blocks().empty() && steady_clock::now() - begin < std::chrono::seconds(20)) {
    acquisition.wake();
    std::this_thread::sleep_for(milliseconds(1));
  }
  EXPECT_EQ(acquisition.status().reopened, 40u);
  EXPECT_LT(steady_clock::now() - begin, std::chrono::seconds(10));
}

TEST(Acquisition, ReportsSamplesLostByAFullQueueWithTheNextBlock) {
  Collector collector;
  collector.refuse_after_the_first(2);
  Acquisition acquisition(scripted_spec({open, block, block, block, block}), collector.sink());
  acquisition.start();
  ASSERT_TRUE(collector.wait_for(2));
  EXPECT_EQ(collector.blocks()[1].lost, 20u);
  EXPECT_EQ(acquisition.status().dropped, 2u);
  EXPECT_EQ(acquisition.status().lost, 20u);
}

TEST(Acquisition, AReplayEndsPermanently) {
  Collector collector;
  Acquisition acquisition(scripted_spec({open, block, Script::Act::end}, false), collector.sink());
  acquisition.start();
  ASSERT_TRUE(collector.wait_for_end());
  EXPECT_EQ(collector.reason(), "");
  EXPECT_EQ(acquisition.status().state, "ended");
  EXPECT_TRUE(acquisition.healthy(milliseconds(0)));
}

TEST(Acquisition, AFailedReplayStatesWhyAndIsNotRetried) {
  Collector collector;
  Acquisition acquisition(scripted_spec({open, fail, open, block}, false), collector.sink());
  acquisition.start();
  ASSERT_TRUE(collector.wait_for_end());
  EXPECT_EQ(collector.reason(), "10.0.0.9: gone");
  EXPECT_TRUE(collector.blocks().empty());
}

TEST(Acquisition, StopsWhileItWaits) {
  Collector collector;
  Acquisition acquisition(scripted_spec(std::deque<Script::Act>(1000, refuse)), collector.sink());
  acquisition.start();
  std::this_thread::sleep_for(milliseconds(20));
  const auto begin = steady_clock::now();
  acquisition.stop();
  EXPECT_LT(steady_clock::now() - begin, std::chrono::seconds(5));
  EXPECT_EQ(acquisition.status().scans, 0u);
}

// For a while, packets arrive too late. Their samples are suspect, so they get no position, and
// the station reports this.
TEST(Acquisition, SamplesAreSuspectWhileTheirClockIsUncertain) {
  Collector collector;
  Acquisition acquisition(scripted_spec({open, block, late_block, late_block, block}),
                          collector.sink());
  acquisition.start();
  ASSERT_TRUE(collector.wait_for(4));
  acquisition.stop();
  const auto blocks = collector.blocks();
  for (std::size_t b = 0; b < 4; ++b)
    for (std::size_t i = 0; i < blocks[b].scans(); ++i)
      EXPECT_EQ(blocks[b].quality_at(0, i), b == 1 || b == 2 ? Quality::suspect : Quality::good);
  const auto troubles = collector.troubles();
  ASSERT_EQ(troubles.size(), 2u);
  EXPECT_NE(troubles[0].find("clock: the packets arrive 300 ms late"), std::string::npos);
  EXPECT_NE(troubles[1].find("back: the times of the samples are valid again"), std::string::npos);
  EXPECT_TRUE(acquisition.status().standing.empty());
}

// The driver begins a new clock when it opens the device again. The new clock has not jumped.
TEST(Acquisition, ANewClockOfAnOpenedDeviceHasNotJumped) {
  Collector collector;
  Acquisition acquisition(
      scripted_spec({open, block, block_after_jump, fail, open_with_new_clock, block, block}),
      collector.sink());
  acquisition.start();
  ASSERT_TRUE(collector.wait_for(4));
  acquisition.stop();
  int jumps = 0;
  for (const std::string& trouble : collector.troubles())
    jumps += trouble.find("clock: the device clock jumped") != std::string::npos;
  EXPECT_EQ(jumps, 1);
  EXPECT_TRUE(acquisition.status().standing.empty());
}

}  // namespace
}  // namespace mdof::daemon
