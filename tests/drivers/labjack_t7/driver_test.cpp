// The driver against the simulated T7 on real sockets.
#include "drivers/labjack_t7/labjack_t7.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <thread>
#include <tuple>

#include "drivers/labjack_t7/device.h"
#include "tests/drivers/modbus/hex.h"
#include "tests/drivers/served_device.h"

namespace mdof::drivers::labjack_t7 {
namespace {

using namespace std::chrono_literals;

constexpr double kRate_Hz = 4000;

// AIN0 rises 1 V a second from zero at the first call, AIN1 is beyond the range, the counter counts
// nanoseconds / 1000 from -40.
struct Truth {
  std::int64_t zero_ns =
      std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
  double operator()(std::size_t input, std::int64_t t_ns) const {
    if (input == 0) return static_cast<double>(t_ns - zero_ns) * 1e-9;
    if (input == 1) return 20;
    if (input == 4) return 0.9;
    if (input == 5) return 0.25;
    return input == Device::kCounterInput ? std::floor(static_cast<double>(t_ns - zero_ns) / 1000)
                                          : -1.5;
  }
};

std::vector<Input> inputs() {
  std::vector<Input> all = {{{"A", Unit::volt}, 0, 0},
                            {{"B", Unit::volt}, 1, 0},
                            {{"C", Unit::volt}, 2, 0},
                            {{"encoder", Unit::um}, -1, -0.5}};
  return all;
}

class LabjackT7Driver : public testing::Test {
 protected:
  void serve(const Faults& faults, Device::Options options = {}) {
    options.faults = faults;
    options.core_start = core_start;
    device = std::make_unique<Device>(truth, options);
    served = std::make_unique<ServedDevice>(*device);
    settings.name = "daq";
    settings.command = {"127.0.0.1", served->port(0)};
    settings.stream = {"127.0.0.1", served->port(1)};
    settings.rate_hz = kRate_Hz;
    settings.inputs = inputs();
    settings.inputs.back().dio = dio;
    settings.samples_per_packet = quick_packet(kRate_Hz, 5);
  }
  LabjackT7& driver() {
    if (!made) made = std::make_unique<LabjackT7>(settings);
    return *made;
  }
  std::string refusal() {
    const Status opened = driver().open();
    return opened ? "opened" : opened.error().message;
  }
  // Reads until `scans` have come or an error, which it gives.
  std::string read(std::size_t scans) {
    SampleBlock block;
    const auto until = std::chrono::steady_clock::now() + 20s;
    while (time_ns.size() < scans && std::chrono::steady_clock::now() < until) {
      const auto state = driver().read(block, 50ms);
      if (!state) return state.error().message;
      if (block.scans() > 0) losses.push_back(block.lost);
      time_ns.insert(time_ns.end(), block.time_ns.begin(), block.time_ns.end());
      for (std::size_t c = 0; c < 4; ++c)
        for (std::size_t s = 0; s < block.scans(); ++s) {
          value[c].push_back(block.value[c][s]);
          quality[c].push_back(block.quality_at(c, s));
        }
    }
    return time_ns.size() < scans ? "too few scans" : "";
  }
  std::uint64_t lost() const {
    std::uint64_t sum = 0;
    for (const std::uint64_t n : losses) sum += n;
    return sum;
  }

  // CORE_TIMER reads this now, give or take some seconds.
  void core_reads(std::uint32_t ticks) {
    core_start = ticks - static_cast<std::uint32_t>(truth.zero_ns / 25);  // 40 MHz, wrapping
  }

