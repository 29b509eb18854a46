// One device that two axes use. Each axis gets its channels and the troubles of the device.
#include "daemon/station/device/shared_device.h"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <thread>

namespace mdof::daemon {
namespace {

using std::chrono::milliseconds;

// A device that counts at two encoders and reads a probe in each scan. Thread-safe.
struct TwoCounters {
  std::atomic<int> opened{0}, destroyed{0}, x_trusted{0};
  std::atomic<bool> gone{false}, x_lost{false}, y_lost{false};
};

class TwoCountersDriver final : public drivers::Driver {
 public:
  explicit TwoCountersDriver(std::shared_ptr<TwoCounters> state) : state_(std::move(state)) {}
  ~TwoCountersDriver() override { ++state_->destroyed; }
  drivers::DeviceInfo info() const override {
    drivers::DeviceInfo info;
    info.name = "t7";
    info.channels = {{"A", Unit::volt}, {"encoder", Unit::um}, {"encoder_Y", Unit::um}};
    info.rate_hz = 1000;
    if (state_->x_lost) info.datum_lost = "it counts from 0 again";
    if (state_->y_lost) info.further_datum_lost["encoder_Y"] = "it counts from 0 again";
    return info;
  }
  Status open() override {
    if (state_->gone) return io_error("10.0.0.9: no route");
    ++state_->opened;
    return {};
  }
  Result<drivers::ReadState> read(SampleBlock& block, milliseconds) override {
    if (state_->gone) return io_error("10.0.0.9: gone");
    std::this_thread::sleep_for(milliseconds(1));
    block = SampleBlock();
    block.device = "t7";
    block.channels = info().channels;
    block.quality.assign(3, {Quality::good});
    ++scan_;
    block.time_ns = {scan_ * 1'000'000};
    block.value = {{1}, {static_cast<double>(scan_)}, {-static_cast<double>(scan_)}};
    if (state_->y_lost) block.quality[2] = {Quality::suspect};
    return drivers::ReadState::more;
  }
  void trust_count() override {
    state_->x_lost = false;
    ++state_->x_trusted;
  }
  void trust_further_count(const std::string& channel) override {
    if (channel == "encoder_Y") state_->y_lost = false;
  }

 private:
  std::shared_ptr<TwoCounters> state_;
  std::int64_t scan_ = 0;
};

// Collects the data and reports that one axis received.
class TakingAxis {
 public:
  DeviceSink sink() {
    DeviceSink sink;
    sink.samples = [this](SampleBlock& block, std::uint64_t, milliseconds) {
      const std::lock_guard lock(mutex_);
      if (full_) return false;
      blocks_.push_back(std::move(block));
      return true;
    };
    sink.trouble = [this](const Trouble& trouble) {
      const std::lock_guard lock(mutex_);
      troubles_.push_back(to_string(trouble.kind));
    };
    sink.ended = [](std::uint64_t, const std::string&, const drivers::SourceInfo&) {};
    return sink;
  }
  std::vector<SampleBlock> blocks() {
    const std::lock_guard lock(mutex_);
    return blocks_;
  }
  std::vector<std::string> troubles() {
    const std::lock_guard lock(mutex_);
    return troubles_;
  }
  void set_full(bool full) {
    const std::lock_guard lock(mutex_);
    full_ = full;
  }

 private:
  std::mutex mutex_;
  bool full_ = false;
  std::vector<SampleBlock> blocks_;
  std::vector<std::string> troubles_;
};

template <class Condition>
bool becomes_true(const Condition& condition) {
  for (int i = 0; i < 20'000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(milliseconds(1));
  }
  return false;
}

class SharedDeviceTest : public testing::Test {
 protected:
  SharedDeviceTest() {
    spec_.name = "t7";
    spec_.make = [state = state_]() -> Result<std::unique_ptr<drivers::Driver>> {
      return std::make_unique<TwoCountersDriver>(state);
    };
    spec_.part = {{"A", "A"}, {"encoder", "encoder"}};
    drivers::DriverSpec of_y = spec_;
    of_y.is_declared_elsewhere = true;
    of_y.part = {{"A", "left"}, {"encoder_Y", "encoder"}};
    part_x_ = devices_.part(spec_, x_.sink());
    part_y_ = devices_.part(of_y, y_.sink());
  }
  void start() {
    part_x_->start();
    part_y_->start();
    ASSERT_TRUE(becomes_true([&] { return x_.blocks().size() > 2 && y_.blocks().size() > 2; }));
  }
  static std::size_t standing(const DeviceReader& part) { return part.status().standing.size(); }

