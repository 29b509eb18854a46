// The U of the ISO 230-2 parameters, for runs whose true visits are known. The tests calculate the
// parameters of the true visits separately and count how often the intervals contain them. Set
// MDOF_COVERAGE_RUNS=1000 to calculate figures for publication.
#include "algo/uncertainty/positioning/positioning_budgets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <random>

#include "algo/uncertainty/positioning/repeatability_interval.h"
#include "tests/algo/no_pattern.h"
#include "tests/algo/rigs.h"
#include "tests/algo/uncertainty/synthetic_run.h"

namespace mdof::algo {
namespace {

constexpr std::size_t kYawOfCases = 4;  // ECX, from which no line is removed

int requested_run_count() {
  const char* runs = std::getenv("MDOF_COVERAGE_RUNS");
  return runs ? std::atoi(runs) : 40;
}

using ParameterValues = std::map<std::string, double>;
using TrueVisits = std::map<int, std::map<int, std::vector<double>>>;  // by target and direction

ParameterValues parameters(const TrueVisits& visits) {
  ParameterValues p{{"B", 0}, {"R", 0}};
  double lowest = 1e9, highest = -1e9, low_mean = 1e9, high_mean = -1e9, signed_sum = 0;
  for (const auto& [target, ways] : visits) {
    std::map<int, double> mean, s;
    for (const auto& [way, values] : ways) {
      double sum = 0, square = 0;
      for (const double v : values) sum += v;
      mean[way] = sum / static_cast<double>(values.size());
      for (const double v : values) square += std::pow(v - mean[way], 2);
      s[way] = std::sqrt(square / (static_cast<double>(values.size()) - 1));
      lowest = std::min(lowest, mean[way]);
      highest = std::max(highest, mean[way]);
    }
    low_mean = std::min(low_mean, (mean[1] + mean[-1]) / 2);
    high_mean = std::max(high_mean, (mean[1] + mean[-1]) / 2);
    const double B = mean[1] - mean[-1];
    signed_sum += B;
    p["B"] = std::max(p["B"], std::abs(B));
    p["R"] = std::max({p["R"], 2 * s[1] + 2 * s[-1] + std::abs(B), 4 * s[1], 4 * s[-1]});
  }
  p["B mean"] = signed_sum / static_cast<double>(visits.size());
  p["E"] = highest - lowest;
  p["M"] = high_mean - low_mean;
  return p;
}

struct AxisCase {
  int runs = 3;
  double form_rad = 0, reversal_rad = 0, scatter_rad = 0;  // yaw of the axis
  double noise_m = 40e-9;
  double gain = 0;  // declared standard uncertainty of the gain of D
};

struct CoveredParameter {
  int inside = 0, all = 0;
  double U = 0, square = 0;
};

std::map<std::string, CoveredParameter> count_covered_parameters(const AxisCase& c) {
  std::mt19937_64 engine(17);
  std::normal_distribution<> normal;
  const Rig rig = c.gain > 0
                      ? test::rig_x_with("D", "u_sensitivity_ppm = " + std::to_string(1e6 * c.gain))
                      : test::rig_x_with("", "");
  std::map<std::string, CoveredParameter> all;
  for (int i = 0; i < requested_run_count(); ++i) {
    SyntheticRun synthetic{.rig = rig, .model = Model::simplified, .runs = c.runs};
    const std::size_t targets = synthetic.targets_m.size();
    TrueVisits axis, visits;  // without and with the scatter of the axis
    std::size_t visit = 0;
    synthetic.truth = [&](double d) {
      const int way = visit++ / targets % 2 == 0 ? 1 : -1;
      const double yaw = c.form_rad * std::sin(110 * d) + way * c.reversal_rad / 2;
      const double now = yaw + c.scatter_rad * normal(engine);
      const int target = static_cast<int>(std::lround(d / 5e-3));
      axis[target][way].push_back(yaw);
      visits[target][way].push_back(now);
      return Errors5{0, 0, 0, 0, now};
    };
    const double gain = c.gain * normal(engine);
    synthetic.added = [&](std::size_t k, double, double reading_m, double) {
      return c.noise_m * normal(engine) + (k == 3 ? gain * reading_m : 0.0);
    };
    synthetic.u_reading_m = c.noise_m;
    const Run run = synthetic.measure();
    TrueVisits measured;
    for (const MeasuredPoint& p : run.points)
      measured[p.target][p.point.direction].push_back(p.errors.local[kEz]);
    const auto U = run_positioning_uncertainty(rig, run, kYawOfCases, false).value();
    const std::map<std::string, double> by_name = {
        {"B", U.B}, {"B mean", U.B_mean}, {"R", U.R}, {"E", U.E}, {"M", U.M}};
    const ParameterValues of_axis = parameters(axis), of_visits = parameters(visits),
                          found = parameters(measured);
    for (const auto& [name, value] : found) {
      if (c.runs == 1 && name == "R") continue;
      const double off = value - (name == "R" ? of_visits : of_axis).at(name);
      CoveredParameter& of = all[name];
      ++of.all;
      of.inside += std::abs(off) <= by_name.at(name);
      of.U += by_name.at(name) / requested_run_count();
      of.square += off * off / requested_run_count();
    }
  }
  for (const auto& [name, of] : all)
    std::printf("%-7s %5.1f %%, U / 1.96 rms error %.2f\n", name.c_str(),
                100.0 * of.inside / of.all, of.U / 1.96 / std::sqrt(of.square));
  return all;
}

double least_percent() {
  return 95 - 65 / std::sqrt(requested_run_count());  // within three standard deviations
}

void expect_parameter_coverage(const std::map<std::string, CoveredParameter>& all, double most_U) {
  for (const auto& [name, of] : all) {
    EXPECT_GT(100.0 * of.inside / of.all, least_percent()) << name;
    EXPECT_LT(of.U / 1.96 / std::sqrt(of.square), most_U) << name;
  }
}

TEST(PositioningBudgets, IntervalsCoverAPerfectAxis) {
  for (const int runs : {1, 5}) {
    SCOPED_TRACE(runs);
    expect_parameter_coverage(count_covered_parameters({.runs = runs}), 1.6);
  }
}

TEST(PositioningBudgets, IntervalsCoverAnAxisThatScatters) {
  expect_parameter_coverage(
      count_covered_parameters(
          {.runs = 5, .form_rad = 200e-6, .reversal_rad = 60e-6, .scatter_rad = 20e-6}),
      1.5);
}

TEST(PositioningBudgets, IntervalsCoverADeclaredGain) {
  const AxisCase gain{.runs = 3,
                      .form_rad = 200e-6,
                      .reversal_rad = 60e-6,
                      .scatter_rad = 20e-6,
                      .noise_m = 5e-9,
                      .gain = 0.05};
  const auto all = count_covered_parameters(gain);
  expect_parameter_coverage(all, 1.6);
  EXPECT_GT(all.at("R").square, std::pow(1e-6, 2));
}

TEST(PositioningBudgets, HasNoRForASingleRun) {
  const Rig rig = test::rig_x_with("", "");
  SyntheticRun synthetic{.rig = rig, .model = Model::simplified, .runs = 1};
  synthetic.truth = [](double d) { return Errors5{1e-2 * d * d, 0, 0, 0, 1e-2 * d}; };
  synthetic.u_reading_m = 40e-9;
  const auto U = run_positioning_uncertainty(rig, synthetic.measure(), kYawOfCases, false).value();
  EXPECT_TRUE(std::isnan(U.R));
  EXPECT_TRUE(std::isnan(U.R_forward));
  EXPECT_GT(U.E, 0);
  EXPECT_NE(U.covers.find("approached twice from the same direction"), std::string::npos)
      << U.covers;
}

// Calculated by hand: D and E are 10 mm apart and have the noise u, so the yaw at a visit has the
// uncertainty u √2 / 10 mm.
TEST(PositioningBudgets, MeanReversalMatchesManualCalculation) {
  const Rig rig = test::rig_x_with("", "");
  SyntheticRun synthetic{.rig = rig, .model = Model::simplified, .runs = 1};
  synthetic.u_reading_m = 40e-9;
  const auto U = run_positioning_uncertainty(rig, synthetic.measure(), kYawOfCases, false).value();
  const double u_visit = 40e-9 * std::sqrt(2.0) / 10e-3;
  EXPECT_NEAR(U.B_mean, 1.96 * u_visit * std::sqrt(2.0 / 9), 0.002 * U.B_mean);
}

// M is the range of the angle. Its U equals the U of the range in the budgets of the run.
TEST(PositioningBudgets, MHasTheUOfTheRange) {
  const Rig rig = test::rig_x_with("D", "u_sensitivity_ppm = 20000");
  SyntheticRun synthetic{.rig = rig, .model = Model::simplified};
  synthetic.truth = [](double d) { return Errors5{1e-2 * d * d, 0, 0, 0, 1e-2 * d}; };
  synthetic.u_reading_m = 10e-9;
  const auto run = synthetic.measure();
  const auto budgets = RunBudgets::create(rig, run).value();
  EXPECT_EQ(run_positioning_uncertainty(rig, run, kYawOfCases, false)->M,
            budgets.of(range_figure(Axis::x, kYawOfCases)).U);
  EXPECT_EQ(run_positioning_uncertainty(rig, run, 0, false)->M,
            budgets.of(straightness_figure(Axis::x, 0)).U);
  EXPECT_EQ(run_positioning_uncertainty(rig, run, 0, true)->M,
            budgets.of(range_figure(Axis::x, 0)).U);
}

// If all visits have one direction, only the parameters of this direction have a value.
TEST(PositioningBudgets, OneDirectionHasOnlyItsParameters) {
  const Rig rig = test::rig_x_with("", "");
  SyntheticRun synthetic{.rig = rig, .model = Model::simplified};
  synthetic.truth = [](double d) { return Errors5{1e-2 * d * d, 0, 0, 0, 1e-2 * d}; };
  synthetic.u_reading_m = 40e-9;
  auto run = synthetic.measure();
  std::erase_if(run.points, [](const MeasuredPoint& p) { return p.point.direction < 0; });
  const auto U = run_positioning_uncertainty(rig, run, 0, false).value();
  EXPECT_GT(U.E_forward, 0);
  EXPECT_GT(U.R_forward, 0);
  for (const double none : {U.B, U.B_mean, U.E_reverse, U.E, U.M, U.R_reverse, U.R})
    EXPECT_TRUE(std::isnan(none));
}

// The reading of D increases by 20 µm per mm, and its scale has an uncertainty of 0.1 %. The effect
// of the scale on EYX is a slope, which straightness does not contain.
TEST(PositioningBudgets, SlopeDoesNotChangeStraightness) {
  const Rig rig = test::rig_x_with("D", "u_sensitivity_ppm = 1000");
  SyntheticRun synthetic{.rig = rig, .model = Model::exact, .runs = 1};
  synthetic.truth = [](double d) { return Errors5{0.02 * d, 0, 0, 0, 0}; };
  const mdof::Run run = synthetic.measure();
  const double length_m = synthetic.targets_m.back() - synthetic.targets_m.front();
  const auto kept = run_positioning_uncertainty(rig, run, 0, true).value(),
             straight = run_positioning_uncertainty(rig, run, 0, false).value();
  const double expected = 1.96 * 1e-3 * 0.02 * length_m;
  for (const double U : {kept.E, kept.E_forward, kept.E_reverse})
    EXPECT_NEAR(U, expected, 0.05 * expected);
  for (const double U : {straight.E, straight.E_forward, straight.E_reverse})
    EXPECT_LT(U, 0.01 * expected);
}

// Expected: R by its definition, and U by a search over all true values of R in steps of 0.001 of
// the measured R.
TEST(Repeatability, UncertaintyMatchesAnExhaustiveSearch) {
  // Two targets with three visits in each direction; 40 trials draw the errors.
  const VisitGroups groups{{0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3}, 2};
  test::NoPattern numbers(3);
  std::vector<double> measured, errors;
  for (int i = 0; i < 12; ++i) measured.push_back(numbers.between(-2, 2) + (i % 2 ? 1.5 : 0));
  for (int i = 0; i < 12 * 40; ++i) errors.push_back(numbers.between(-1, 1));
  const auto expected_R = [&](const std::vector<double>& v, RepeatabilityKind of) {
    double most = 0;
    for (std::size_t target = 0; target < 2; ++target) {
      std::array<double, 2> mean{}, s{};
      for (std::size_t side = 0; side < 2; ++side) {
        for (std::size_t j = 0; j < 3; ++j) mean[side] += v[4 * j + 2 * target + side] / 3;
        for (std::size_t j = 0; j < 3; ++j)
          s[side] += std::pow(v[4 * j + 2 * target + side] - mean[side], 2) / 2;
        s[side] = std::sqrt(s[side]);
      }
      const double both = 2 * s[0] + 2 * s[1] + std::abs(mean[0] - mean[1]);
      most =
          std::max(most, of == RepeatabilityKind::forward   ? 4 * s[1]
                         : of == RepeatabilityKind::reverse ? 4 * s[0]
                                                            : std::max({both, 4 * s[0], 4 * s[1]}));
    }
    return most;
  };
  for (const double size : {0.05, 0.3, 1.0, 3.0})
    for (const RepeatabilityKind of : kRepeatabilities) {
      std::vector<double> scaled = errors;
      for (double& e : scaled) e *= size;
      const double R = expected_R(measured, of);
      EXPECT_NEAR(repeatability_R(groups, measured.data(), of), R, 1e-12);
      const auto distance = [&](double part) {
        std::vector<double> off;
        for (std::size_t t = 0; t < 40; ++t) {
          std::vector<double> v;
          for (std::size_t j = 0; j < 12; ++j) v.push_back(part * measured[j] + scaled[12 * t + j]);
          off.push_back(std::abs(expected_R(v, of) - part * R));
        }
        std::sort(off.begin(), off.end());
        return off[38];
      };
      double expected = distance(0);
      if (expected < R) {
        double part = 0;
        while (distance(part) < (1 - part) * R) part += 1e-3;
        expected = std::max((1 - part) * R, distance(1));
      }
      EXPECT_NEAR(repeatability_U(groups, measured, scaled, of), expected, 0.006 * R) << size;
    }
}

// D reads EYX at each visit. An error e of its gain increases each visit, and thus R, by e times
// its value: U(R) = 1.96 u(e) R. The noise is added by its own trials.
TEST(PositioningByHand, UOfTheRepeatabilityIsThatOfAGain) {
  const Rig rig = test::rig_x_with("D", "u_sensitivity_ppm = 50000");
  const double off_m[] = {-3e-6, 1e-6, 2e-6};  // of each run: s = √7 µm
  SyntheticRun synthetic{.rig = rig, .model = Model::simplified, .runs = 3};
  synthetic.added = [&](std::size_t k, double, double, double time_s) {
    return k < 3 ? 0 : off_m[static_cast<int>((time_s - 5) / 180)];
  };
  const auto U = [&](double noise_m) {
    synthetic.u_reading_m = noise_m;
    return run_positioning_uncertainty(rig, synthetic.measure(), 0, true).value();
  };
  const double expected = 1.96 * 0.05 * 4 * std::sqrt(7.0) * 1e-6;
  const auto exact = U(0);
  for (const double found : {exact.R, exact.R_forward, exact.R_reverse})
    EXPECT_NEAR(found / expected, 1, 0.1);
  // The noise of one visit: U of R increases, but by less than that of all visits together.
  EXPECT_GT(U(1e-6).R_forward, 1.5 * exact.R_forward);
}

}  // namespace
}  // namespace mdof::algo
