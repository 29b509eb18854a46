#include "algo/machine/budget/budget.h"

#include <gtest/gtest.h>

#include "algo/machine/budget/trials.h"
#include "algo/sensitivity/statistics/statistics.h"
#include "tests/algo/machine/random_machine.h"

namespace mdof::algo {
namespace {

const char* const kChains[] = {"XYZ", "XYZC", "XYZABC", "XYZmn", "XYZBmnopqrstuv"};
constexpr SourceShape kShapes[] = {SourceShape::normal, SourceShape::rectangular,
                                   SourceShape::triangular, SourceShape::u_shaped};

// Adds sources. Each source acts on up to four errors, and some act on location errors of axes.
void add_sources(Machine& machine, test::RandomMachines& random, int count) {
  for (int i = 0; i < count; ++i) {
    ErrorSource source{
        "source " + std::to_string(i), "um", random.between(0.1, 1), kShapes[i % 4], {}};
    for (int e = 0; e <= i % 4; ++e) {
      SourceEffect effect;
      effect.frame = static_cast<std::size_t>(
          random.between(0, static_cast<double>(machine.frames.size()) - 0.001));
      effect.k = static_cast<std::size_t>(random.between(0, 5.999));
      const MachineFrame& frame = machine.frames[effect.frame];
      effect.of_line = e == 1 && has_location(frame, effect.k);
      effect.factor = random.between(-1e-4, 1e-4);
      effect.of = static_cast<std::size_t>(machine.find("X") - machine.frames.data());
      if (e == 2) effect.factor_per_position = random.between(-1e-4, 1e-4);
      source.acts_on.push_back(effect);
    }
    machine.sources.push_back(source);
  }
}

// A copy of the machine in which each source has a value, in the unit of the source. The effects of
// the sources are added to the errors.
Machine with_sources_at(Machine machine, const Command& at, const std::vector<double>& value) {
  for (std::size_t s = 0; s < machine.sources.size(); ++s)
    for (const SourceEffect& e : machine.sources[s].acts_on) {
      const double by = (e.factor + e.factor_per_position * at[0]) * value[s];
      MachineFrame& frame = machine.frames[e.frame];
      if (e.of_line)
        frame.location[e.k].value = frame.location[e.k].value.value_or(0) + by;
      else if (frame.error[e.k].known())
        for (double& f : frame.error[e.k].forward) f += by;
      else
        frame.error[e.k].forward = {by};
    }
  return machine;
}

Machine without_errors(Machine machine) {
  for (MachineFrame& frame : machine.frames) {
    frame.error = {};
    frame.location = {};
  }
  return machine;
}

std::array<double, 4> single_trial(const ScalableExperiment& trials, std::uint64_t i) {
  std::array<double, 4> out{};
  double* const at[4] = {&out[0], &out[1], &out[2], &out[3]};
  trials.run(i, 1, 1, at);
  return out;
}

BudgetModel model_of(const Machine& machine, const Command& at,
                     BudgetStage stage = BudgetStage::designed) {
  return budget_model(machine, at, MachineApproach::mean, stage).value();
}

// The expected tool error comes from the long double matrices of random_machine.h, which shares no
// code with the kernel. Limit: 1e-9 µm.
TEST(MachineBudgetTrials, MatchTheProductOfMatrices) {
  test::RandomMachines random(11);
  for (int i = 0; i < 60; ++i) {
    auto machine = without_errors(random.machine(kChains[i % 5], 0, 0, 0.3));
    add_sources(machine, random, 12);
    const auto at = random.command(0.3);
    const auto trials = budget_trials(model_of(machine, at), 7);
    for (std::uint64_t trial = 0; trial < 20; ++trial) {
      std::vector<double> value;
      for (const auto& [name, x] : trials->inputs(trial)) value.push_back(x);
      ASSERT_EQ(value.size(), machine.sources.size());
      const auto truth = test::true_error(with_sources_at(machine, at, value), at);
      const auto error = single_trial(*trials, trial);
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(error[k], static_cast<double>(truth.place[k]) * 1e6, 1e-9);
      EXPECT_NEAR(error[3], std::hypot(error[0], error[1], error[2]), 1e-12);
    }
  }
}

// A source changes all errors that it acts on together. Limit: 1e-9 of the sensitivity.
TEST(MachineBudget, SensitivitiesMatchDifferencesOfTheExactError) {
  test::RandomMachines random(12);
  for (int i = 0; i < 40; ++i) {
    auto machine = without_errors(random.machine(kChains[i % 5], 0, 0, 0.3));
    add_sources(machine, random, 8);
    const auto at = random.command(0.3);
    const auto model = model_of(machine, at);
    for (std::size_t s = 0; s < machine.sources.size(); ++s) {
      const auto with = [&](double x) {
        std::vector<double> value(machine.sources.size());
        value[s] = x;
        const auto m = with_sources_at(machine, at, value);
        return Eigen::Vector3d(
            exact_error(m, at, values_at(m, at, MachineApproach::mean)).head<3>());
      };
      constexpr double h = 10;  // errors up to 1 mrad
      const Eigen::Vector3d slope =
          (8 * (with(h) - with(-h)) - (with(2 * h) - with(-2 * h))) / (12 * h);
      const Eigen::Vector3d& c = model.causes[s].sensitivity;
      EXPECT_LT((slope - c).norm(), 1e-9 * std::max(c.norm(), 1e-6)) << i << " " << s;
    }
  }
}

TEST(MachineBudgetTrials, SameBitsForAnyInstructionSetAndBlockSize) {
  test::RandomMachines random(13);
  auto machine = random.machine("XYZBmno", 0, 0, 0.3);
  machine = without_errors(machine);
  add_sources(machine, random, 9);  // an odd number: half of the last block of draws is not used
  const auto model = model_of(machine, random.command(0.3));
  constexpr std::size_t n = 700;
  const auto all_of = [&](InstructionSet set, std::size_t cut) {
    const auto trials = budget_trials(model, 5, set);
    std::vector<double> out(4 * n);
    for (std::size_t i = 0; i < n; i += cut) {
      double* const at[4] = {&out[i], &out[n + i], &out[2 * n + i], &out[3 * n + i]};
      trials->run(i, 1, std::min(cut, n - i), at);
    }
    return out;
  };
  const auto expected = all_of(InstructionSet::baseline, n);
  for (const InstructionSet set : available_instruction_sets())
    for (const std::size_t cut : {n, std::size_t{1}, std::size_t{37}})
      EXPECT_EQ(all_of(set, cut), expected) << to_string(set) << " " << cut;
}

// For each shape of the distribution, u is its standard deviation; `scale` multiplies u.
TEST(MachineBudgetTrials, ShapesHaveTheDeclaredU) {
  for (const SourceShape shape : kShapes) {
    Machine machine;
    machine.frames.resize(1);
    machine.frames[0].id = "X";
    machine.frames[0].kind = FrameKind::linear;
    machine.sources = {{"s", "um", 0.4, shape, {{0, 1, false, 1e-6, 0, 0}}}};
    const auto trials = budget_trials(model_of(machine, {}), 3);
    constexpr std::size_t n = 200'000;
    std::vector<double> out(4 * n);
    double* const at[4] = {&out[0], &out[n], &out[2 * n], &out[3 * n]};
    trials->run(0, 1, n, at);
    double square = 0, most = 0;
    for (std::size_t j = n; j < 2 * n; ++j) {
      square += out[j] * out[j];
      most = std::max(most, std::abs(out[j]));
    }
    EXPECT_NEAR(std::sqrt(square / n), 0.4, 0.003) << to_string(shape);
    const double half_width = shape == SourceShape::rectangular  ? std::sqrt(3.0)
                              : shape == SourceShape::triangular ? std::sqrt(6.0)
                              : shape == SourceShape::u_shaped   ? std::sqrt(2.0)
                                                                 : most / 0.4;
    EXPECT_NEAR(most, 0.4 * half_width, shape == SourceShape::triangular ? 0.01 : 1e-4);
    const double first = out[n], scale = 2;
    trials->run_scaled({&scale, 1}, 0, 1, 1, at);
    EXPECT_NEAR(out[n], 2 * first, 1e-12);
  }
}

double volume_p95_um(const Machine& machine) {
  const auto trials = budget_trials(model_of(machine, {}), 1);
  StudyStatistics statistics(*trials, pilot_scale(*trials));
  statistics.add_block(*trials, 0, std::uint64_t{512} * 4000);
  return statistics.overall({0.95, {0.95}})[3].quantiles[0].value;
}

// Table 2 of the paper: three screws of ±0.5 µm, compared with four independent causes.
TEST(MachineBudget, TreatsOneScrewAsOneCause) {
  auto machine = parse_machine(co_planar_machine(), "co-planar").value();
  EXPECT_NEAR(volume_p95_um(machine), 0.645, 0.001);
  const auto model = model_of(machine, {});
  const Eigen::Vector3d most = budget_u_m(model) * std::sqrt(3.0) * 1e6;
  EXPECT_NEAR(most[0], 0.450, 5e-4);
  EXPECT_NEAR(most[1], 0.242, 5e-4);
  // The effects of one screw on several joints partly cancel. The effects of independent causes at
  // the joints do not.
  ErrorSource one = machine.sources[0];
  machine.sources.clear();
  for (const char* name : {"X", "Y", "Z", "joint-10"}) {
    const std::size_t frame = static_cast<std::size_t>(machine.find(name) - machine.frames.data());
    one.name = name;
    one.acts_on = {{frame, name[0] == 'j' ? 2u : std::size_t(name[0] - 'X'), false, 1e-6, 0, 0}};
    machine.sources.push_back(one);
  }
  EXPECT_NEAR(volume_p95_um(machine), 0.890, 0.002);
}

TEST(MachineBudget, MeasuredErrorsReplaceAssumedOnes) {
  auto machine = parse_machine(co_planar_machine(), "co-planar").value();
  const std::size_t x = static_cast<std::size_t>(machine.find("X") - machine.frames.data());
  // EXX is measured as 3 and -4 µm with u = 0.1 µm. Its root mean square is 3.536 µm.
  machine.frames[x].error[0] = {{0, 0.06}, {3e-6, -4e-6}, {}, {1e-7, 1e-7}, {}};
  const Command at = {0.06, 0, 0, 0, 0, 0};
  const auto designed = model_of(machine, at);
  const auto measured = model_of(machine, at, BudgetStage::measured);
  EXPECT_EQ(measured.replaced, (std::vector<std::string>{"screw B on EXX", "tilt of X on EXX"}));
  // The designed budget contains 0.9 times the screw, and 25.4 µm from the tilt over 60 mm. It does
  // not use the measured value.
  EXPECT_NEAR(budget_u_m(designed)[0] * 1e6, std::hypot(0.9 * 0.288675, 25.357), 0.001);
  EXPECT_EQ(designed.values[x].error[0], 0);
  EXPECT_NEAR(budget_u_m(measured)[0] * 1e6, 0.1, 1e-9);
  EXPECT_EQ(measured.values[x].error[0], -4e-6);
  // Joint 10 is not measured, so the screw of B still acts on it.
  EXPECT_NEAR(budget_u_m(measured)[2], budget_u_m(designed)[2], 1e-15);
  const auto rows = designed_against_measured(machine, at);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].name, "EXX");
  // The tilt has no effect at 0 mm. Its mean square over the table is half of that at 60 mm.
  EXPECT_NEAR(rows[0].designed_effect_m * 1e6, std::hypot(0.2598, 25.357 / std::sqrt(2.0)), 0.001);
  EXPECT_NEAR(rows[0].measured_effect_m * 1e6, std::sqrt(12.5 + 0.01), 1e-9);
}

