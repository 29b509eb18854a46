#include "drivers/simulator/options.h"

#include <gtest/gtest.h>

#include <string>

namespace mdof::drivers {
namespace {

Result<SimulatorOptions> options_from(const std::string& toml) {
  MDOF_TRY(TomlTable table, TomlTable::parse(toml, "mdofd.toml"));
  SimulatorOptions options;
  MDOF_CHECK(read_options(table, options));
  return options;
}

Rig rig_of(Axis axis) {
  Rig rig;
  rig.name = "fixture";
  rig.axis = axis;
  rig.probes.resize(2);
  rig.probes[0].id = "A";
  rig.probes[1].id = "B";
  return rig;
}

std::string refusal(const std::string& toml) {
  const auto options = options_from(toml);
  return options ? "accepted" : options.error().message;
}

std::string misfit(const std::string& toml, Axis axis) {
  auto options = options_from(toml);
  if (!options) return "refused by itself: " + options.error().message;
  const Status fit = fit_to_rig(*options, rig_of(axis));
  return fit ? "accepted" : fit.error().message;
}

TEST(SimulatorOptions, EmptyTableGivesTheDefaults) {
  auto options = options_from("");
  ASSERT_TRUE(options) << options.error().message;
  ASSERT_TRUE(fit_to_rig(*options, rig_of(Axis::y)));
  EXPECT_EQ(options->targets_mm.size(), 13u);
  EXPECT_EQ(options->targets_mm.back(), 60);
  ASSERT_EQ(options->errors.size(), 5u);
  EXPECT_EQ(options->errors[0].name, "EXY");
  EXPECT_NE(options->errors[0].amplitude, 0);
}

TEST(SimulatorOptions, ReadsEveryKey) {
  const auto options = options_from(R"(
    rate_hz = 4000
    packet_ms = 5
    pace = "fast"
    loop = false
    seed = -7
    targets_mm = [-1, 0, 2.5]
    overrun_mm = 3
    repeats = 2
    dwell_s = 0.25
    speed_mm_s = 10
    acceleration_mm_s2 = 100
    settle_um = 1
    settle_hz = 30
    settle_s = 0.2
    noise_um = 0.02
    encoder_noise_nm = 7
    encoder_resolution_nm = 50
    spike_probability = 0.001
    spike_um = 30
    [saturation]
    probability = 0.01
    length_s = 0.02
    [gap]
    probability = 0.03
    length_s = 0.04
    [[error]]
    name = "EYX"
    amplitude_um = 1
    period_mm = 20
    phase_turns = 0.5
    slope_um_per_mm = 0.1
    reversal_um = 0.2
    [[error]]
    name = "ECX"
    amplitude_urad = 2
    slope_urad_per_mm = 0.3
    reversal_urad = 0.4
    [[lost]]
    probe = "C"
    from_s = 1
    to_s = 2
    [[disconnect]]
    from_s = 3
    to_s = 4)");
  ASSERT_TRUE(options) << options.error().message;
  EXPECT_EQ(options->rate_hz, 4000);
  EXPECT_EQ(options->packet_ms, 5);
  EXPECT_FALSE(options->real_time);
  EXPECT_FALSE(options->loop);
  EXPECT_EQ(options->seed, -7);
  EXPECT_EQ(options->targets_mm, (std::vector<double>{-1, 0, 2.5}));
  EXPECT_EQ(options->overrun_mm, 3);
  EXPECT_EQ(options->repeats, 2);
  EXPECT_EQ(options->dwell_s, 0.25);
  EXPECT_EQ(options->speed_mm_s, 10);
  EXPECT_EQ(options->acceleration_mm_s2, 100);
  EXPECT_EQ(options->settle_um, 1);
  EXPECT_EQ(options->settle_hz, 30);
  EXPECT_EQ(options->settle_s, 0.2);
  EXPECT_EQ(options->noise_um, 0.02);
  EXPECT_EQ(options->encoder_noise_nm, 7);
  EXPECT_EQ(options->encoder_resolution_nm, 50);
  EXPECT_EQ(options->spike_probability, 0.001);
  EXPECT_EQ(options->spike_um, 30);
  EXPECT_EQ(options->saturation.probability, 0.01);
  EXPECT_EQ(options->saturation.length_s, 0.02);
  EXPECT_EQ(options->gap.probability, 0.03);
  EXPECT_EQ(options->gap.length_s, 0.04);
  ASSERT_EQ(options->errors.size(), 2u);
  EXPECT_EQ(options->errors[0].period_mm, 20);
  EXPECT_EQ(options->errors[0].phase_turns, 0.5);
  EXPECT_EQ(options->errors[0].slope_per_mm, 0.1);
  EXPECT_EQ(options->errors[0].reversal, 0.2);
  EXPECT_EQ(options->errors[1].amplitude, 2);
  EXPECT_EQ(options->errors[1].slope_per_mm, 0.3);
  ASSERT_EQ(options->lost.size(), 1u);
  EXPECT_EQ(options->lost[0].probe, "C");
  EXPECT_EQ(options->lost[0].when.to_s, 2);
  ASSERT_EQ(options->disconnects.size(), 1u);
  EXPECT_EQ(options->disconnects[0].from_s, 3);
}

TEST(SimulatorOptions, SpacedTargetsJitterByTheSeedWithinBounds) {
  const std::string spacing = "from_mm = 10\nto_mm = 50\ninterval_mm = 2\njitter_mm = 0.5\n";
  const auto first = options_from("seed = 1\n" + spacing);
  const auto again = options_from("seed = 1\n" + spacing);
  const auto other = options_from("seed = 2\n" + spacing);
  ASSERT_TRUE(first && again && other);
  ASSERT_EQ(first->targets_mm.size(), 21u);
  EXPECT_EQ(first->targets_mm, again->targets_mm);
  EXPECT_NE(first->targets_mm, other->targets_mm);
  for (std::size_t i = 0; i < 21; ++i) {
    const double offset_mm = first->targets_mm[i] - (10 + 2.0 * static_cast<double>(i));
    EXPECT_LE(std::abs(offset_mm), 0.5);
    EXPECT_NE(offset_mm, 0);
  }
}

TEST(SimulatorOptions, RefusesImpossibleValuesWithKeyAndLine) {
  for (const char* bad : {"rate_hz = 0",
                          "rate_hz = 10001",
                          "rate_hz = nan",
                          "rate_hz = \"fast\"",
                          "packet_ms = 0",
                          "pace = \"slow\"",
                          "loop = 1",
                          "seed = 1.5",
                          "repeats = 0",
                          "repeats = 5000000000",
                          "dwell_s = -1",
                          "speed_mm_s = 0",
                          "acceleration_mm_s2 = inf",
                          "targets_mm = []",
                          "targets_mm = [1, 1]",
                          "targets_mm = [2, 1]",
                          "targets_mm = [1e30]",
                          "targets_mm = [nan]",
                          "noise_um = -0.1",
                          "spike_probability = 1.01",
                          "encoder_resolution_nm = -1"}) {
    const std::string key = std::string(bad).substr(0, std::string(bad).find(' '));
    const std::string message = refusal("\n" + std::string(bad));
    EXPECT_NE(message.find("mdofd.toml:2: " + key), std::string::npos) << bad << " → " << message;
  }
}

TEST(SimulatorOptions, RefusesContradictoryKeys) {
  EXPECT_NE(refusal("targets_mm = [1, 2]\nfrom_mm = 0").find("from_mm: contradicts"),
            std::string::npos);
  EXPECT_NE(refusal("from_mm = 5\nto_mm = 5").find("to_mm: must be greater"), std::string::npos);
  EXPECT_NE(refusal("interval_mm = 0.001").find("interval_mm: gives more"), std::string::npos);
  EXPECT_NE(refusal("interval_mm = 1\njitter_mm = 0.5").find("jitter_mm"), std::string::npos);
  EXPECT_NE(refusal("[[lost]]\nprobe = \"A\"\nfrom_s = 2\nto_s = 2").find("to_s"),
            std::string::npos);
  EXPECT_NE(refusal("[[disconnect]]\nfrom_s = -1\nto_s = 2").find("from_s"), std::string::npos);
  EXPECT_NE(refusal("[[disconnect]]\nto_s = 2").find("from_s: is missing"), std::string::npos);
  EXPECT_NE(refusal("[gap]\nlength_s = 0").find("gap.length_s"), std::string::npos);
}

TEST(SimulatorOptions, UnknownKeyErrorNamesTheNearestKey) {
  EXPECT_NE(refusal("noise_mu = 1").find("noise_um"), std::string::npos);
  EXPECT_NE(refusal("[[error]]\nname = \"EAX\"\namplitude_um = 1").find("amplitude_urad"),
            std::string::npos);
  EXPECT_NE(refusal("[gap]\nprobabilty = 1").find("probability"), std::string::npos);
}

TEST(SimulatorOptions, RefusesOptionsThatDoNotFitTheRig) {
  const std::string eyx = "[[error]]\nname = \"EYX\"\n";
  EXPECT_EQ(misfit(eyx, Axis::x), "accepted");
  EXPECT_NE(misfit(eyx, Axis::y).find("EYX"), std::string::npos);
  EXPECT_NE(misfit(eyx, Axis::y).find("EXY EZY EAY EBY ECY"), std::string::npos);
  EXPECT_NE(misfit(eyx + eyx, Axis::x).find("given twice"), std::string::npos);
  EXPECT_NE(misfit("[[lost]]\nprobe = \"Q\"\nfrom_s = 0\nto_s = 1", Axis::x).find("\"Q\""),
            std::string::npos);
}

TEST(SimulatorOptions, ErrorsThatAreNotGivenAreZero) {
  auto options = options_from("[[error]]\nname = \"EBX\"\namplitude_urad = 3\n");
  ASSERT_TRUE(options);
  ASSERT_TRUE(fit_to_rig(*options, rig_of(Axis::x)));
  ASSERT_EQ(options->errors.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(options->errors[i].amplitude, i == 3 ? 3 : 0);
}

}  // namespace
}  // namespace mdof::drivers
