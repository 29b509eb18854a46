// The reference mark of an encoder that a QSB counts.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <thread>

#include "drivers/clock/monotonic.h"
#include "drivers/qsb/configure.h"
#include "drivers/qsb/qsb.h"
#include "drivers/qsb/simulated_qsb.h"
#include "tests/drivers/collect.h"
#include "tests/drivers/served_line.h"

namespace mdof::drivers {
namespace {

constexpr double kMark = 1000;  // position of the mark in counts; 0 is the position at switch-on

class QsbIndex : public testing::Test {
 protected:
  void serve(SimulatedQsb::Faults faults = {}, bool inverted = false, double next_mark = kNaN) {
    device_.emplace([this](std::size_t, std::int64_t) { return position_.load(); },
                    SimulatedQsb::Options{faults});
    device_->set_mark({kMark, inverted, next_mark});
    served_.emplace(*device_);
    options_.port = served_->path();
    options_.channel = {"encoder", "count", 0.5, "", std::nullopt, 12.5};
    options_.long_at_mark = std::chrono::seconds(30);  // sufficient also on a busy machine
  }
  void open() {
    driver_.emplace("scale", options_);
    const auto opened = driver_->open();
    ASSERT_TRUE(opened) << opened.error().message;
  }
  // The last reading after the axis has stopped at a position.
  struct Shown {
    double um;
    Quality quality;
    std::string error;
  };
  Shown at(double position) {
    position_ = position;
    const std::int64_t set_ns = monotonic_ns();
    Collected all;
    do {  // on a loaded computer, older lines may still arrive
      all = collect(*driver_, 40);
    } while (all.error.empty() && !all.scans.empty() && all.time_ns.back() < set_ns + 50'000'000);
    if (all.scans.empty()) return {kNaN, Quality::missing, all.error};
    return {all.scans.back()[0], all.first_quality(all.scans.size() - 1), all.error};
  }
  void expect_shown(double position, double um, Quality quality = Quality::good) {
    const Shown shown = at(position);
    EXPECT_EQ(shown.um, um) << position << " " << shown.error;
    EXPECT_EQ(shown.quality, quality) << position;
  }