TEST(MachineBudget, RefusesACauseTooLargeForTheModel) {
  auto machine = parse_machine(co_planar_machine(), "co-planar").value();
  machine.sources[1].u = 1e5;
  const auto model = budget_model(machine, {}, MachineApproach::mean, BudgetStage::designed);
  ASSERT_FALSE(model);
  EXPECT_NE(model.error().message.find("screw C"), std::string::npos);
}

// A source can act on an error of a body or on the location error of an axis line. These errors are
// different.
TEST(MachineBudget, SeparatesErrorsOfLinesAndBodies) {
  auto machine = parse_machine(co_planar_machine(), "co-planar").value();
  const auto x = static_cast<std::size_t>(machine.find("X") - machine.frames.data());
  const auto with_source = [&](bool of_line, double u) {
    Machine m = machine;
    m.sources.clear();
    ErrorSource source{"one", "urad", u, SourceShape::normal, {}};
    source.acts_on = {{x, 5, of_line, 1e-6, 0, 0}};
    m.sources.push_back(source);
    return budget_model(m, {0.03, 0, 0, 0, 0, 0}, MachineApproach::mean, BudgetStage::designed);
  };
  const auto names = [](const BudgetModel& model) {
    return std::find(model.not_declared.begin(), model.not_declared.end(), "ECX") !=
           model.not_declared.end();
  };
  ASSERT_TRUE(with_source(false, 1));
  EXPECT_FALSE(names(*with_source(false, 1)));
  if (!has_location(machine.frames[x], 5)) return;
  ASSERT_TRUE(with_source(true, 1));
  EXPECT_TRUE(names(*with_source(true, 1)));
  // The message reports the error that is too large.
  const auto body = with_source(false, 1e6), line = with_source(true, 1e6);
  ASSERT_FALSE(body);
  ASSERT_FALSE(line);
  EXPECT_NE(
      body.error().message.find("ECX at the commanded position can exceed the limit of 0.1 rad"),
      std::string::npos)
      << body.error().message;
  EXPECT_EQ(line.error().message.find("ECX at the commanded position can exceed"),
            std::string::npos)
      << line.error().message;
}