  std::shared_ptr<TwoCounters> state_ = std::make_shared<TwoCounters>();
  drivers::DriverSpec spec_;
  TakingAxis x_, y_;
  SharedDevices devices_;
  std::unique_ptr<DeviceReader> part_x_, part_y_;
};

TEST_F(SharedDeviceTest, IsOpenedOnceAndGivesEachAxisItsChannels) {
  start();
  EXPECT_EQ(state_->opened, 1);
  const SampleBlock x = x_.blocks().back(), y = y_.blocks().back();
  EXPECT_EQ(x.channels, (std::vector<Channel>{{"A", Unit::volt}, {"encoder", Unit::um}}));
  EXPECT_EQ(y.channels, (std::vector<Channel>{{"left", Unit::volt}, {"encoder", Unit::um}}));
  EXPECT_GT(x.value[1][0], 0);
  EXPECT_LT(y.value[1][0], 0);
  EXPECT_EQ(x.quality.size(), 2u);
  EXPECT_EQ(x.device, "t7");
  EXPECT_EQ(part_y_->status().info.channels, y.channels);
  EXPECT_EQ(part_y_->status().state, "open");
}

TEST_F(SharedDeviceTest, ALossIsReportedToBothAxes) {
  start();
  state_->gone = true;
  const std::vector<std::string> lost = {"lost"}, back = {"lost", "back"};
  EXPECT_TRUE(becomes_true([&] { return x_.troubles() == lost && y_.troubles() == lost; }));
  EXPECT_EQ(standing(*part_x_), 1u);
  EXPECT_EQ(standing(*part_y_), 1u);
  state_->gone = false;
  EXPECT_TRUE(becomes_true([&] { return x_.troubles() == back && y_.troubles() == back; }));
}

// The state of the device is checked once a second.
TEST_F(SharedDeviceTest, ALostDatumAffectsItsAxisOnly) {
  start();
  state_->y_lost = true;
  const std::vector<std::string> suspect = {"suspect"};
  ASSERT_TRUE(becomes_true([&] { return y_.troubles() == suspect; }));
  EXPECT_EQ(standing(*part_y_), 1u);
  EXPECT_EQ(standing(*part_x_), 0u);
  EXPECT_TRUE(x_.troubles().empty());
  part_x_->trust_count();  // datum of the other axis
  ASSERT_TRUE(becomes_true([&] { return state_->x_trusted == 1; }));
  EXPECT_TRUE(state_->y_lost);
  EXPECT_EQ(standing(*part_y_), 1u);
  state_->x_lost = true;
  ASSERT_TRUE(becomes_true([&] { return x_.troubles() == suspect; }));
  part_y_->trust_count();
  ASSERT_TRUE(becomes_true([&] { return !state_->y_lost; }));
  EXPECT_TRUE(state_->x_lost);
  EXPECT_EQ(standing(*part_y_), 0u);
  EXPECT_EQ(standing(*part_x_), 1u);
}

TEST_F(SharedDeviceTest, AFullQueueOfOneAxisAffectsThatAxisOnly) {
  start();
  x_.set_full(true);
  const std::size_t had = y_.blocks().size();
  ASSERT_TRUE(becomes_true([&] { return y_.blocks().size() > had + 10; }));
  x_.set_full(false);
  const std::size_t before = x_.blocks().size();
  ASSERT_TRUE(becomes_true([&] { return x_.blocks().size() > before; }));
  const SampleBlock after = x_.blocks()[before], last = x_.blocks()[before - 1];
  EXPECT_GE(after.lost, 10u);
  EXPECT_EQ(after.time_ns[0] - last.time_ns[0],
            1'000'000 * (1 + static_cast<std::int64_t>(after.lost)));
  EXPECT_EQ(part_x_->status().dropped, after.lost);
  EXPECT_EQ(part_x_->status().lost, after.lost);
  EXPECT_EQ(part_y_->status().lost, 0u);
  for (const auto& block : y_.blocks()) EXPECT_EQ(block.lost, 0u);
}

TEST_F(SharedDeviceTest, ContinuesForTheOtherAxisAndClosesWithTheLast) {
  start();
  part_x_.reset();
  const std::size_t had = y_.blocks().size(), x = x_.blocks().size();
  ASSERT_TRUE(becomes_true([&] { return y_.blocks().size() > had + 5; }));
  EXPECT_EQ(x_.blocks().size(), x);
  EXPECT_EQ(state_->destroyed, 0);
  part_y_->request_stop();
  part_y_->stop();
  EXPECT_EQ(state_->destroyed, 1);
  EXPECT_EQ(part_y_->status().state, "closed");
}

TEST(SameProbes, AreThoseThatBothAxesHave) {
  AxisConfig x, y;
  x.devices.resize(1);
  y.devices.resize(1);
  x.devices[0].name = y.devices[0].name = "t7";
  x.devices[0].part = {{"A", "A"}, {"encoder", "encoder"}};
  y.devices[0].part = {{"A_Y", "A"}, {"encoder_Y", "encoder"}};
  EXPECT_EQ(shared_probes_device(x, y), "");
  y.devices[0].part["A"] = "B";
  EXPECT_EQ(shared_probes_device(x, y), "t7");
  y.devices[0].name = "u6";
  EXPECT_EQ(shared_probes_device(x, y), "");
}

}  // namespace
}  // namespace mdof::daemon