  Truth truth;
  std::uint32_t core_start = 0xFFF00000;
  int dio = 0;  // of the encoder
  std::unique_ptr<Device> device;
  std::unique_ptr<ServedDevice> served;
  Settings settings;
  std::unique_ptr<LabjackT7> made;
  std::vector<std::int64_t> time_ns;
  std::vector<double> value[4];
  std::vector<Quality> quality[4];
  std::vector<std::uint64_t> losses;
};

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(LabjackT7Driver, GivesVoltsAndMicrometresAtTheirTimes) {
  serve({});
  ASSERT_EQ(refusal(), "opened");
  EXPECT_TRUE(has(driver().info().description, "470012345"));
  EXPECT_EQ(driver().info().rate_hz, kRate_Hz);
  ASSERT_EQ(read(800), "");
  EXPECT_EQ(lost(), 0U);
  for (std::size_t i = 0; i < time_ns.size(); ++i) {
    const double age_s = static_cast<double>(time_ns[i] - truth.zero_ns) * 1e-9;
    ASSERT_NEAR(value[0][i], age_s, 0.1) << i;  // a loaded machine sends late
    ASSERT_NEAR(value[2][i], -1.5, 2e-4);
    ASSERT_NEAR(value[3][i], -0.5e6 * value[0][i], 200) << i;  // the same scan, to one code
    ASSERT_EQ(quality[0][i], Quality::good);
    ASSERT_EQ(quality[1][i], Quality::over_range);
    ASSERT_EQ(quality[3][i], Quality::good);
    ASSERT_TRUE(i == 0 || time_ns[i] > time_ns[i - 1]);
  }
  const double periods = static_cast<double>(time_ns.size() - 1);
  EXPECT_NEAR((value[3].back() - value[3].front()) / -0.5, 1e6 * periods / kRate_Hz, 1.1);
}

TEST_F(LabjackT7Driver, SendsTheVectors) {
  serve({});
  settings.rate_hz = 1000;
  ASSERT_EQ(refusal(), "opened");
  const std::string sent = served->received();
  for (const char* vector :
       {"00 00 00 06 01 03 D7 3C 00 02", "00 00 00 0B 01 10 AB 7C 00 02 04 41 20 00 00",
        "00 00 00 0B 01 10 AC 44 00 02 04 00 00 00 0A",
        "00 00 00 0B 01 10 0F A2 00 02 04 44 7A 00 00",
        "00 00 00 0B 01 10 13 7E 00 02 04 00 00 00 01"})
    EXPECT_TRUE(has(sent, modbus::bytes(vector))) << vector;
}

TEST_F(LabjackT7Driver, ReadReturnsInTimeWithNothing) {
  Faults faults;
  faults.silent_at = 0;
  serve(faults);
  ASSERT_EQ(refusal(), "opened");
  SampleBlock block;
  const auto before = std::chrono::steady_clock::now();
  ASSERT_TRUE(driver().read(block, 20ms));
  EXPECT_EQ(block.scans(), 0U);
  EXPECT_LT(std::chrono::steady_clock::now() - before, 1s);
}

TEST_F(LabjackT7Driver, SwappedWordsAreRefused) {
  Faults faults;
  faults.swapped_words = true;
  serve(faults);
  EXPECT_TRUE(has(refusal(), "0x22330011"));
}

TEST_F(LabjackT7Driver, OtherDevicesAreRefused) {
  Device::Options options;
  options.product = 4;
  serve({}, options);
  EXPECT_TRUE(has(refusal(), "PRODUCT_ID is 4"));
  settings.serial = 1;
  made.reset();
  served.reset();
  serve({});
  EXPECT_TRUE(has(refusal(), "serial number is 470012345"));
}

TEST_F(LabjackT7Driver, TheStampOfAStreamIsReadOnceItsFirstScanHasBegun) {
  core_reads(1'000'000'000);  // a stamp of 0, before the first stream, is far from it
  serve({});
  for (int stream = 0; stream < 2; ++stream) {  // for the second it is that of the first
    ASSERT_EQ(refusal(), "opened");
    time_ns.clear();
    for (auto& column : value) column.clear();
    ASSERT_EQ(read(200), "");
    EXPECT_EQ(driver().info().clock->steps, 0U);
    for (std::size_t i = 0; i < time_ns.size(); ++i)
      ASSERT_NEAR(value[0][i], static_cast<double>(time_ns[i] - truth.zero_ns) * 1e-9, 0.1) << i;
    std::this_thread::sleep_for(200ms);
  }
}

TEST_F(LabjackT7Driver, AStampOfAnotherStreamIsRefused) {
  core_reads(1'000'000'000);
  Faults faults;
  faults.stale_stamp = true;
  serve(faults);
  ASSERT_EQ(refusal(), "opened");
  const std::string message = read(20);
  EXPECT_TRUE(has(message, "STREAM_START_TIME_STAMP is 0, of another stream")) << message;
}

// LabJack's ljm_constants.json: STREAM_START_TIME_STAMP from 1.0214, STREAM_AUTORECOVER_DISABLE
// from 1.026 on.
TEST_F(LabjackT7Driver, FirmwareThatLacksWhatIsNeededIsRefused) {
  for (const auto& [firmware, says] : {std::pair{1.0188F, "1.0188 lacks the time stamp"},
                                       {1.0213F, "(1.0214)"},
                                       {1.0214F, "1.0214 lacks streams that recover (1.026)"},
                                       {1.0259F, "(1.026)"},
                                       {1.026F, "opened"}}) {
    made.reset();
    served.reset();
    Device::Options options;
    options.firmware = firmware;
    serve({}, options);
    const std::string message = refusal();
    EXPECT_TRUE(has(message, says)) << message;
  }
}

TEST_F(LabjackT7Driver, AT7ProIsRefusedOverItsWifi) {
  for (const auto& [hardware, wifi_ip, says] :
       {std::tuple{3U, 0x7F000001U, "over which a T7-Pro cannot stream"},
        {3U, 0xC0A80105U, "opened"},     // connected by cable
        {3U, 0U, "opened"},              // its WiFi is off
        {1U, 0x7F000001U, "opened"}}) {  // it has none
    made.reset();
    served.reset();
    Device::Options options;
    options.hardware = hardware;
    options.wifi_ip = wifi_ip;
    serve({}, options);
    const std::string message = refusal();
    EXPECT_TRUE(has(message, says)) << message;
  }
}

TEST_F(LabjackT7Driver, ErasedConstantsAreRefused) {
  Faults faults;
  faults.erased_flash = true;
  serve(faults);
  EXPECT_TRUE(has(refusal(), "calibration"));
}

TEST_F(LabjackT7Driver, ARefusalIsToldInLabJacksWords) {
  Faults faults;
  faults.refused = reg::stream_enable.address;
  faults.refused_code = 2607;
  serve(faults);
  const std::string message = refusal();
  EXPECT_TRUE(has(message, "STREAM_ENABLE")) << message;
  EXPECT_TRUE(has(message, "2607, the scan list is invalid")) << message;
  EXPECT_TRUE(has(message, settings.command.text())) << message;
}

TEST_F(LabjackT7Driver, AStreamThatRunsIsStopped) {
  serve({});
  ASSERT_EQ(refusal(), "opened");
  LabjackT7 other(settings);
  ASSERT_TRUE(other.open());
  SampleBlock block;
  ASSERT_TRUE(other.read(block, 1000ms));
  EXPECT_GT(block.scans(), 0U);
}

TEST_F(LabjackT7Driver, DroppedScansAreCountedAndTheTimeLineGoesOn) {
  Faults faults;
  faults.recovery_at = 5;
  faults.dropped = 300;
  serve(faults);
  ASSERT_EQ(refusal(), "opened");
  ASSERT_EQ(read(400), "");
  EXPECT_EQ(lost(), 300U);
  std::size_t gaps = 0;
  for (std::size_t i = 1; i < time_ns.size(); ++i) {
    const double scans = (value[3][i] - value[3][i - 1]) / -0.5 * 1e-6 * kRate_Hz;
    if (scans < 2) continue;
    ++gaps;
    EXPECT_NEAR(scans, 301, 0.1);
    EXPECT_NEAR(static_cast<double>(time_ns[i] - time_ns[i - 1]) * 1e-9, 301 / kRate_Hz, 0.05);
  }
  EXPECT_EQ(gaps, 1U);
}

TEST_F(LabjackT7Driver, AStreamNotToBeTrustedIsAnErrorAndIsBegunAnew) {
  struct Case {
    Faults faults;
    const char* says;
  };
  std::vector<Case> cases(5);
  cases[0].faults.stop_at = 3;
  cases[0].says = "LabJack error 2942";
  cases[1].faults.stop_at = 3;
  cases[1].faults.stop_status = status::recovery_overflow;
  cases[1].says = "LabJack error 2943";
  cases[2].faults.skip_at = 3;
  cases[2].says = "packets are missing";
  cases[3].faults.hang_up_at = 3;
  cases[3].says = "closed";
  cases[4].faults.recovery_at = 2;
  cases[4].faults.unmarked = true;
  cases[4].says = "does not mark where";
  for (const Case& c : cases) {
    made.reset();
    served.reset();
    serve(c.faults);
    ASSERT_EQ(refusal(), "opened");
    time_ns.clear();
    losses.clear();
    const std::string message = read(10'000);
    EXPECT_TRUE(has(message, c.says)) << message;
    EXPECT_TRUE(has(message, "\"daq\"")) << message;
    served->change([&] { device->set_faults({}); });
    const std::size_t before = time_ns.size();
    ASSERT_EQ(before, (&c == &cases[4] ? 5 : 3) * settings.samples_per_packet / 5) << c.says;
    ASSERT_EQ(refusal(), "opened");
    ASSERT_EQ(read(before + 20), "");
    // What would have come meanwhile is lost.
    const double gap_s = static_cast<double>(time_ns[before] - time_ns[before - 1]) * 1e-9;
    EXPECT_NEAR(static_cast<double>(lost()), gap_s * kRate_Hz - 1, 0.6);
  }
}

// 0.9 V against 0.25 V, in a range that has a tenth of the other's step; the others stay as they
// are, whatever another program has left.
TEST_F(LabjackT7Driver, ADifferentialInputInARangeOfItsOwn) {
  serve({});
  settings.inputs[2] = {{"C", Unit::volt}, 4, 0, 0, 5, 1};
  settings.samples_per_packet = quick_packet(kRate_Hz, 5);
  for (int turn = 0; turn < 2; ++turn) {
    ASSERT_EQ(refusal(), "opened");
    const std::size_t before = time_ns.size();
    ASSERT_EQ(read(before + 100), "");
    for (std::size_t i = before; i < time_ns.size(); ++i) {
      ASSERT_NEAR(value[2][i], turn == 0 ? 0.65 : 0.9, turn == 0 ? 2e-5 : 2e-4) << i;
      ASSERT_EQ(quality[2][i], Quality::good);
      ASSERT_NEAR(value[0][i], static_cast<double>(time_ns[i] - truth.zero_ns) * 1e-9, 0.1);
    }
    settings.inputs[2] = {{"C", Unit::volt}, 4, 0};
    made.reset();
  }
}

TEST_F(LabjackT7Driver, TheCountGoesOnOverABrokenConnection) {
  serve({});
  ASSERT_EQ(refusal(), "opened");
  ASSERT_EQ(read(20), "");
  served->cut();
  EXPECT_NE(read(100'000), "");
  const std::size_t before = time_ns.size();
  ASSERT_EQ(refusal(), "opened");
  ASSERT_EQ(read(before + 20), "");
  EXPECT_EQ(quality[3].back(), Quality::good);
}

TEST_F(LabjackT7Driver, CountsAtAnotherPairOfLines) {
  dio = 6;
  serve({});
  ASSERT_EQ(refusal(), "opened");
  ASSERT_EQ(read(20), "");
  EXPECT_EQ(quality[3].back(), Quality::good);
  EXPECT_LT(value[3].back(), value[3].front());
}

TEST_F(LabjackT7Driver, ACountThatWasRestartedIsSuspect) {
  serve({});
  ASSERT_EQ(refusal(), "opened");
  ASSERT_EQ(read(20), "");
  EXPECT_EQ(quality[3].back(), Quality::good);
  served->change([&] { device->restart(); });
  served->cut();
  EXPECT_NE(read(100'000), "");
  ASSERT_EQ(refusal(), "opened");
  const std::size_t before = time_ns.size();
  ASSERT_EQ(read(before + 20), "");
  EXPECT_EQ(quality[3].back(), Quality::suspect);
  EXPECT_EQ(quality[0].back(), Quality::good);
  EXPECT_TRUE(has(driver().info().datum_lost, "counts from 0 again"));
  driver().trust_count();  // somebody has found the zero
  ASSERT_EQ(read(time_ns.size() + 200), "");
  EXPECT_EQ(quality[3].back(), Quality::good);
  EXPECT_EQ(driver().info().datum_lost, "");
}

// The counter goes 1,000,000 counts a second.
TEST_F(LabjackT7Driver, ACountFasterThanItCanCountIsSuspectFromThenOn) {
  serve({});
  settings.inputs[3].most_counts_per_s = 2e6;
  ASSERT_EQ(refusal(), "opened");
  ASSERT_EQ(read(200), "");
  EXPECT_EQ(quality[3].back(), Quality::good);
  EXPECT_EQ(driver().info().datum_lost, "");
  made.reset();
  settings.inputs[3].most_counts_per_s = 70'000;
  ASSERT_EQ(refusal(), "opened");
  EXPECT_TRUE(has(driver().info().description, ", counts to 35 mm/s"))
      << driver().info().description;
  ASSERT_EQ(read(400), "");
  EXPECT_EQ(quality[3].back(), Quality::suspect);
  EXPECT_EQ(quality[0].back(), Quality::good);
  EXPECT_TRUE(has(driver().info().datum_lost, "counts may be lost"));
}

TEST_F(LabjackT7Driver, NobodyThereIsAnErrorWithTheAddress) {
  serve({});
  served.reset();
  const std::string message = refusal();
  EXPECT_TRUE(has(message, settings.command.text())) << message;
}

}  // namespace
}  // namespace mdof::drivers::labjack_t7