// The error plus the largest value of the source (largest value for u = 1, times u) must be below
// 10 mm.
TEST(MachineBudget, RefusesACauseByItsLargestValue) {
  const auto exceeds_limit = [](SourceShape shape, double u_um, double value_m) {
    Machine machine;
    machine.frames.resize(1);
    machine.frames[0].id = "X";
    machine.frames[0].kind = FrameKind::linear;
    machine.frames[0].error[1].forward = {value_m};
    machine.sources = {{"s", "um", u_um, shape, {{0, 1, false, 1e-6, 0, 0}}}};
    return !budget_model(machine, {}, MachineApproach::mean, BudgetStage::designed);
  };
  for (const auto& [shape, reach] :
       {std::pair(SourceShape::rectangular, std::sqrt(3.0)),
        std::pair(SourceShape::triangular, std::sqrt(6.0)),
        std::pair(SourceShape::u_shaped, std::sqrt(2.0)), std::pair(SourceShape::normal, 8.5)}) {
    EXPECT_FALSE(exceeds_limit(shape, 0.99 * 10e3 / reach, 0)) << to_string(shape);
    EXPECT_TRUE(exceeds_limit(shape, 1.01 * 10e3 / reach, 0)) << to_string(shape);
  }
}

// The limits are 10 mm for the three displacements and 0.1 rad for the three angles. The message
// reports the error.
TEST(MachineBudget, EachErrorOfABodyHasItsLimit) {
  const auto refusal = [](std::size_t k, double u) {
    Machine machine;
    machine.frames.resize(1);
    machine.frames[0].id = "Y";
    machine.frames[0].kind = FrameKind::linear;
    machine.sources = {{"s", "um", u, SourceShape::rectangular, {{0, k, false, -1e-6, 0, 0}}}};
    const auto model = budget_model(machine, {}, MachineApproach::mean, BudgetStage::designed);
    return model ? std::string() : model.error().message;
  };
  const char* const names[] = {"EXY", "EYY", "EZY", "EAY", "EBY", "ECY"};
  for (std::size_t k = 0; k < kBodyErrors; ++k) {
    const double u = (k < 3 ? 10e3 : 100e3) / std::sqrt(3.0);
    EXPECT_EQ(refusal(k, 0.99 * u), "") << k;
    const std::string said = refusal(k, 1.01 * u);
    EXPECT_NE(said.find(std::string(names[k]) + " at the commanded position"), std::string::npos)
        << said;
    EXPECT_NE(said.find(k < 3 ? "10 mm" : "0.1 rad"), std::string::npos) << said;
  }
}

