#include "drivers/csv_stream/csv_stream.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "drivers/csv_stream/configure.h"
#include "drivers/csv_stream/simulated_csv_stream.h"
#include "tests/drivers/collect.h"
#include "tests/drivers/csv_stream/csv_stream_options.h"
#include "tests/drivers/served_device.h"
#include "tests/shown.h"

namespace mdof::drivers {
namespace {

using std::chrono::milliseconds;

CsvStreamOptions command(const std::string& script) {
  CsvStreamOptions options = options_for_test();
  options.command = {"sh", "-c", script};
  return options;
}

double counts(std::size_t input, std::int64_t) {
  return static_cast<double>(input) + 0.25;
}

CsvStream over_tcp(const ServedDevice& served, milliseconds silence = milliseconds(5000)) {
  CsvStreamOptions options = options_for_test();
  options.silence = silence;
  options.server = *parse_endpoint(served.address(), 0);
  return {"probe", options};
}

TEST(CsvStream, ReadsRowsOfATcpServerWithItsTimes) {
  SimulatedCsvStream device(counts, {.columns = {"encoder_mm", "A_um"}});
  const ServedDevice served(device);
  CsvStream stream = over_tcp(served);
  const auto status = stream.open();
  ASSERT_TRUE(status) << status.error().message;
  EXPECT_EQ(stream.info().channels, (std::vector<Channel>{{"encoder", Unit::mm}, {"A", Unit::um}}));
  const Collected all = collect(stream, 200);
  ASSERT_EQ(all.error, "");
  ASSERT_GE(all.scans.size(), 200u);
  EXPECT_EQ(all.scans[7], (std::vector<double>{0.25, 1.25}));
  EXPECT_EQ(all.lost, 0u);
  expect_growing(all.time_ns);
  // On a busy computer the first row may arrive late. The clock has corrected this delay after 50
  // rows.
  constexpr std::size_t kFrom = 50;
  EXPECT_NEAR(static_cast<double>(all.time_ns.back() - all.time_ns[kFrom]),
              static_cast<double>(all.time_ns.size() - 1 - kFrom) * 1e6, 2e6);
  EXPECT_LT(std::abs(monotonic_ns() - all.time_ns.back()), 5'000'000'000);
}

// The acquisition marks samples as suspect while the clock is uncertain. The acquisition reads the
// state of the clock at each block.
TEST(CsvStream, LateRowsMakeTheClockUncertain) {
  CsvStream stream("probe", command("printf 'time_s,A_um\\n5.00,1\\n'; sleep 0.5; "
                                    "printf '5.01,2\\n'; sleep 60"));
  EXPECT_EQ(stream.clock(), nullptr);  // the header has not arrived yet
  ASSERT_TRUE(stream.open());
  ASSERT_NE(stream.clock(), nullptr);
  ASSERT_EQ(collect(stream, 1).scans.size(), 1u);
  EXPECT_FALSE(stream.clock()->doubtful());
  ASSERT_EQ(collect(stream, 1).scans.size(), 1u);
  EXPECT_TRUE(stream.clock()->doubtful());
  ASSERT_TRUE(stream.info().clock);
  EXPECT_GT(stream.info().clock->late_ns, 100'000'000);

  CsvStream without("probe", command("printf 'A_um\\n1\\n'; sleep 60"));
  ASSERT_TRUE(without.open());
  EXPECT_EQ(without.clock(), nullptr);
  EXPECT_FALSE(without.info().clock);
}

TEST(CsvStream, PositionInVoltsNeedsTheRigsScale) {
  SimulatedCsvStream device(counts, {.columns = {"encoder_V", "A_um"}});
  const ServedDevice served(device);
  for (const bool scaled : {false, true}) {
    DriverContext context;
    context.name = "probe";
    context.rig.source = "rig_X.toml";
    if (scaled) context.rig.encoder_um_per_V = 500;
    auto table =
        TomlTable::parse("source = \"tcp://" + served.address() + "\"\n", "mdofd.toml").value();
    const auto stream = configure_csv_stream(table, context)->make().value();
    const auto opened = stream->open();
    const std::string reported = opened ? "" : opened.error().message;
    ASSERT_EQ(reported.empty(), scaled) << reported;
    if (scaled) continue;
    EXPECT_NE(reported.find("set um_per_V in [encoder] of rig_X.toml"), std::string::npos)
        << reported;
  }
  // The option `header` gives the columns if the source sends no header. The configuration can
  // then report the error.
  DriverContext context;
  auto table = TomlTable::parse("source = \"fifo:x\"\nheader = \"encoder_V,A_um\"\n", "mdofd.toml");
  const auto spec = configure_csv_stream(*table, context);
  ASSERT_FALSE(spec);
  EXPECT_NE(spec.error().message.find("mdofd.toml:2: header: "), std::string::npos)
      << spec.error().message;
}

TEST(CsvStream, BadLinesAreCountedAsLost) {
  SimulatedCsvStream device(
      counts,
      {.columns = {"A_um"}, .rate_hz = 2000, .with_time = false, .faults = {.bad_line_every = 10}});
  const ServedDevice served(device);
  CsvStream stream = over_tcp(served);
  ASSERT_TRUE(stream.open());
  const Collected all = collect(stream, 91);
  ASSERT_EQ(all.error, "");
  EXPECT_GE(all.lost, 10u);
  ASSERT_FALSE(stream.notices().empty());
  EXPECT_NE(test::shown(stream.notices()[0]).find("2 fields in the line, but the header has 1"),
            std::string::npos);
  const Collected more = collect(stream, 5000);
  EXPECT_NE(more.error.find("more than 100 of 10000 lines are bad"), std::string::npos)
      << more.error;
}

TEST(CsvStream, BrokenConnectionIsAnErrorAndReopens) {
  SimulatedCsvStream device(counts, {.columns = {"A_um"}, .faults = {.cut_row = 50}});
  const ServedDevice served(device);
  CsvStream stream = over_tcp(served);
  std::int64_t last_ns = 0;
  for (int round = 0; round < 2; ++round) {
    ASSERT_TRUE(stream.open());
    const Collected all = collect(stream, 1000);
    EXPECT_EQ(all.scans.size(), 50u);  // the incomplete last row is not used
    EXPECT_NE(all.error.find(served.address() + ": the other side has closed"), std::string::npos)
        << all.error;
    expect_growing(all.time_ns);
    EXPECT_GT(all.time_ns.at(0), last_ns);
    last_ns = all.time_ns.back();
  }
}

TEST(CsvStream, SilentServerIsAnError) {
  SimulatedCsvStream device(counts, {.columns = {"A_um"}, .faults = {.silent_from = 5}});
  const ServedDevice served(device);
  CsvStream stream = over_tcp(served, milliseconds(300));
  ASSERT_TRUE(stream.open());
  const Collected all = collect(stream, 1000);
  EXPECT_EQ(all.scans.size(), 5u);
  EXPECT_NE(all.error.find("no row for 0."), std::string::npos) << all.error;
}

TEST(CsvStream, RepeatedHeaderRestartsTheClock) {
  SimulatedCsvStream device(counts, {.columns = {"A_um"}, .faults = {.restart_at = 60}});
  const ServedDevice served(device);
  CsvStream stream = over_tcp(served);
  ASSERT_TRUE(stream.open());
  const Collected all = collect(stream, 150);
  ASSERT_EQ(all.error, "");
  expect_growing(all.time_ns);
  EXPECT_LT(all.time_ns[149] - all.time_ns[0], 20'000'000'000);
}

TEST(CsvStream, RefusesTimesInMilliseconds) {
  SimulatedCsvStream device(counts, {.columns = {"A_um"}, .faults = {.time_scale = 1000}});
  const ServedDevice served(device);
  CsvStream stream = over_tcp(served);
  ASSERT_TRUE(stream.open());
  const Collected all = collect(stream, 1000);
  EXPECT_NE(all.error.find("give time_s in seconds"), std::string::npos) << all.error;
}

TEST(CsvStream, OpeningFailsWithoutAHeader) {
  SimulatedCsvStream device(counts, {.columns = {"A_um"}, .faults = {.no_header = true}});
  const ServedDevice served(device);
  CsvStream stream = over_tcp(served);
  const auto status = stream.open();
  ASSERT_FALSE(status);
  EXPECT_NE(status.error().message.find("the line has numbers instead of the header"),
            std::string::npos);
}

TEST(CsvStream, ServerThatIsNotRunningIsAnError) {
  CsvStreamOptions options = options_for_test();
  {
    SimulatedCsvStream device(counts, {.columns = {"A_um"}});
    options.server = *parse_endpoint(ServedDevice(device).address(), 0);
  }
  CsvStream stream("probe", options);
  const auto status = stream.open();
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::io);
  EXPECT_NE(status.error().message.find(options.server->text()), std::string::npos);
}

TEST(CsvStream, ReadsRowsOfACommandUntilItExits) {
  CsvStream stream("probe", command("printf 'A_um,B_um\\n1,2\\n3,4\\n5,'; echo first >&2; "
                                    "echo 'sensor on fire' >&2; exit 3"));
  for (int round = 0; round < 2; ++round) {
    ASSERT_TRUE(stream.open());
    const Collected all = collect(stream, 10);
    ASSERT_EQ(all.scans.size(), 2u);
    EXPECT_EQ(all.scans[1], (std::vector<double>{3, 4}));
    EXPECT_NE(
        all.error.find("has exited with status 3; the last line of its standard error: sensor "
                       "on fire"),
        std::string::npos)
        << all.error;
  }
}

TEST(CsvStream, MissingCommandIsAnError) {
  CsvStreamOptions options = options_for_test();
  options.command = {"/no/such/program"};
  const auto status = CsvStream("probe", options).open();
  ASSERT_FALSE(status);
  EXPECT_NE(status.error().message.find("\"/no/such/program\": cannot be started"),
            std::string::npos);
}

TEST(CsvStream, CommandEndsWithItsDriverAndErrorsDoNotBlock) {
  const auto marker = std::filesystem::temp_directory_path() /
                      ("mdof_csv_stream_test." + std::to_string(::getpid()));
  {
    // The program writes more bytes to standard error than a pipe can hold, and then rows.
    CsvStream stream("probe", command("trap 'echo ended >" + marker.string() +
                                      "; exit 0' TERM; echo A_um; head -c 300000 /dev/zero | tr "
                                      "'\\0' 'x' >&2; echo 1; while :; do sleep 0.02; done"));
    ASSERT_TRUE(stream.open());
    EXPECT_EQ(collect(stream, 1).scans.size(), 1u);
  }
  EXPECT_TRUE(std::filesystem::exists(marker));
  std::filesystem::remove(marker);
}

TEST(CsvStream, RowsThatWaitedTogetherAreSuspect) {
  CsvStream stream("probe", command("printf 'A_um\\n1\\n'; sleep 0.2; printf '2\\n3\\n4\\n'; "
                                    "sleep 5"));
  ASSERT_TRUE(stream.open());
  const Collected all = collect(stream, 4);
  ASSERT_EQ(all.quality.size(), 4u);
  const Quality expected[] = {Quality::good, Quality::suspect, Quality::suspect, Quality::good};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(all.first_quality(i), expected[i]) << i;
  expect_growing(all.time_ns);
  EXPECT_GT(all.time_ns[1] - all.time_ns[0], 100'000'000);
}

// At the start it is unknown for how long the first rows have waited.
TEST(CsvStream, RowsThatWaitedBeforeTheStartAreSuspect) {
  CsvStream stream("probe", command("printf 'A_um\\n1\\n2\\n3\\n'; sleep 5"));
  for (int start = 0; start < 2; ++start) {
    ASSERT_TRUE(stream.open());
    const Collected all = collect(stream, 3);
    ASSERT_EQ(all.quality.size(), 3u);
    const Quality expected[] = {Quality::suspect, Quality::suspect, Quality::good};
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(all.first_quality(i), expected[i]) << i;
  }
}

// The last row of a burst gets the time at which the burst arrived. The other rows are spread
// evenly over the time since the previous burst. A burst after a pause of this computer is
// suspect, and the test does not use it.
TEST(CsvStream, BurstRowsAreSpreadBackToTheBurstBefore) {
  constexpr std::size_t kBursts = 25, kRows = 8;
  CsvStream stream("probe", command("echo A_um; for i in $(seq 25); do printf "
                                    "'1\n2\n3\n4\n5\n6\n7\n8\n'; sleep 0.016; done; sleep 5"));
  ASSERT_TRUE(stream.open());
  const Collected all = collect(stream, kBursts * kRows);
  ASSERT_EQ(all.time_ns.size(), kBursts * kRows);
  expect_growing(all.time_ns);
  std::size_t spread = 0;
  for (std::size_t i = 2 * kRows - 1; i < all.time_ns.size(); i += kRows) {
    if (all.first_quality(i - 1) != Quality::good) continue;
    ++spread;
    const std::int64_t passed_ns = all.time_ns[i] - all.time_ns[i - kRows];
    for (std::size_t k = i - kRows + 1; k <= i; ++k)
      EXPECT_NEAR(static_cast<double>(all.time_ns[k] - all.time_ns[k - 1]),
                  static_cast<double>(passed_ns) / kRows, 1e3);
  }
  EXPECT_GT(spread, 0u);
}

TEST(CsvStream, EmptyFieldsAreMissingAndSimulatedIsReported) {
  CsvStream stream("probe", command("printf '# simulated\\nA_um,B_um\\n,2\\n'; sleep 5"));
  ASSERT_TRUE(stream.open());
  EXPECT_TRUE(stream.info().simulated);
  SampleBlock block;
  while (block.scans() == 0) ASSERT_TRUE(stream.read(block, milliseconds(100)));
  EXPECT_EQ(block.quality_at(0, 0), Quality::missing);
  EXPECT_EQ(block.quality_at(1, 0), Quality::simulated);
}

TEST(CsvStream, RefusesAHeaderWithoutChannelsOfTheRig) {
  CsvStream stream("probe", command("echo Z_um; sleep 5"));
  const auto status = stream.open();
  ASSERT_FALSE(status);
  EXPECT_NE(
      status.error().message.find("channels in the header: Z; channels of the rig: encoder, A, B"),
      std::string::npos)
      << status.error().message;
}

TEST(CsvStream, SilentCommandIsAnError) {
  CsvStreamOptions options = command("sleep 5");
  options.start = milliseconds(100);
  const auto status = CsvStream("probe", options).open();
  ASSERT_FALSE(status);
  EXPECT_NE(status.error().message.find("no header line within 0.1 s"), std::string::npos);
}

}  // namespace
}  // namespace mdof::drivers