  std::atomic<double> position_{200};
  std::optional<SimulatedQsb> device_;
  std::optional<ServedLine> served_;
  QsbOptions options_;
  std::optional<Qsb> driver_;
};

TEST_F(QsbIndex, PositionsAreCountedFromThePassedMark) {
  serve();
  open();
  expect_shown(200, 100);
  expect_shown(990, 495);
  EXPECT_EQ(driver_->marks_passed(), 0);
  EXPECT_EQ(at(1004).quality, Quality::missing);  // the count is still too near to the mark
  EXPECT_EQ(driver_->marks_passed(), 0);
  expect_shown(1100, 50);
  EXPECT_EQ(driver_->marks_passed(), 1);
  EXPECT_EQ(driver_->info().datum_lost, "");
  expect_shown(0, -500);
  expect_shown(1300, 150);
  EXPECT_EQ(driver_->marks_passed(), 1);
}

TEST_F(QsbIndex, MarkStartsANewBlock) {
  serve();
  open();
  at(900);
  position_ = 1400;
  std::this_thread::sleep_for(std::chrono::milliseconds(30));
  position_ = 1500;
  SampleBlock block;
  bool passed = false;
  for (int i = 0; i < 200 && !passed; ++i) {
    ASSERT_TRUE(driver_->read(block, std::chrono::milliseconds(20)));
    passed = driver_->marks_passed() == 1;
    for (std::size_t k = 0; k < block.scans(); ++k) {
      const double um = block.value[0][k];
      EXPECT_TRUE(passed ? um == 200 || um == 250 : um == 450 || std::isnan(um)) << um;
    }
  }
  EXPECT_TRUE(passed);
}

// After the first mark, the driver switches the loading of the counter off. Then neither the next
// mark nor lost counts shift the positions.
TEST_F(QsbIndex, LoadsNothingAfterTheMark) {
  serve({}, false, 1200);
  open();
  at(990);
  expect_shown(1100, 50);
  expect_shown(1300, 150);
  expect_shown(1100, 50);
}

TEST_F(QsbIndex, DatumRemainsAfterReopening) {
  serve();
  open();
  at(990);
  expect_shown(1100, 50);
  ASSERT_TRUE(driver_->open());
  expect_shown(1200, 100);
  EXPECT_EQ(driver_->marks_passed(), 1);
}

TEST_F(QsbIndex, FindsAMarkThatWasPassedWhileClosed) {
  serve();
  open();
  expect_shown(990, 495);
  ASSERT_TRUE(driver_->open());
  expect_shown(1500, 250);
  EXPECT_EQ(driver_->marks_passed(), 1);
}

// The counter may have a count from another program or from an earlier start of mdofd. Such a
// count is not a datum.
TEST_F(QsbIndex, NewProgramMustPassTheMarkAgain) {
  serve();
  // Each start adds a quarter of the range of 32 bits to the count.
  for (int start = 0; start < 4; ++start) {
    position_ = 0;
    open();
    EXPECT_EQ(driver_->marks_passed(), 0);
    at(500);
    EXPECT_EQ(driver_->marks_passed(), 0);
    expect_shown(1100, 50);
    EXPECT_EQ(driver_->marks_passed(), 1);
    ASSERT_TRUE(driver_->open());
    expect_shown(900, -50);
  }
}

TEST_F(QsbIndex, SuspectAfterAResetUntilTheMarkIsPassed) {
  serve({.reset_at = 150});
  open();
  at(990);
  expect_shown(1100, 50);
  EXPECT_NE(collect(*driver_, 1000).error.find("was reset during the stream"), std::string::npos);
  ASSERT_TRUE(driver_->open());
  expect_shown(1300, 100, Quality::suspect);  // the reset has set a count of 1100 to 0
  EXPECT_NE(driver_->info().datum_lost, "");
  EXPECT_EQ(driver_->info().datum_remedy, Remedy::pass_reference_mark);
  expect_shown(900, -50);
  EXPECT_EQ(driver_->marks_passed(), 2);
  EXPECT_EQ(driver_->info().datum_lost, "");
}

TEST_F(QsbIndex, DamagedLineIsNotTheMark) {
  serve({.first_far_line = 20});
  open();
  const Collected all = collect(*driver_, 60);
  ASSERT_EQ(all.error, "");
  for (const auto& scan : all.scans) EXPECT_EQ(scan[0], 100);
  EXPECT_EQ(driver_->malformed_lines(), 1u);
  EXPECT_EQ(driver_->marks_passed(), 0);
}

TEST_F(QsbIndex, ManyImpossibleCountsLoseTheDatum) {
  serve({.first_far_line = 20, .far_line_count = 12});
  open();
  EXPECT_NE(collect(*driver_, 100).error.find("11 malformed lines"), std::string::npos);
  ASSERT_TRUE(driver_->open());
  expect_shown(300, 150, Quality::suspect);
  EXPECT_NE(driver_->info().datum_lost, "");
  expect_shown(1100, 50);
}

TEST_F(QsbIndex, ReportsWrongPolarityWithoutAPosition) {
  serve({}, true);
  options_.long_at_mark = std::chrono::milliseconds(100);
  open();
  EXPECT_EQ(at(400).quality, Quality::missing);
  EXPECT_EQ(at(1500).quality, Quality::missing);
  EXPECT_EQ(driver_->marks_passed(), 0);
  std::this_thread::sleep_for(std::chrono::milliseconds(150));
  EXPECT_NE(driver_->info().datum_lost.find("index_inverted"), std::string::npos);
  EXPECT_EQ(driver_->info().datum_remedy, Remedy::move_off_reference_mark);
  options_.index_inverted = true;
  options_.long_at_mark = std::chrono::seconds(30);
  position_ = 0;
  open();
  at(400);
  expect_shown(1500, 250);
}

std::string configured(const std::string& keys) {
  auto table = TomlTable::parse(
      "port = \"/dev/ttyUSB0\"\n[[channel]]\nid = \"encoder\"\ninput = \"count\"\n"
      "um_per_count = 0.05\n" +
          keys,
      "mdofd.toml");
  if (!table) return table.error().message;
  DriverContext context;
  context.name = "scale";
  const auto spec = configure_qsb(*table, context);
  if (!spec) return spec.error().message;
  return spec->encoder.index_mm ? "index at " + std::to_string(*spec->encoder.index_mm) : "none";
}

TEST(QsbIndexConfiguration, ReadsKeysAndReportsErrors) {
  EXPECT_EQ(configured(""), "none");
  EXPECT_EQ(configured("index_mm = 12.5\nindex_inverted = true"), "index at 12.500000");
  const std::pair<const char*, const char*> wrong[] = {
      {"index_mm = 12.5\noffset_mm = 3",
       "mdofd.toml:6: channel[1].index_mm: contradicts offset_mm"},
      {"index_mm = 1e9", "mdofd.toml:6: channel[1].index_mm: must be a position"},
      {"index_mm = nan", "index_mm: must be a finite number"},
      {"index_inverted = true", "index_inverted: needs a reference mark"},
  };
  for (const auto& [keys, message] : wrong)
    EXPECT_NE(configured(keys).find(message), std::string::npos) << configured(keys);
}

}  // namespace
}  // namespace mdof::drivers