// Each of three causes moves one coordinate. Marked causes have the values of a second, independent
// draw.
TEST(MachineBudgetTrials, MixedTrialsTakeTheMarkedCausesFromTheSecondDraw) {
  Machine machine;
  machine.frames.resize(1);
  machine.frames[0].id = "X";
  machine.frames[0].kind = FrameKind::linear;
  for (std::size_t k = 0; k < 3; ++k)
    machine.sources.push_back(
        {"s" + std::to_string(k), "um", 0.5, kShapes[k], {{0, k, false, 1e-6, 0, 0}}});
  const auto trials = budget_trials(model_of(machine, {}), 3);
  constexpr std::size_t n = 300;
  const auto mixed = [&](const std::vector<std::uint8_t>& second) {
    std::vector<double> out(4 * n);
    double* const at[4] = {&out[0], &out[n], &out[2 * n], &out[3 * n]};
    trials->run_mixed(second, 5, 2, n, at);
    return out;
  };
  const auto first = mixed({0, 0, 0}), other = mixed({1, 1, 1});
  std::vector<double> plain(4 * n);
  double* const at[4] = {&plain[0], &plain[n], &plain[2 * n], &plain[3 * n]};
  trials->run(5, 2, n, at);
  EXPECT_EQ(first, plain);
  for (int marked = 0; marked < 8; ++marked) {
    std::vector<std::uint8_t> second;
    for (int k = 0; k < 3; ++k) second.push_back(static_cast<std::uint8_t>((marked >> k) & 1));
    const auto out = mixed(second);
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t j = k * n; j < (k + 1) * n; ++j)
        ASSERT_EQ(out[j], second[k] ? other[j] : first[j]) << marked << " " << j;
  }
  double product = 0, square = 0;
  for (std::size_t j = 0; j < 3 * n; ++j) {
    product += first[j] * other[j];
    square += first[j] * first[j];
  }
  // The correlation of 900 independent numbers is about 1/30.
  EXPECT_LT(std::abs(product), 0.15 * square);
}

