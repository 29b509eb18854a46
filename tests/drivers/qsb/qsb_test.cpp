#include "drivers/qsb/qsb.h"

#include <gtest/gtest.h>

#include <cmath>

#include "drivers/qsb/configure.h"
#include "drivers/qsb/simulated_qsb.h"
#include "tests/drivers/collect.h"
#include "tests/drivers/served_device.h"
#include "tests/drivers/served_line.h"

namespace mdof::drivers {
namespace {

double ramp(std::size_t, std::int64_t t_ns) {
  return -1000 + static_cast<double>(t_ns % 1'000'000'000'000) * 1e-6;  // 1 count per millisecond
}
double still(std::size_t, std::int64_t) {
  return -5;
}

QsbOptions options_for_test(const ServedLine& served) {
  QsbOptions options;
  options.port = served.path();
  options.channel = {"encoder", "count", 0.5, ""};
  return options;
}

TEST(Qsb, StreamsWithTheDevicesTimes) {
  SimulatedQsb device(ramp, {.faults = {.streams_at_start = true}});
  const ServedLine served(device);
  Qsb driver("scale", options_for_test(served));
  const auto status = driver.open();
  ASSERT_TRUE(status) << status.error().message;
  EXPECT_NE(driver.info().description.find("QSB-S 00001, firmware 1"), std::string::npos);
  const Collected all = collect(driver, 100);
  ASSERT_EQ(all.error, "");
  EXPECT_EQ(all.lost, 0u);
  EXPECT_EQ(driver.malformed_lines(), 0u);
  expect_growing(all.time_ns);
  for (std::size_t i = 2; i < all.scans.size(); ++i) {
    // 1.953125 counts per line at 0.5 µm per count; the count is rounded.
    EXPECT_NEAR(all.scans[i][0] - all.scans[i - 1][0], 0.9765625, 0.51) << i;
    // The clock has not settled yet. Until then, the rate of its times may differ by 20 % from the
    // true rate.
    EXPECT_NEAR(static_cast<double>(all.time_ns[i] - all.time_ns[i - 1]), qsb::kTick_ns,
                0.2 * qsb::kTick_ns + 2);
  }
}

// The manual also states a tick of 1/256 s. The count shows the true time of each line. When the
// driver has measured the tick, the line of the clock must not remain fitted to the wrong one.
TEST(Qsb, TimesAreCorrectAfterATickOfAnotherLengthWasMeasured) {
  SimulatedQsb device(ramp, {.faults = {.tick_ns = 1e9 / 256}});
  const ServedLine served(device);
  Qsb driver("scale", options_for_test(served));
  ASSERT_TRUE(driver.open());
  const Collected all = collect(driver, 2 * 256);  // 2 s
  ASSERT_EQ(all.error, "");
  EXPECT_FALSE(driver.clock()->doubtful());
  // 0.5 um for each count, one count for each ms; the first 0.8 s contain the correction.
  const double passed_ms = (all.scans[500][0] - all.scans[200][0]) / 0.5;
  EXPECT_NEAR(static_cast<double>(all.time_ns[500] - all.time_ns[200]) * 1e-6, passed_ms, 100);
}

TEST(Qsb, CountContinuesAfterReopening) {
  SimulatedQsb device(still, {});
  const ServedLine served(device);
  Qsb driver("scale", options_for_test(served));
  std::int64_t last_ns = 0;
  for (int round = 0; round < 2; ++round) {
    ASSERT_TRUE(driver.open());
    const Collected all = collect(driver, 5);
    EXPECT_EQ(all.scans.at(0)[0], -2.5);
    EXPECT_EQ(all.first_quality(0), Quality::good);
    EXPECT_EQ(driver.info().datum_lost, "");
    EXPECT_GT(all.time_ns.at(0), last_ns);
    last_ns = all.time_ns.back();
  }
}

TEST(Qsb, ResetDuringTheStreamIsAnErrorAndRestarts) {
  SimulatedQsb device(still, {.faults = {.reset_at = 20}});
  const ServedLine served(device);
  Qsb driver("scale", options_for_test(served));
  ASSERT_TRUE(driver.open());
  const Collected all = collect(driver, 1000);
  EXPECT_GE(all.scans.size(), 20u);  // the lines before the reset are valid
  for (std::size_t i = 0; i < all.scans.size(); ++i) {
    EXPECT_EQ(all.scans[i][0], -2.5);
    EXPECT_EQ(all.first_quality(i), Quality::good);
  }
  EXPECT_NE(all.error.find("was reset during the stream (\"QSB-S  0E!\")"), std::string::npos)
      << all.error;
  SampleBlock block;
  EXPECT_FALSE(driver.read(block, std::chrono::milliseconds(1)));
  ASSERT_TRUE(driver.open());
  EXPECT_NE(driver.info().description.find("lost power"), std::string::npos);
  const Collected anew = collect(driver, 1);
  EXPECT_EQ(anew.scans.at(0)[0], 0);
  // A count of 0 after the reset is not a position.
  EXPECT_EQ(anew.first_quality(0), Quality::suspect);
  EXPECT_NE(driver.info().datum_lost.find("count restarted at 0"), std::string::npos);
}

TEST(Qsb, TruncatedLineIsCountedAndItsScansAreLost) {
  SimulatedQsb device(still, {.faults = {.cut_at = 10}});
  const ServedLine served(device);
  Qsb driver("scale", options_for_test(served));
  ASSERT_TRUE(driver.open());
  const Collected all = collect(driver, 50);
  ASSERT_EQ(all.error, "");
  EXPECT_EQ(driver.malformed_lines(), 1u);
  // Two lines are lost: the truncated line and the line that follows it without a line end.
  EXPECT_EQ(all.lost, 2u);
}

TEST(Qsb, StepOfTheTimeStampCountsLostLines) {
  SimulatedQsb device(still, {.faults = {.jump_at = 10, .jump_ticks = 7}});
  const ServedLine served(device);
  Qsb driver("scale", options_for_test(served));
  ASSERT_TRUE(driver.open());
  const Collected all = collect(driver, 50);
  ASSERT_EQ(all.error, "");
  EXPECT_EQ(all.lost, 7u);
  expect_growing(all.time_ns);
}

TEST(Qsb, ImpossibleStampIsAnError) {
  for (const std::uint32_t jump : {100'000u, 0xFFFFFF00u}) {
    SimulatedQsb device(still, {.faults = {.jump_at = 10, .jump_ticks = jump}});
    const ServedLine served(device);
    Qsb driver("scale", options_for_test(served));
    ASSERT_TRUE(driver.open());
    const Collected all = collect(driver, 500);
    EXPECT_NE(all.error.find("time stamps jumped by"), std::string::npos) << all.error;
  }
}

TEST(Qsb, ReportsRepliesEAndX) {
  for (const auto& [faults, text] : {std::pair{SimulatedQsb::Faults{.refuse = qsb::kInterval},
                                               "command W0C00000001 was refused (reply e)"},
                                     std::pair{SimulatedQsb::Faults{.unsupported = qsb::kMdr0},
                                               "command W0300000003 is not supported (reply x)"}}) {
    SimulatedQsb device(still, {.faults = faults});
    const ServedLine served(device);
    const auto status = Qsb("scale", options_for_test(served)).open();
    ASSERT_FALSE(status);
    EXPECT_NE(status.error().message.find(text), std::string::npos) << status.error().message;
    EXPECT_NE(status.error().message.find(served.path()), std::string::npos);
  }
}

TEST(Qsb, InvalidLinesAreAnErrorAfterTen) {
  SimulatedQsb device(still, {.faults = {.rubbish = true}});
  const ServedLine served(device);
  Qsb driver("scale", options_for_test(served));
  ASSERT_TRUE(driver.open());
  EXPECT_NE(collect(driver, 500).error.find("11 malformed lines in a row"), std::string::npos);
}

TEST(Qsb, SilenceIsAnError) {
  SimulatedQsb device(still, {.faults = {.silent_from = 5}});
  const ServedLine served(device);
  QsbOptions options = options_for_test(served);
  options.silence = std::chrono::milliseconds(300);
  Qsb driver("scale", options);
  ASSERT_TRUE(driver.open());
  const Collected all = collect(driver, 500);
  EXPECT_GE(all.scans.size(), 5u);
  EXPECT_NE(all.error.find("received no data for 300 ms"), std::string::npos) << all.error;
}

TEST(Qsb, RefusesAnotherDeviceOrNone) {
  SimulatedQsb device(still, {});
  const ServedLine served(device);
  QsbOptions options = options_for_test(served);
  options.serial = "00002";
  auto status = Qsb("scale", options).open();
  ASSERT_FALSE(status);
  EXPECT_NE(status.error().message.find("the serial number of the device is 00001"),
            std::string::npos);
  options.port = "/dev/no-such-port";
  status = Qsb("scale", options).open();
  ASSERT_FALSE(status);
  EXPECT_NE(status.error().message.find("does not exist"), std::string::npos);
}

TEST(Qsb, WorksBehindABridge) {
  SimulatedQsb device(still, {});
  const ServedDevice served(device);
  QsbOptions options;
  options.address = *parse_endpoint(served.address(), 0);
  options.channel = {"encoder", "count", 0.5, ""};
  Qsb driver("scale", options);
  const auto status = driver.open();
  ASSERT_TRUE(status) << status.error().message;
  EXPECT_EQ(collect(driver, 20).error, "");
}

TEST(Qsb, SilentBridgeIsAnError) {
  SimulatedQsb device(still, {.faults = {.mute = true}});
  const ServedDevice served(device);
  QsbOptions options;
  options.address = *parse_endpoint(served.address(), 0);
  const auto status = Qsb("scale", options).open();
  ASSERT_FALSE(status);
  EXPECT_NE(status.error().message.find("does not answer"), std::string::npos);
}

std::string configured(const std::string& toml) {
  auto table = TomlTable::parse(toml, "mdofd.toml");
  if (!table) return table.error().message;
  DriverContext context;
  context.name = "scale";
  const auto spec = configure_qsb(*table, context);
  if (!spec) return spec.error().message;
  const auto driver = spec->make();
  return (*driver)->info().driver;
}

TEST(QsbConfiguration, ReadsKeysAndReportsErrors) {
  const std::string channel =
      "\n[[channel]]\nid = \"encoder\"\ninput = \"count\"\num_per_count = 0.05\n";
  EXPECT_EQ(configured("port = \"/dev/ttyUSB0\"\nbaud = 115200\nrts = false\ncounting = \"x2\"\n"
                       "interval = 4\nserial = \"00001\"" +
                       channel),
            "qsb");
  EXPECT_EQ(configured("address = \"192.168.0.7:2217\"" + channel), "qsb");
  const std::pair<std::string, const char*> wrong[] = {
      {channel, "port: is missing"},
      {"port = \"a\"\naddress = \"b:1\"" + channel, "port: contradicts the key \"address\""},
      {"address = \"b\"" + channel, "is not an address"},
      {"port = \"a\"\nbaud = 3" + channel, "baud: must be a baud rate"},
      {"port = \"a\"\ninterval = 0" + channel, "interval: must be from 1 to 512"},
      {"port = \"a\"\ncounting = \"x3\"" + channel, "counting: must be"},
      {"port = \"a\"\n[[channel]]\nid = \"encoder\"\ninput = \"count0\"\num_per_count = 1",
       "no input \"count0\"; the inputs of the device are count"},
      {"port = \"a\"\n[[channel]]\nid = \"encoder\"\ninput = \"count\"", "needs um_per_count"},
  };
  for (const auto& [toml, message] : wrong)
    EXPECT_NE(configured(toml).find(message), std::string::npos) << configured(toml);
}

}  // namespace
}  // namespace mdof::drivers
