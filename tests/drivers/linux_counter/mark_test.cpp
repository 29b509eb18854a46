// The reference mark of an encoder that a 104-QUAD-8 counts.
#include "drivers/linux_counter/mark.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <optional>

#include "drivers/linux_counter/configure.h"
#include "drivers/linux_counter/linux_counter.h"
#include "drivers/linux_counter/simulated_quad8.h"
#include "tests/drivers/collect.h"

namespace mdof::drivers {
namespace {

constexpr std::int64_t kMark = 5000;

class Quad8Index : public testing::Test {
 protected:
  Quad8Index() {
    auto device = SimulatedQuad8::make(root_, kMark);
    EXPECT_TRUE(device);
    device_.emplace(*device);
    options_.sysfs_root = root_.string();
    options_.chip = kQuad8;
    options_.rate_hz = 1000;
    options_.channels = {{"encoder", "count0", -0.5, "", std::nullopt, 12.5}};
    options_.read = device_->tree().reads();
    driver_ = make_linux_counter("scale", options_);
  }
  ~Quad8Index() override { std::filesystem::remove_all(root_); }

  struct Shown {
    double um;
    Quality quality;
    std::string error;
  };
  Shown at(std::int64_t position) {
    EXPECT_TRUE(device_->move_to(position));
    const Collected all = collect(*driver_, 30);
    if (all.scans.empty()) return {kNaN, Quality::missing, all.error};
    return {all.scans.back()[0], all.first_quality(all.scans.size() - 1), all.error};
  }
  void expect_shown(std::int64_t position, double um, Quality quality = Quality::good) {
    const Shown shown = at(position);
    EXPECT_EQ(shown.um, um) << position << " " << shown.error;
    EXPECT_EQ(shown.quality, quality) << position;
  }
  std::string file(const std::string& name) const {
    const auto path = root_ / "bus/counter/devices/counter0" / name;
    return read_sysfs(path.string()).value().value_or("");
  }
  std::string refusal() {
    const auto status = driver_->open();
    return status ? "opened" : status.error().message;
  }

  std::filesystem::path root_ =
      std::filesystem::temp_directory_path() / ("mdof_quad8_test." + std::to_string(::getpid()));
  std::optional<SimulatedQuad8> device_;
  LinuxCounterOptions options_;
  std::unique_ptr<SysfsPoller> driver_;
};

TEST_F(Quad8Index, PositionsAreCountedFromThePassedMark) {
  ASSERT_TRUE(device_->move_to(300));
  ASSERT_EQ(refusal(), "opened");
  // drivers/counter/104-quad-8.c: quad8_count_preset_write accepts 24 bits.
  // quad8_count_preset_enable_write accepts a boolean; if it is true, the index loads the preset.
  EXPECT_EQ(file("count0/preset"), std::to_string(300 + (1 << 22)));
  EXPECT_EQ(file("count0/preset_enable"), "1");
  expect_shown(4990, -2495);
  EXPECT_EQ(at(5010).quality, Quality::missing);  // the count is still too near to the mark
  EXPECT_EQ(driver_->marks_passed(), 0);
  expect_shown(5100, -50);
  EXPECT_EQ(driver_->marks_passed(), 1);
  EXPECT_EQ(file("count0/preset_enable"), "0");
  expect_shown(4000, 500);
  expect_shown(2'000'000, -997'500);
  expect_shown(5100, -50);
  EXPECT_EQ(driver_->marks_passed(), 1);
}

TEST_F(Quad8Index, MarkStartsANewBlock) {
  ASSERT_EQ(refusal(), "opened");
  at(4000);
  ASSERT_TRUE(device_->move_to(5400));
  SampleBlock block;
  bool passed = false;
  for (int i = 0; i < 200 && !passed; ++i) {
    ASSERT_TRUE(driver_->read(block, std::chrono::milliseconds(20)));
    passed = driver_->marks_passed() == 1;
    for (const double um : block.value[0])
      EXPECT_TRUE(passed ? um == -200 : um == -2000 || std::isnan(um)) << um;
  }
  EXPECT_TRUE(passed);
}

TEST_F(Quad8Index, ArmsAgainFarFromTheFirstPosition) {
  ASSERT_TRUE(device_->move_to(8'000'000));
  ASSERT_EQ(refusal(), "opened");
  for (std::int64_t position = 7'600'000; position > 0; position -= 400'000)
    expect_shown(position, -0.5 * static_cast<double>(position));
  EXPECT_NE(file("count0/preset"), std::to_string((8'000'000 + (1 << 22)) & 0xFFFFFF));
  expect_shown(-5000, 5000);
  EXPECT_EQ(driver_->marks_passed(), 1);
}

TEST_F(Quad8Index, ImpossibleCountIsAnErrorThenSuspect) {
  ASSERT_EQ(refusal(), "opened");
  at(100);
  ASSERT_TRUE(device_->tree().set("count0/count", "9000000"));
  EXPECT_NE(
      collect(*driver_, 50).error.find("cannot result from a motion or from the reference mark"),
      std::string::npos);
  ASSERT_TRUE(device_->lose_power());
  ASSERT_EQ(refusal(), "opened");
  expect_shown(300, -100, Quality::suspect);
  EXPECT_NE(driver_->info().datum_lost, "");
  EXPECT_EQ(driver_->info().datum_remedy, Remedy::pass_reference_mark);
  EXPECT_EQ(driver_->marks_passed(), 0);
  expect_shown(5100, -50);
  EXPECT_EQ(driver_->marks_passed(), 1);
  EXPECT_EQ(driver_->info().datum_lost, "");
}

TEST_F(Quad8Index, ReportsMissingSetup) {
  const auto expect_refused = [&](const char* name, const char* is, const std::string& part) {
    const std::string was = file(name);
    ASSERT_TRUE(device_->tree().set(name, is));
    const std::string message = refusal();
    EXPECT_NE(message.find(part), std::string::npos) << message;
    ASSERT_TRUE(device_->tree().set(name, was));
  };
  expect_refused("count0/ceiling", "33554431", "the kernel is too old");
  expect_refused("signal16/synchronous_mode", "non-synchronous",
                 "not one count wide; set the value with a udev rule that runs: echo synchronous");
  device_->tree().remove("count0/preset_enable");
  EXPECT_NE(refusal().find("preset_enable"), std::string::npos);
}

std::string configured(const std::string& keys) {
  auto table = TomlTable::parse(keys +
                                    "\n[[channel]]\nid = \"encoder\"\ninput = \"count0\"\n"
                                    "um_per_count = 0.05\nindex_mm = -3\n",
                                "mdofd.toml");
  if (!table) return table.error().message;
  DriverContext context;
  context.name = "scale";
  const auto spec = configure_linux_counter(*table, context);
  return spec ? std::to_string(*spec->encoder.index_mm) : spec.error().message;
}

TEST(Quad8Configuration, IndexNeedsA104Quad8) {
  EXPECT_EQ(configured("chip = \"104-quad-8\""), "-3.000000");
  for (const char* other : {"", "chip = \"ti-eqep\""})
    EXPECT_NE(configured(other).find("channel[1].index_mm: needs chip = \"104-quad-8\""),
              std::string::npos)
        << configured(other);
}

}  // namespace
}  // namespace mdof::drivers