// EXX is 1 and 3 µm forward, 3 and 5 µm reverse. Its means are 2 and 4 µm with u = 0.5 µm. EYY is 6
// µm.
TEST(MachineBudget, ComparesDesignedAndMeasuredByHand) {
  auto machine = parse_machine(co_planar_machine(), "co-planar").value();
  machine.sources.clear();
  const auto x = static_cast<std::size_t>(machine.find("X") - machine.frames.data());
  const auto y = static_cast<std::size_t>(machine.find("Y") - machine.frames.data());
  machine.frames[x].error[0] = {{0, 0.06}, {1e-6, 3e-6}, {3e-6, 5e-6}, {5e-7, 5e-7}, {}};
  machine.frames[y].error[1] = {{}, {6e-6}, {}, {}, {}};
  for (const double u : {3.0, 4.0}) {
    ErrorSource source{"s", "um", u, SourceShape::normal, {}};
    source.acts_on = {{x, 0, false, 1e-6, 0, 0}, {y, 2, false, 1e-6, 0, 0}};
    machine.sources.push_back(source);
  }
  const auto rows = designed_against_measured(machine, {});
  ASSERT_EQ(rows.size(), 2u);  // EYY has no design value and comes first
  EXPECT_EQ(rows[0].name, "EYY");
  EXPECT_FALSE(rows[0].has_design);
  EXPECT_EQ(rows[0].k, 1u);
  EXPECT_EQ(rows[0].designed_u, 0);
  EXPECT_NEAR(rows[0].measured_u, 6e-6, 1e-18);
  EXPECT_EQ(rows[1].name, "EXX");
  EXPECT_TRUE(rows[1].has_design);
  EXPECT_NEAR(rows[1].designed_u, 5e-6, 1e-18);
  EXPECT_NEAR(rows[1].measured_u, 1e-6 * std::sqrt((4 + 16) / 2.0 + 0.25), 1e-18);
  // The tool moves by EXX, so the derivative is 1.
  EXPECT_NEAR(rows[1].measured_effect_m, rows[1].measured_u, 1e-18);
}

// EC0Y is 5 urad with u = 2 urad. The measured value of the budget is the root of the sum of both
// squares.
TEST(MachineBudget, ErrorOfALineIncludesItsUncertainty) {
  auto machine = parse_machine(co_planar_machine(), "co-planar").value();
  const auto y = static_cast<std::size_t>(machine.find("Y") - machine.frames.data());
  machine.frames[y].location[5] = {5e-6, 2e-6};
  auto rows = designed_against_measured(machine, {});
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].name, "EC0Y");
  EXPECT_NEAR(rows[0].measured_u, std::sqrt(29.) * 1e-6, 1e-18);
  machine.frames[y].location[5].u = std::nullopt;
  rows = designed_against_measured(machine, {});
  EXPECT_NEAR(rows[0].measured_u, 5e-6, 1e-18);
}

}  // namespace
}  // namespace mdof::algo
