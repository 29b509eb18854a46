// The driver reads samples of a simulated T7 on real sockets.
#include <thread>

#include "tests/drivers/labjack_t7/driver_fixture.h"
#include "tests/drivers/modbus/hex.h"

namespace mdof::drivers::labjack_t7::test {
namespace {

TEST_F(LabjackT7Driver, GivesVoltsAndMicrometresAtTheirTimes) {
  serve({});
  ASSERT_EQ(refusal(), "opened");
  EXPECT_TRUE(has(driver().info().description, "470012345"));
  EXPECT_EQ(driver().info().rate_hz, kRate_Hz);
  ASSERT_EQ(read(800), "");
  EXPECT_EQ(lost(), 0U);
  for (std::size_t i = 0; i < time_ns.size(); ++i) {
    const double age_s = static_cast<double>(time_ns[i] - truth.zero_ns) * 1e-9;
    ASSERT_NEAR(value[0][i], age_s, 0.1) << i;  // a busy machine sends packets late
    ASSERT_NEAR(value[2][i], -1.5, 2e-4);
    // Both values are from the same scan; tolerance: one code.
    ASSERT_NEAR(value[3][i], -0.5e6 * value[0][i], 200) << i;
    ASSERT_EQ(quality[0][i], Quality::good);
    ASSERT_EQ(quality[1][i], Quality::over_range);
    ASSERT_EQ(quality[3][i], Quality::good);
    ASSERT_TRUE(i == 0 || time_ns[i] > time_ns[i - 1]);
  }
  const double periods = static_cast<double>(time_ns.size() - 1);
  EXPECT_NEAR((value[3].back() - value[3].front()) / -0.5, 1e6 * periods / kRate_Hz, 1.1);
}

// At resolution_index 8, a scan of five inputs takes 32 ms; its packet is sent after the last
// input. AIN0 shows when the scan began. All times are after the end of the scan, also the first
// ones.
TEST_F(LabjackT7Driver, AScanHasTheTimeOfItsLastInputFromTheBeginning) {
  serve({}, {.latency_ns = 32'000'000});
  ASSERT_EQ(refusal(), "opened");
  ASSERT_EQ(read(800), "");
  for (std::size_t i = 0; i < time_ns.size(); ++i)
    ASSERT_GT(static_cast<double>(time_ns[i] - truth.zero_ns) * 1e-9 - value[0][i], 0.031) << i;
}

TEST_F(LabjackT7Driver, SendsTheExpectedRequests) {
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

TEST_F(LabjackT7Driver, ReadReturnsAtItsTimeoutWithoutData) {
  SimulatedLabjackT7::Faults faults;
  faults.silent_at = 0;
  serve(faults);
  ASSERT_EQ(refusal(), "opened");
  SampleBlock block;
  const auto before = std::chrono::steady_clock::now();
  ASSERT_TRUE(driver().read(block, 20ms));
  EXPECT_EQ(block.scans(), 0U);
  EXPECT_LT(std::chrono::steady_clock::now() - before, 1s);
}

TEST_F(LabjackT7Driver, ReadsTheStreamStampAfterTheFirstScan) {
  core_reads(1'000'000'000);  // CORE_TIMER is far from 0, the time stamp before the first stream
  serve({});
  // Before its first scan, the second stream still has the time stamp of the first stream.
  for (int stream = 0; stream < 2; ++stream) {
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

TEST_F(LabjackT7Driver, StopsARunningStream) {
  serve({});
  ASSERT_EQ(refusal(), "opened");
  LabjackT7 other(settings);
  ASSERT_TRUE(other.open());
  SampleBlock block;
  ASSERT_TRUE(other.read(block, 1000ms));
  EXPECT_GT(block.scans(), 0U);
}

TEST_F(LabjackT7Driver, CountsDroppedScansAndKeepsTimes) {
  SimulatedLabjackT7::Faults faults;
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

TEST_F(LabjackT7Driver, InvalidStreamIsAnErrorAndIsRestarted) {
  struct Case {
    SimulatedLabjackT7::Faults faults;
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
  cases[4].says = "scans, but does not report at which point";
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
    // All scans during the interruption count as lost.
    const double gap_s = static_cast<double>(time_ns[before] - time_ns[before - 1]) * 1e-9;
    EXPECT_NEAR(static_cast<double>(lost()), gap_s * kRate_Hz - 1, 0.6);
  }
}

// Channel C is the difference 0.9 V - 0.25 V. One code of its range is a tenth of one code of the
// other ranges. The settings of the other inputs must be correct, even if another program has
// changed them.
TEST_F(LabjackT7Driver, DifferentialInputHasItsOwnRange) {
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

TEST_F(LabjackT7Driver, CountContinuesAfterABrokenConnection) {
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

// The encoders of two axes are in one scan. DIO0 counts (ns / 1000), DIO2 counts a quarter of it.
TEST_F(LabjackT7Driver, EncodersOfTwoAxesAreIndependent) {
  serve({});
  settings.inputs[2] = {{"encoder_Y", Unit::um}, -1, 2.0};
  settings.inputs[2].dio = 2;
  settings.inputs[2].most_counts_per_s = 400'000;
  settings.inputs[3].most_counts_per_s = 400'000;
  settings.samples_per_packet = quick_packet(kRate_Hz, 6);
  ASSERT_EQ(refusal(), "opened");
  EXPECT_TRUE(
      has(driver().info().description, ", encoder_Y counts up to 800 mm/s, counts up to 200 mm/s"))
      << driver().info().description;
  ASSERT_EQ(read(400), "");
  for (std::size_t i = 0; i < time_ns.size(); ++i)
    // The values are 2 * 0.25 and -0.5 of the same count. The inputs are read 50 us apart.
    ASSERT_NEAR(value[2][i], -value[3][i], 120) << i;
  EXPECT_EQ(quality[2].back(), Quality::good);
  EXPECT_EQ(quality[3].back(), Quality::suspect);  // it counts 1,000,000 counts/s
  EXPECT_TRUE(has(driver().info().datum_lost, "counts may have been lost"));
  EXPECT_TRUE(driver().info().further_datum_lost.empty());

  served->change([&] { device->restart(); });
  served->cut();
  EXPECT_NE(read(100'000), "");
  ASSERT_EQ(refusal(), "opened");
  ASSERT_EQ(read(time_ns.size() + 20), "");
  EXPECT_EQ(quality[2].back(), Quality::suspect);
  EXPECT_TRUE(has(driver().info().further_datum_lost["encoder_Y"], "counter restarted at 0"));
  driver().trust_count();  // the user has set the position of the other axis
  ASSERT_EQ(read(time_ns.size() + 200), "");
  EXPECT_EQ(quality[2].back(), Quality::suspect);
  driver().trust_further_count("encoder_Y");
  ASSERT_EQ(read(time_ns.size() + 200), "");
  EXPECT_EQ(quality[2].back(), Quality::good);
  EXPECT_TRUE(driver().info().further_datum_lost.empty());
}

TEST_F(LabjackT7Driver, RestartedCountIsSuspect) {
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
  EXPECT_TRUE(has(driver().info().datum_lost, "counter restarted at 0"));
  driver().trust_count();  // the user has set the position
  ASSERT_EQ(read(time_ns.size() + 200), "");
  EXPECT_EQ(quality[3].back(), Quality::good);
  EXPECT_EQ(driver().info().datum_lost, "");
}

// The encoder counts 1,000,000 counts/s.
TEST_F(LabjackT7Driver, CountIsSuspectAfterExceedingItsSpeedLimit) {
  serve({});
  settings.inputs[3].most_counts_per_s = 2e6;
  ASSERT_EQ(refusal(), "opened");
  ASSERT_EQ(read(200), "");
  EXPECT_EQ(quality[3].back(), Quality::good);
  EXPECT_EQ(driver().info().datum_lost, "");
  made.reset();
  settings.inputs[3].most_counts_per_s = 70'000;
  ASSERT_EQ(refusal(), "opened");
  EXPECT_TRUE(has(driver().info().description, ", counts up to 35 mm/s"))
      << driver().info().description;
  ASSERT_EQ(read(400), "");
  EXPECT_EQ(quality[3].back(), Quality::suspect);
  EXPECT_EQ(quality[0].back(), Quality::good);
  EXPECT_TRUE(has(driver().info().datum_lost, "counts may have been lost"));
}

}  // namespace
}  // namespace mdof::drivers::labjack_t7::test
