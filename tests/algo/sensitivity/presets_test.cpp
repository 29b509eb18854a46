// The simulations of the paper are compared with their theory (algo/sensitivity/README.md derives
// it), with the scalar models, and with stored bits.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include "algo/model/small_angle/small_angle.h"
#include "algo/sensitivity/random.h"
#include "algo/sensitivity/simulation.h"
#include "algo/sensitivity/statistics/statistics.h"
#include "schema/base/sha256.h"
#include "schema/units.h"
#include "tests/algo/rigs.h"

namespace mdof::algo {
namespace {

using Columns = std::vector<std::vector<double>>;

Columns columns_of(const Experiment& experiment, std::uint64_t first, std::uint64_t step,
                   std::size_t n) {
  Columns columns(5, std::vector<double>(n));
  std::array<double*, 5> out{};
  for (std::size_t k = 0; k < 5; ++k) out[k] = columns[k].data();
  experiment.run(first, step, n, out);
  return columns;
}

std::string hash_of(const Columns& columns) {
  Sha256 sha;
  for (const auto& column : columns) {
    sha.update({reinterpret_cast<const char*>(column.data()), column.size() * sizeof(double)});
  }
  return sha.hex();
}

StudyStatistics study(const Experiment& experiment, std::uint64_t trials) {
  StudyStatistics s(experiment, pilot_scale(experiment));
  s.add_block(experiment, 0, trials);
  return s;
}

// First-order variance of each output of simulation II at the travel d_mm, in µm² and µrad².
std::array<double, 5> variance_at(const SimulationOptions& o, double d_mm) {
  const double A = from_urad(o.angle_range_urad), B_um = o.offset_range_um;
  const double d = d_mm * 1e3, l = o.l_mm * 1e3, up = o.side_height_mm * 1e3;  // µm
  const double r = o.radius_um, ty = o.theta_y_mrad / 1e3, tp = o.theta_p_mrad / 1e3;
  const double by_angle = A * A / 3, q = d / l;
  const double roll = ty * ty + r * r / (2 * l * l);
  const double pitch = ty * ty + 1.5 * r * r / (l * l);
  const double yaw = tp * tp + 2 * r * r / (l * l);
  const double z = std::pow(o.sigma_y_um + d * ty, 2) + o.sigma_x_um * o.sigma_x_um +
                   2 * r * r * ((1 - q) * (1 - q) / 4 + q * q / 2);
  const double y = std::pow(d * tp - o.sigma_z_um, 2) + std::pow(o.sigma_x_um + tp * up, 2) +
                   std::pow(up * ty, 2) + r * r * ((1 - q) * (1 - q) + q * q) +
                   std::pow(up * r / l, 2) / 2;
  const double products = std::pow(A, 4) / 9 * 1e12;
  return {by_angle * y + A * A * B_um * B_um / 9 + 4 * up * up * std::pow(A, 4) / 9,
          by_angle * z + A * A * B_um * B_um / 9, by_angle * roll * 1e12 + products,
          by_angle * pitch * 1e12 + products, by_angle * yaw * 1e12 + products};
}

TEST(Simulation1, SpreadAndExtremesMatchTheory) {
  const auto experiment = make_simulation(simulation_1_defaults()).value();
  const auto outputs = study(*experiment, 1'000'000).overall();
  const std::array<double, 5> sd = {std::sqrt(1 / 36.0 / 100 + 4.0 / 9 * 4e-4), 0.05 / 3, 1 / 3.0,
                                    1 / 3.0, 1 / 3.0};
  EXPECT_NEAR(sd[0], 0.0213437, 1e-7);
  const std::array<double, 5> extreme = {0.09, 0.05, 1, 1, 1};
  for (std::size_t k = 0; k < 5; ++k) {
    SCOPED_TRACE(outputs[k].key);
    EXPECT_EQ(outputs[k].n, 1'000'000u);
    EXPECT_NEAR(outputs[k].mean, 0, 5 * outputs[k].mean_se);
    EXPECT_NEAR(outputs[k].sd, sd[k], 5 * outputs[k].sd_se);
    EXPECT_NEAR(outputs[k].mean_se, sd[k] / 1e3, 1e-3 * sd[k]);
    // Only third-order terms exceed the calculated extremes. The extremes of the trials are close
    // to them.
    EXPECT_LT(outputs[k].max, extreme[k] * 1.002);
    EXPECT_GT(outputs[k].min, -extreme[k] * 1.002);
    EXPECT_GT(outputs[k].max, extreme[k] * (k == 0 ? 0.8 : 0.98));
    EXPECT_LT(outputs[k].min, -extreme[k] * (k == 0 ? 0.8 : 0.98));
  }
}

// The standard error of the standard deviation follows from the fourth moment. A product of two
// uniform quantities has the kurtosis 3.24.
TEST(Simulation1, StandardErrorOfTheSdMatchesTheFourthMoment) {
  const auto experiment = make_simulation(simulation_1_defaults()).value();
  const auto outputs = study(*experiment, 1'000'000).overall();
  EXPECT_NEAR(outputs[3].sd_se, outputs[3].sd * std::sqrt((3.24 - 1) / 4 / 1e6), 1e-6);
}

TEST(Simulation1, ErrorDoesNotDependOnTravel) {
  const auto experiment = make_simulation(simulation_1_defaults()).value();
  const auto bins = study(*experiment, 400'000).bins();
  ASSERT_EQ(bins.size(), 20u);
  EXPECT_EQ(bins.front().from, 0);
  EXPECT_EQ(bins.back().to, 60);
  for (const StudyBin& bin : bins) {
    EXPECT_NEAR(bin.outputs[0].sd, 0.0213437, 5 * bin.outputs[0].sd_se);
    EXPECT_NEAR(bin.outputs[1].sd, 0.05 / 3, 5 * bin.outputs[1].sd_se);
  }
}

TEST(Simulation2, SpreadAndLimitsMatchThePaper) {
  const SimulationOptions options = simulation_2_defaults();
  const auto experiment = make_simulation(options).value();
  const auto outputs = study(*experiment, 1'000'000).overall();
  std::array<double, 5> variance{};
  constexpr int kSteps = 1000;
  for (int i = 0; i < kSteps; ++i) {
    const auto at = variance_at(options, 10 * (i + 0.5) / kSteps);
    for (std::size_t k = 0; k < 5; ++k) variance[k] += at[k] / kSteps;
  }
  EXPECT_NEAR(std::sqrt(variance[2]), 1.2693, 1e-4);
  for (std::size_t k = 0; k < 5; ++k) {
    SCOPED_TRACE(outputs[k].key);
    const double limit = k < 2 ? 0.6 : 15;
    EXPECT_GT(outputs[k].min, -limit);
    EXPECT_LT(outputs[k].max, limit);
    EXPECT_NEAR(outputs[k].mean, 0, 5 * outputs[k].mean_se);
    EXPECT_NEAR(outputs[k].sd, std::sqrt(variance[k]), 5 * outputs[k].sd_se);
  }
}

TEST(Simulation2, TranslationalErrorGrowsWithTravelAsInTheory) {
  SimulationOptions options = simulation_2_defaults();
  options.travel_to_mm = 60;
  options.travel_bins = 6;
  const auto experiment = make_simulation(options).value();
  const auto bins = study(*experiment, 600'000).bins();
  ASSERT_EQ(bins.size(), 6u);
  for (const StudyBin& bin : bins) {
    std::array<double, 5> variance{};
    for (int i = 0; i < 1000; ++i) {
      const auto at = variance_at(options, bin.from + (bin.to - bin.from) * (i + 0.5) / 1000);
      for (std::size_t k = 0; k < 5; ++k) variance[k] += at[k] / 1000;
    }
    for (std::size_t k = 0; k < 5; ++k) {
      EXPECT_NEAR(bin.outputs[k].sd, std::sqrt(variance[k]), 5 * bin.outputs[k].sd_se)
          << bin.from << ' ' << bin.outputs[k].key;
    }
  }
  for (std::size_t i = 1; i < bins.size(); ++i) {
    EXPECT_GT(bins[i].outputs[1].sd, bins[i - 1].outputs[1].sd);
  }
  // EYX first decreases with the travel, because the offset σz and the rotation θp compensate each
  // other up to 25 mm.
  EXPECT_LT(bins[2].outputs[0].sd, bins[0].outputs[0].sd);
  EXPECT_GT(bins[5].outputs[0].sd, 1.2 * bins[0].outputs[0].sd);
}

// The kernel is compared with the scalar models of algo/small_angle. The readings come from a
// fixture with the probe positions of trial i, and the nominal fixture solves them. The simulation
// includes a side plane and all rotations.
TEST(Simulation2, EveryTrialMatchesTheScalarModels) {
  SimulationOptions o = simulation_2_defaults();
  o.side_plane_mm = 15;
  o.theta_r_mrad = 1.5;
  const SmallAngleFixture nominal =
      make_small_angle_fixture(make_fixture(test::rig_x()).value()).value();
  const auto experiment = make_simulation(o).value();
  const Columns columns = columns_of(*experiment, 0, 1, 200);
  for (std::size_t i = 0; i < 200; ++i) {
    const SimulationTrial t = simulation_trial(o, i).value();
    const double travel_m = from_mm(t.travel_mm);
    Errors5 truth{};
    for (std::size_t k = 0; k < 5; ++k) truth[k] = t.truth[k] / 1e6;
    SmallAngleFixture real = nominal;
    const double ty = o.theta_y_mrad / 1e3, tp = o.theta_p_mrad / 1e3, tr = o.theta_r_mrad / 1e3;
    for (std::size_t k = 0; k < 5; ++k) {
      const double turn = 2 * M_PI * t.probe_turns[k], r = from_um(o.radius_um);
      const double x = nominal.x[k] + r * std::cos(turn);
      const double across = nominal.across[k] + r * std::sin(turn);
      const double s = from_um(50);
      real.x[k] = k < 3 ? x - ty * across + s : x - ty * nominal.h + tp * across + s;
      real.across[k] = k < 3 ? across + ty * x + s : across + tr * nominal.h - tp * x + s;
    }
    const auto reading = exact_outputs(real, travel_m, truth);
    const Errors5 estimate = solve_small_angle(Model::simplified, nominal, travel_m, reading);
    for (std::size_t k = 0; k < 5; ++k) {
      EXPECT_NEAR(columns[k][i], (estimate[k] - truth[k]) * 1e6, 1e-8) << i << ' ' << k;
      EXPECT_EQ(columns[k][i], t.error[k]);
    }
  }
}

TEST(Simulations, UseTheRandomNumbersOfTheirAddresses) {
  const SimulationOptions o = simulation_2_defaults();
  const SimulationTrial t = simulation_trial(o, 8731).value();
  const Stream stream = {o.seed, 0};
  const double u = draw(stream, 8731, 0);
  EXPECT_NEAR(t.travel_mm, 10 * (8731 % 20 + u) / 20, 1e-12);
  EXPECT_NEAR(t.truth[0], 50 * (2 * draw(stream, 8731, 1) - 1), 1e-12);
  EXPECT_NEAR(t.truth[4], 1000 * (2 * draw(stream, 8731, 5) - 1), 1e-11);
  EXPECT_EQ(t.probe_turns[4], draw(stream, 8731, 10));
}

TEST(Simulations, SingleTrialEqualsTheBatchForAnyStep) {
  for (const auto& options : {simulation_1_defaults(), simulation_2_defaults()}) {
    const auto experiment = make_simulation(options).value();
    const Columns all = columns_of(*experiment, 0, 1, 1000);
    for (const std::size_t i : {0u, 1u, 19u, 20u, 777u, 999u}) {
      const SimulationTrial alone = simulation_trial(options, i).value();
      for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(alone.error[k], all[k][i]);
    }
    for (const std::uint64_t step : {3u, 20u, 40u}) {
      const Columns some = columns_of(*experiment, 5, step, 21);
      for (std::size_t j = 0; j < 21; ++j) {
        for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(some[k][j], all[k][5 + step * j]);
      }
    }
  }
}

// The bits were stored from g++ 12. clang++ and every instruction set must give the same bits.
TEST(Simulations, HaveTheStoredBits) {
  for (const InstructionSet set : available_instruction_sets()) {
    const auto hash = [set](const SimulationOptions& options) {
      return hash_of(columns_of(*make_simulation(options, set).value(), 0, 1, 100'000));
    };
    EXPECT_EQ(hash(simulation_1_defaults()),
              "310d08fae93b7849bcfb896b8a59979e894651bbe34f97738a3d3bfbb9bf65dc")
        << to_string(set);
    EXPECT_EQ(hash(simulation_2_defaults()),
              "1e3e743b519191eb5b09523cf530c6b356c5b68d3adb079a761b53fe466de6e1")
        << to_string(set);
  }
}

TEST(Simulations, AnotherSeedGivesOtherTrials) {
  SimulationOptions options;
  options.seed = 2;
  EXPECT_NE(simulation_trial(options, 0)->truth[0], simulation_trial({}, 0)->truth[0]);
}

TEST(Simulations, ErrorsNameTheInvalidOption) {
  const auto message = [](auto change) {
    SimulationOptions options;
    change(options);
    const auto made = make_simulation(options);
    return made ? std::string() : made.error().message;
  };
  using O = SimulationOptions;
  EXPECT_NE(message([](O& o) { o.radius_um = -1; }).find("radius_um"), std::string::npos);
  EXPECT_NE(message([](O& o) { o.l_mm = 0; }).find("l_mm"), std::string::npos);
  EXPECT_NE(message([](O& o) { o.travel_to_mm = -5; }).find("travel_to_mm"), std::string::npos);
  EXPECT_NE(message([](O& o) { o.travel_bins = 0; }).find("travel_bins"), std::string::npos);
  EXPECT_NE(message([](O& o) { o.sigma_x_um = NAN; }).find("sigma_x_um"), std::string::npos);
  EXPECT_NE(message([](O& o) { o.angle_range_urad = 1e6; }).find("angle"), std::string::npos);
  EXPECT_EQ(message([](O& o) { o.travel_bins = 1; }), "");
  EXPECT_EQ(message([](O& o) { o.travel_bins = 200; }), "");
  EXPECT_NE(message([](O& o) { o.travel_bins = 201; }).find("1 to 200"), std::string::npos);
}

// Four bins of 10 mm from 20 mm on. The travel of trial i is anywhere in bin i modulo 4.
TEST(Simulations, TravelBeginsAtTheGivenPosition) {
  SimulationOptions o;
  o.travel_from_mm = 20;
  o.travel_to_mm = 60;
  o.travel_bins = 4;
  double least = 1, most = 0;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const double in_bin = simulation_trial(o, i)->travel_mm - 20 - 10 * static_cast<double>(i % 4);
    EXPECT_GE(in_bin, 0) << i;
    EXPECT_LE(in_bin, 10) << i;
    least = std::min(least, in_bin / 10);
    most = std::max(most, in_bin / 10);
  }
  EXPECT_LT(least, 0.05);
  EXPECT_GT(most, 0.95);
}

}  // namespace
}  // namespace mdof::algo
