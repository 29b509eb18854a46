#include "drivers/simulator/simulator.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>

#include "schema/units.h"

namespace mdof::drivers {
namespace {

using std::chrono::milliseconds;

Rig five_probes() {
  Rig rig;
  rig.name = "fixture";
  rig.axis = Axis::x;
  for (const char* id : {"A", "B", "C", "D", "E"}) {
    Probe probe;
    probe.id = id;
    probe.range_m = 200e-6;
    rig.probes.push_back(probe);
  }
  return rig;
}

// A first-order model of five probes: A and B read the top, C to E the side.
void forward(double d_m, const Errors5& e, std::span<double> probe_m) {
  for (std::size_t k = 0; k < probe_m.size(); ++k) {
    const double lever_m = d_m + 0.01 * static_cast<double>(k);
    probe_m[k] = k < 2 ? e[kDz] + lever_m * e[kEy] : e[kDy] - lever_m * e[kEz] + 0.02 * e[kEx];
  }
}

// A clock whose time advances only when the simulator sleeps.
struct ManualTime {
  std::int64_t now_ns = 5'000'000'000;
  Clock clock() {
    return {[this] { return now_ns; }, [this](std::int64_t ns) { now_ns += ns; }};
  }
};

SimulatorOptions fast() {
  SimulatorOptions options;
  options.real_time = false;
  options.loop = false;
  options.targets_mm = {0, 10, 20};
  options.dwell_s = 0.1;
  options.repeats = 1;
  return options;
}

std::unique_ptr<Simulator> make(const SimulatorOptions& options, ManualTime& time,
                                const Rig& rig = five_probes()) {
  auto simulator = Simulator::make("sim", rig, options, forward, time.clock());
  EXPECT_TRUE(simulator) << simulator.error().message;
  return std::move(*simulator);
}

struct Recording {
  SampleBlock all;
  std::uint64_t lost = 0;
  int disconnects = 0;
};

void append(SampleBlock& all, const SampleBlock& block) {
  all.channels = block.channels;
  all.time_ns.insert(all.time_ns.end(), block.time_ns.begin(), block.time_ns.end());
  all.value.resize(block.value.size());
  all.quality.resize(block.quality.size());
  for (std::size_t c = 0; c < block.value.size(); ++c) {
    all.value[c].insert(all.value[c].end(), block.value[c].begin(), block.value[c].end());
    all.quality[c].insert(all.quality[c].end(), block.quality[c].begin(), block.quality[c].end());
  }
}

// Reads to the end of the simulation, and opens the simulator again after each disconnection.
Recording record(Simulator& simulator, std::vector<int> timeouts_ms = {100}) {
  Recording recording;
  SampleBlock block;
  EXPECT_TRUE(simulator.open());
  for (std::size_t i = 0; i < 1'000'000; ++i) {
    const auto state = simulator.read(block, milliseconds(timeouts_ms[i % timeouts_ms.size()]));
    if (!state) {
      ++recording.disconnects;
      EXPECT_TRUE(simulator.open());
      continue;
    }
    if (*state == ReadState::end) return recording;
    recording.lost += block.lost;
    append(recording.all, block);
  }
  ADD_FAILURE() << "does not end";
  return recording;
}

Recording record(const SimulatorOptions& options) {
  ManualTime time;
  return record(*make(options, time));
}

// FNV-1a hash of all values, qualities and times. The times are relative to the first.
std::uint64_t hash_of(const SampleBlock& all) {
  std::uint64_t hash = 0xcbf29ce484222325;
  const auto mix = [&](std::uint64_t word) {
    for (int i = 0; i < 8; ++i) hash = (hash ^ (word >> (8 * i) & 0xFF)) * 0x100000001b3;
  };
  for (const std::int64_t t_ns : all.time_ns)
    mix(static_cast<std::uint64_t>(t_ns - all.time_ns[0]));
  for (const auto& column : all.value)
    for (const double x : column) mix(std::bit_cast<std::uint64_t>(x));
  for (const auto& column : all.quality)
    for (const Quality q : column) mix(static_cast<std::uint64_t>(q));
  return hash;
}

SimulatorOptions with_every_fault() {
  SimulatorOptions options = fast();
  options.settle_um = 2;
  options.spike_probability = 0.01;
  options.saturation.probability = 0.02;
  options.gap.probability = 0.02;
  options.lost = {{"C", {0.5, 0.9}}};
  options.disconnects = {{1.0, 1.5}};
  return options;
}

TEST(Simulator, MarksItsInfoAndSamplesAsSimulated) {
  ManualTime time;
  const auto simulator = make(fast(), time);
  EXPECT_TRUE(simulator->info().simulated);
  EXPECT_EQ(simulator->info().driver, "simulator");
  ASSERT_EQ(simulator->info().channels.size(), 6u);
  EXPECT_EQ(simulator->info().channels[5], (Channel{kEncoderChannel, Unit::mm}));
  const Recording recording = record(*simulator);
  for (const auto& column : recording.all.quality)
    for (const Quality q : column) ASSERT_EQ(q, Quality::simulated);
}

TEST(Simulator, ReadingsFollowTheForwardModel) {
  SimulatorOptions options = fast();
  options.noise_um = options.encoder_noise_nm = options.encoder_resolution_nm = 0;
  ManualTime time;
  const auto simulator = make(options, time);
  const SampleBlock all = record(*simulator).all;
  ASSERT_GT(all.scans(), 1000u);
  std::vector<double> expected_m(5);
  for (std::size_t i = 0; i < all.scans(); ++i) {
    const AxisState state = simulator->machine().motion().at(all.time_ns[i] - all.time_ns[0]);
    const Errors5 truth = simulator->machine().truth_at(state.travel_m, state.direction);
    forward(state.travel_m, truth, expected_m);
    for (std::size_t k = 0; k < 5; ++k) ASSERT_NEAR(all.value[k][i], to_um(expected_m[k]), 1e-9);
    ASSERT_EQ(all.value[5][i], to_mm(state.travel_m));
  }
}

TEST(Simulator, NamedErrorsHaveTheirAmplitudeSlopeAndReversal) {
  SimulatorOptions options = fast();
  options.errors = {{"EYX", 2, 40, 0.25, 0.1, 0.6}, {"ECX", 0, 50, 0, 1, 0}};
  ManualTime time;
  const auto simulator = make(options, time);
  const Machine& machine = simulator->machine();
  EXPECT_NEAR(machine.truth_at(0, 1)[kDy], 2.3e-6, 1e-18);
  EXPECT_NEAR(machine.truth_at(0, -1)[kDy], 1.7e-6, 1e-18);
  EXPECT_NEAR(machine.truth_at(0.020, 1)[kDy], 0.3e-6, 1e-18);  // -2 + 20 * 0.1 + 0.3 µm
  EXPECT_NEAR(machine.truth_at(0.020, 1)[kEz], 20e-6, 1e-18);
  EXPECT_EQ(machine.truth_at(0.020, 1)[kEx], 0);
}

TEST(Simulator, NoiseAndEncoderResolutionAreAsConfigured) {
  SimulatorOptions options = fast();
  options.targets_mm = {5};
  options.overrun_mm = 0;
  options.dwell_s = 10;
  options.noise_um = 0.05;
  options.encoder_noise_nm = 20;
  options.encoder_resolution_nm = 100;
  const SampleBlock all = record(options).all;
  const std::size_t forward_scans = all.scans() / 2;
  ASSERT_EQ(forward_scans, 10'000u);
  const auto n = static_cast<double>(forward_scans);
  for (std::size_t k = 0; k < 5; ++k) {
    double sum = 0, squares = 0;
    for (std::size_t i = 0; i < forward_scans; ++i) {
      const double x = all.value[k][i] - all.value[k][0];
      sum += x;
      squares += x * x;
    }
    EXPECT_NEAR(std::sqrt((squares - sum * sum / n) / n), 0.05, 0.002) << k;
  }
  for (const double x_mm : all.value[5]) {
    const double steps = x_mm / 1e-4;
    ASSERT_NEAR(steps, std::round(steps), 1e-6);
    ASSERT_NEAR(x_mm, 5, 2e-4);
  }
}

TEST(Simulator, SameSeedGivesTheSameBitsInAnyReads) {
  const std::uint64_t expected = hash_of(record(with_every_fault()).all);
  SimulatorOptions options = with_every_fault();
  EXPECT_EQ(hash_of(record(options).all), expected);
  options.seed = 2;
  EXPECT_NE(hash_of(record(options).all), expected);

  options = with_every_fault();
  options.disconnects.clear();
  const std::uint64_t connected = hash_of(record(options).all);
  EXPECT_NE(connected, expected);
  options.real_time = true;
  for (const std::vector<int>& timeouts_ms : {std::vector{0, 1, 0, 7}, {1000}, {3, 50}}) {
    ManualTime time;
    std::int64_t slow_ns = 0;  // delay of a reader that is sometimes late
    Clock clock = time.clock();
    clock.now_ns = [&] { return time.now_ns += slow_ns++ % 1000 == 0 ? 50'000'000 : 10'000; };
    auto simulator = Simulator::make("sim", five_probes(), options, forward, clock);
    ASSERT_TRUE(simulator);
    EXPECT_EQ(hash_of(record(**simulator, timeouts_ms).all), connected);
  }
}

TEST(Simulator, EveryCompilerGivesTheseBits) {
  EXPECT_EQ(hash_of(record(with_every_fault()).all), 0x1d2f8ece0fb8cf24u);
}

TEST(Simulator, SpikesHaveTheirProbabilityAndSize) {
  SimulatorOptions options = fast();
  const SampleBlock clean = record(options).all;
  options.spike_probability = 0.02;
  options.spike_um = 15;
  const SampleBlock spiky = record(options).all;
  int spikes = 0;
  for (std::size_t k = 0; k < 5; ++k)
    for (std::size_t i = 0; i < clean.scans(); ++i) {
      const double difference_um = std::abs(spiky.value[k][i] - clean.value[k][i]);
      if (difference_um == 0) continue;
      ++spikes;
      ASSERT_NEAR(difference_um, 15, 1e-9);
    }
  const double n = 5.0 * static_cast<double>(clean.scans());
  EXPECT_NEAR(spikes / n, 0.02, 5 * std::sqrt(0.02 / n));
  EXPECT_EQ(spiky.value[5], clean.value[5]);
}

TEST(Simulator, LostProbeIsMissingOnlyInItsInterval) {
  SimulatorOptions options = fast();
  options.lost = {{"C", {0.5, 0.9}}};
  const SampleBlock all = record(options).all;
  for (std::size_t i = 0; i < all.scans(); ++i) {
    const std::int64_t t_ns = all.time_ns[i] - all.time_ns[0];
    const bool lost = t_ns >= 500'000'000 && t_ns < 900'000'000;
    ASSERT_EQ(all.quality[2][i] == Quality::missing, lost) << t_ns;
    ASSERT_EQ(std::isnan(all.value[2][i]), lost);
    ASSERT_EQ(all.quality[3][i], Quality::simulated);
  }
}

TEST(Simulator, SaturationIsFlaggedAtTheEndOfTheRange) {
  SimulatorOptions options = fast();
  options.saturation = {0.1, 0.05};
  const SampleBlock all = record(options).all;
  int saturated = 0;
  for (std::size_t i = 0; i < all.scans(); ++i) {
    if (all.quality[0][i] != Quality::over_range) continue;
    ++saturated;
    ASSERT_EQ(all.value[0][i], 100);
  }
  EXPECT_GT(saturated, 50);
  EXPECT_LT(saturated, static_cast<int>(all.scans()) / 3);
}

TEST(Simulator, LostAndReturnedScansAddUp) {
  SimulatorOptions options = fast();
  options.errors = {{"EYX", 0, 50, 0, 0, 0}};
  const Recording whole = record(options);
  EXPECT_EQ(whole.lost, 0u);
  options.gap = {0.2, 0.02};
  options.disconnects = {{0.25, 0.75}, {1.1, 1.2}};
  const Recording torn = record(options);
  EXPECT_EQ(torn.disconnects, 2);
  EXPECT_GT(torn.lost, 600u);
  EXPECT_EQ(torn.lost + torn.all.scans(), whole.all.scans());
  for (std::size_t i = 1; i < torn.all.scans(); ++i)
    ASSERT_GT(torn.all.time_ns[i], torn.all.time_ns[i - 1]);
}

TEST(Simulator, EndsAfterItsRepeatsOrNever) {
  SimulatorOptions options = fast();
  ManualTime time;
  const auto once = make(options, time);
  const auto cycle = static_cast<double>(once->machine().motion().cycle_ns());
  EXPECT_NEAR(static_cast<double>(record(*once).all.scans()), cycle / 1e6, 1);
  SampleBlock block;
  EXPECT_EQ(*once->read(block, milliseconds(1)), ReadState::end);  // the end may be read repeatedly
  options.repeats = 3;
  EXPECT_NEAR(static_cast<double>(record(options).all.scans()), 3 * cycle / 1e6, 1);
  options.loop = true;
  const auto endless = make(options, time);
  ASSERT_TRUE(endless->open());
  for (int i = 0; i < 100; ++i) ASSERT_EQ(*endless->read(block, milliseconds(1)), ReadState::more);
}

TEST(Simulator, NeverReturnsMoreThanTheScansDue) {
  SimulatorOptions options = fast();
  options.real_time = true;
  options.rate_hz = 4000;
  options.packet_ms = 2;
  ManualTime time;
  const auto simulator = make(options, time);
  const std::int64_t start_ns = time.now_ns;
  ASSERT_TRUE(simulator->open());
  SampleBlock block;
  std::size_t scans = 0;
  for (int i = 0; i < 200; ++i) {
    // The reader stalls, and then gets all scans of this time at once.
    if (i == 100) time.now_ns += 50'000'000;
    ASSERT_TRUE(simulator->read(block, milliseconds(1)));
    scans += block.scans();
    ASSERT_EQ(scans, static_cast<std::size_t>((time.now_ns - start_ns) / 250'000 + 1));
    ASSERT_TRUE(block.time_ns.empty() || block.time_ns.back() <= time.now_ns);
  }
  EXPECT_EQ(time.now_ns - start_ns, 249'000'000);
}

TEST(Simulator, ReadTimesOutWithoutScans) {
  SimulatorOptions options = fast();
  options.real_time = true;
  options.rate_hz = 1;
  ManualTime time;
  const auto simulator = make(options, time);
  ASSERT_TRUE(simulator->open());
  SampleBlock block;
  ASSERT_TRUE(simulator->read(block, milliseconds(10)));
  EXPECT_EQ(block.scans(), 1u);  // only the scan at the start
  const std::int64_t before_ns = time.now_ns;
  EXPECT_EQ(*simulator->read(block, milliseconds(10)), ReadState::more);
  EXPECT_EQ(block.scans(), 0u);
  EXPECT_EQ(time.now_ns - before_ns, 10'000'000);
}

TEST(Simulator, DisconnectedDeviceOpensOnlyAfterItsReturn) {
  SimulatorOptions options = fast();
  options.real_time = true;
  options.disconnects = {{0.1, 0.3}};
  ManualTime time;
  const std::int64_t start_ns = time.now_ns;
  const auto simulator = make(options, time);
  SampleBlock block;
  EXPECT_FALSE(simulator->read(block, milliseconds(1)));  // the simulator is not open
  ASSERT_TRUE(simulator->open());
  Result<ReadState> state = ReadState::more;
  std::size_t scans = 0;
  while (state) {
    state = simulator->read(block, milliseconds(10));
    scans += block.scans();
  }
  EXPECT_EQ(scans, 100u);
  EXPECT_EQ(state.error().code, ErrorCode::io);
  EXPECT_NE(state.error().message.find("\"sim\""), std::string::npos);
  EXPECT_FALSE(simulator->read(block, milliseconds(10)));
  EXPECT_FALSE(simulator->open());
  time.now_ns = start_ns + 350'500'000;
  ASSERT_TRUE(simulator->open());
  ASSERT_TRUE(simulator->read(block, milliseconds(10)));
  ASSERT_FALSE(block.time_ns.empty());
  EXPECT_EQ(block.time_ns.front() - start_ns, 351'000'000);
  EXPECT_EQ(block.lost, 251u);
}

TEST(Simulator, OptionErrorsNameTheDevice) {
  SimulatorOptions options = fast();
  options.errors = {{"EXY", 1, 50, 0, 0, 0}};
  const auto simulator = Simulator::make("sim", five_probes(), options, forward);
  ASSERT_FALSE(simulator);
  EXPECT_NE(simulator.error().message.find("device \"sim\": [[error]] name \"EXY\""),
            std::string::npos);
}

}  // namespace
}  // namespace mdof::drivers
