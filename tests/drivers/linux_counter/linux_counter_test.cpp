#include "drivers/linux_counter/linux_counter.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <optional>

#include "drivers/clock/monotonic.h"
#include "drivers/linux_counter/configure.h"
#include "drivers/linux_counter/protocol.h"
#include "drivers/linux_counter/simulated_linux_counter.h"
#include "tests/drivers/collect.h"

namespace mdof::drivers {
namespace {

TEST(CountUnwrap, WrapsInBothDirectionsAtAnyCeiling) {
  for (const std::uint64_t ceiling :
       {std::uint64_t{65535}, std::uint64_t{9999}, std::uint64_t{0xFFFFFFFF}, UINT64_MAX}) {
    CountUnwrap unwrap(ceiling);
    EXPECT_EQ(unwrap(3), 3);
    EXPECT_EQ(unwrap(ceiling), -1) << ceiling;  // 3 + 1 steps backward
    EXPECT_EQ(unwrap(ceiling - 99), -100);
    EXPECT_EQ(unwrap(50), 50);
  }
}

TEST(CountUnwrap, FollowsManyWraps) {
  CountUnwrap unwrap(65535);
  std::int64_t position = 0;
  for (int i = 0; i < 1000; ++i) {
    position += 30'000;
    ASSERT_EQ(unwrap(static_cast<std::uint64_t>(position) & 0xFFFF), position);
  }
  for (int i = 0; i < 2000; ++i) {
    position -= 32'000;
    ASSERT_EQ(unwrap(static_cast<std::uint64_t>(position) & 0xFFFF), position);
  }
}

TEST(CountUnwrap, FirstReadingIsSigned) {
  EXPECT_EQ(CountUnwrap(65535)(65530), -6);
  EXPECT_EQ(CountUnwrap(9999)(4000), 4000);
  EXPECT_EQ(CountUnwrap(9999)(6000), -4000);
  EXPECT_EQ(CountUnwrap(9999)(10'000), std::nullopt);
}

TEST(CheckCount, ErrorStatesFileAndRequiredText) {
  CountFiles good{"quadrature x4", "normal", "1", "65535", "0"};
  EXPECT_EQ(check_count(good, "count0", "quadrature x4", 0), 65535u);
  EXPECT_EQ(check_count({}, "count0", "", 65535), 65535u);
  // According to the kernel's ABI, only these two modes continue to count at a limit.
  CountFiles modulo = good;
  modulo.count_mode = "modulo-n";
  EXPECT_EQ(check_count(modulo, "count0", "quadrature x4", 0), 65535u);
  const auto refused = [&](auto change, const std::string& function = "") {
    CountFiles files = good;
    change(files);
    const auto result = check_count(files, "count0", function, 0);
    return result ? "accepted" : result.error().message;
  };
  const std::pair<std::string, std::string> cases[] = {
      {refused([](auto& f) { f.enable = "0"; }), "echo 1 > count0/enable"},
      {refused([](auto& f) { f.function = "increase"; }, "quadrature x4"),
       "echo \"quadrature x4\" > count0/function"},
      {refused([](auto& f) { f.function.reset(); }, "quadrature x4"), "does not exist"},
      {refused([](auto& f) { f.count_mode = "range limit"; }), "stops counting at a limit"},
      {refused([](auto& f) { f.floor = "5"; }), "echo 0 > count0/floor"},
      {refused([](auto& f) { f.ceiling.reset(); }), "set the key \"ceiling\" in the configuration"},
      {refused([](auto& f) { f.ceiling = "0"; }), "is not a whole number above 0"},
      {refused([](auto& f) { f.ceiling = "many"; }), "is not a whole number above 0"},
  };
  for (const auto& [message, part] : cases)
    EXPECT_NE(message.find(part), std::string::npos) << message;
}

TEST(SysfsInteger, ParsesSignedAndUnsignedAndRefusesOthers) {
  EXPECT_EQ(parse_sysfs_integer("-5"), -5);
  EXPECT_EQ(parse_sysfs_integer("18446744073709551615"), -1);
  EXPECT_EQ(parse_sysfs_integer("-9223372036854775808"), INT64_MIN);
  for (const char* text : {"", "-", "1 ", "0x1", "1.5", "18446744073709551616", "+1"})
    EXPECT_EQ(parse_sysfs_integer(text), std::nullopt) << text;
}

TEST(SysfsError, ErrorNamesTheRemedy) {
  EXPECT_NE(sysfs_error(EBUSY).find("another program"), std::string::npos);
  EXPECT_NE(sysfs_error(EIO).find("check the wires"), std::string::npos);
  EXPECT_NE(sysfs_error(ENODEV).find("gone"), std::string::npos);
  EXPECT_NE(sysfs_error(EACCES).find("udev rule"), std::string::npos);
  EXPECT_NE(sysfs_write_error(EACCES).find("60-mdof.rules"), std::string::npos);
  EXPECT_NE(sysfs_write_error(EROFS).find("ReadWritePaths=-/sys/devices"), std::string::npos);
  EXPECT_EQ(sysfs_write_error(EIO), sysfs_error(EIO));
}

class LinuxCounter : public testing::Test {
 protected:
  LinuxCounter() {
    options_.sysfs_root = root_.string();
    options_.rate_hz = 1000;
    options_.function = "quadrature x4";
    options_.channels = {{"encoder", "count0", -0.5, "mdofd.toml:5: channel"}};
    auto tree = make_counter_tree(root_, 65535);
    EXPECT_TRUE(tree);
    tree_.emplace(*tree);
    options_.read = tree_->reads();
  }
  ~LinuxCounter() override { std::filesystem::remove_all(root_); }
  std::string refusal() {
    const auto status = make_linux_counter("scale", options_)->open();
    return status ? "opened" : status.error().message;
  }
  void expect_refused(const std::string& part) {
    const std::string message = refusal();
    EXPECT_NE(message.find(part), std::string::npos) << message;
  }
  std::filesystem::path root_ = std::filesystem::temp_directory_path() /
                                ("mdof_linux_counter_test." + std::to_string(::getpid()));
  std::optional<SimulatedTree> tree_;
  LinuxCounterOptions options_;
};

TEST_F(LinuxCounter, PollsAtItsRateAndUnwraps) {
  const auto driver = make_linux_counter("scale", options_);
  const std::int64_t before_ns = monotonic_ns();
  ASSERT_TRUE(driver->open());
  EXPECT_EQ(driver->info().channels, (std::vector<Channel>{{"encoder", Unit::um}}));
  EXPECT_NE(driver->info().description.find("simulated-counter"), std::string::npos);
  Collected all = collect(*driver, 50);
  ASSERT_EQ(all.error, "");
  EXPECT_EQ(all.scans[0][0], 0);
  expect_growing(all.time_ns);
  // The driver either makes a poll or counts it as lost. The last poll may be late.
  const double passed_ms = static_cast<double>(all.time_ns.back() - before_ns) / 1e6;
  const auto polls = static_cast<double>(all.time_ns.size() + all.lost);
  EXPECT_LE(polls, passed_ms + 2);
  EXPECT_GE(polls, passed_ms - 200);
  EXPECT_LE(all.time_ns.back(), monotonic_ns());
  for (const auto& [raw, um] : {std::pair{"65530", 3.0}, {"40000", 12768.0}, {"20000", 22768.0}}) {
    ASSERT_TRUE(tree_->set("count0/count", raw));
    collect(*driver, 1);  // the driver may have read this before the change
    EXPECT_EQ(collect(*driver, 1).scans.at(0).at(0), um);
  }
}

TEST_F(LinuxCounter, ReadReturnsInTimeAtALowRate) {
  options_.rate_hz = 0.1;
  const auto driver = make_linux_counter("scale", options_);
  ASSERT_TRUE(driver->open());
  EXPECT_EQ(collect(*driver, 1).scans.size(), 1u);
  const std::int64_t before_ns = monotonic_ns();
  SampleBlock block;
  ASSERT_TRUE(driver->read(block, std::chrono::milliseconds(30)));
  EXPECT_EQ(block.scans(), 0u);
  EXPECT_LT(monotonic_ns() - before_ns, 2'000'000'000);
}

TEST_F(LinuxCounter, AFewFailedReadsLoseScansAndTheNextIsSuspect) {
  const auto driver = make_linux_counter("scale", options_);
  ASSERT_TRUE(driver->open());
  collect(*driver, 3);
  tree_->fail_reads(EBUSY, SysfsPoller::kFailuresAllowed);
  const Collected all = collect(*driver, 20);
  ASSERT_EQ(all.error, "");
  EXPECT_GE(all.lost, 4u);
  EXPECT_EQ(all.first_quality(0), Quality::suspect);
}

// While the counter was absent, it is unknown how far the axis moved.
TEST_F(LinuxCounter, DatumIsLostAfterAnAbsence) {
  const auto driver = make_linux_counter("scale", options_);
  ASSERT_TRUE(driver->open());
  EXPECT_EQ(collect(*driver, 3).first_quality(2), Quality::good);
  EXPECT_EQ(driver->info().datum_lost, "");
  tree_->fail_reads(ENODEV);
  EXPECT_NE(collect(*driver, 20).error, "");
  tree_->fail_reads(0, 0);
  ASSERT_TRUE(driver->open());
  EXPECT_EQ(collect(*driver, 3).first_quality(2), Quality::suspect);
  EXPECT_NE(driver->info().datum_lost, "");
}

TEST_F(LinuxCounter, ManyFailuresAreAnErrorUntilReopened) {
  const auto driver = make_linux_counter("scale", options_);
  for (const int error : {EBUSY, EIO, ENODEV}) {
    ASSERT_TRUE(driver->open());
    tree_->fail_reads(error);
    const Collected all = collect(*driver, 20);
    EXPECT_NE(all.error.find("5 readings in a row failed"), std::string::npos) << all.error;
    EXPECT_NE(all.error.find("count0/count: " + sysfs_error(error)), std::string::npos);
    SampleBlock block;
    EXPECT_FALSE(driver->read(block, std::chrono::milliseconds(1)));
    tree_->fail_reads(0, 0);
  }
  ASSERT_TRUE(driver->open());
  EXPECT_EQ(collect(*driver, 5).error, "");
}

TEST_F(LinuxCounter, ReportsTheKernelsEio) {
  // Reading /proc/self/mem at address 0 gives EIO, because no memory is mapped there.
  tree_->remove("count0/count");
  std::filesystem::create_symlink("/proc/self/mem",
                                  root_ / "bus/counter/devices/counter0/count0/count");
  options_.read = sysfs_pread();
  const auto driver = make_linux_counter("scale", options_);
  ASSERT_TRUE(driver->open());
  EXPECT_NE(collect(*driver, 5).error.find("check the wires"), std::string::npos);
}

TEST_F(LinuxCounter, RefusesInvalidCounts) {
  const auto driver = make_linux_counter("scale", options_);
  for (const char* text : {"banana", "65536", ""}) {
    ASSERT_TRUE(driver->open());
    ASSERT_TRUE(tree_->set("count0/count", text));
    EXPECT_NE(collect(*driver, 50).error.find("5 readings in a row"), std::string::npos) << text;
    ASSERT_TRUE(tree_->set("count0/count", "0"));
  }
}

TEST_F(LinuxCounter, ReportsMissingFilesAndInputs) {
  tree_->remove("count0/count");
  expect_refused("count0/count: No such file");
  options_.channels[0].input = "count7";
  expect_refused(
      "mdofd.toml:5: channel: the device has no input \"count7\"; the inputs of the device are "
      "count0");
  options_.chip = "104-quad-8";
  expect_refused("is \"simulated-counter\", but the configuration has chip = \"104-quad-8\"");
  options_.device = "counter3";
  expect_refused("to list the counters, run: ls ");
}

std::string configured(const std::string& toml) {
  auto table = TomlTable::parse(toml, "mdofd.toml");
  if (!table) return table.error().message;
  DriverContext context;
  context.name = "scale";
  const auto spec = configure_linux_counter(*table, context);
  if (!spec) return spec.error().message;
  const auto driver = spec->make();
  return (*driver)->info().driver;
}

TEST(LinuxCounterConfiguration, ReadsKeysAndReportsErrors) {
  const std::string channel =
      "\n[[channel]]\nid = \"encoder\"\ninput = \"count0\"\num_per_count = 0.05\n";
  EXPECT_EQ(configured("device = \"counter1\"\nchip = \"x\"\nfunction = \"quadrature x4\"\n"
                       "ceiling = 65535\nrate_hz = 100\nsysfs_root = \"/tmp\"" +
                       channel),
            "linux_counter");
  const std::pair<std::string, const char*> wrong[] = {
      {"", "channel: is missing"},
      {"rate_hz = 1e6" + channel, "mdofd.toml:1: rate_hz: must be from 0.1 to 5000"},
      {"ceiling = -1" + channel, "ceiling: must be"},
      {"devise = \"counter1\"" + channel, "devise"},
      {"[[channel]]\nid = \"encoder\"\ninput = \"count0\"", "needs um_per_count"},
  };
  for (const auto& [toml, message] : wrong)
    EXPECT_NE(configured(toml).find(message), std::string::npos) << configured(toml);
}

}  // namespace
}  // namespace mdof::drivers
