// Counts how often the stated 95 % intervals contain the true values. The faults of the fixtures
// are drawn from the distributions that the rigs declare. The points have no samples;
// tests/daemon/measure tests the whole path from the samples. Set MDOF_COVERAGE_RUNS=2000 to
// calculate figures for publication.
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>

#include "algo/uncertainty/budget/budget.h"
#include "tests/algo/rigs.h"
#include "tests/algo/uncertainty/faulty_fixture.h"
#include "tests/algo/uncertainty/synthetic_run.h"

namespace mdof::algo {
namespace {

using namespace test_faults;

Rig declared_rig(double l_mm, double h_mm, double z_mm) {
  return parse_rig(with_declared_probes(test::rig_x_toml(l_mm, h_mm, z_mm)) + of_rig(0.2, "+Y"),
                   "rig_X.toml")
      .value();
}

struct Tally {
  int inside = 0, all = 0;
  double percent() const { return 100.0 * inside / all; }
};
using Coverage = std::map<std::string, Tally>;

void count(Coverage& coverage, const Budget& budget, double truth) {
  Tally& tally = coverage[budget.figure];
  ++tally.all;
  tally.inside += std::abs(budget.value - truth) <= budget.U;
}

int requested_runs() {
  const char* wanted = std::getenv("MDOF_COVERAGE_RUNS");
  return wanted ? std::atoi(wanted) : 0;
}

// Without the environment variable, ranges are omitted, because their U needs a Monte Carlo
// calculation. The test then takes a tenth of the time.
std::vector<Figure> figures() {
  std::vector<Figure> all = errors_at_target(Axis::x, 8);
  for (const Figure& figure : figures_of_run(Axis::x))
    if (!figure.is_range() || requested_runs() > 0) all.push_back(figure);
  return all;
}

Coverage coverage_of(const Rig& declared, const Rig& faulty, int trials) {
  Coverage coverage;
  constexpr double kNoise_m = 8e-9;
  for (int t = 0; t < trials; ++t) {
    FaultyFixture fixture(faulty, 1000 + static_cast<std::uint64_t>(t));
    SyntheticRun synthetic{.rig = declared, .model = Model::exact, .runs = 5};
    synthetic.truth = true_errors;
    synthetic.u_reading_m = kNoise_m;
    synthetic.added = [&](std::size_t k, double d, double reading_m, double time_s) {
      return fixture.readings_m(d, true_errors(d), time_s)[k] - reading_m +
             kNoise_m * fixture.normal();
    };
    const auto run = synthetic.measure();
    const auto budgets = RunBudgets::create(declared, run).value();
    SyntheticRun without{.rig = declared, .model = Model::exact, .runs = 1};
    without.truth = true_errors;
    const auto truth = RunBudgets::create(test::rig_x(), without.measure()).value();
    for (const Figure& figure : figures())
      count(coverage, budgets.of(figure), figure.of(truth.means()));
  }
  return coverage;
}

TEST(CoverageOfRuns, StatedIntervalsHoldTheTruth) {
  const int runs = requested_runs() > 0 ? requested_runs() : 150;
  // Three standard deviations of a share of 95 % of this number of runs, %.
  const double three_sd = 65 / std::sqrt(runs);
  for (const auto& [l_mm, h_mm, z_mm] :
       {std::array{10.0, 15.0, 20.0}, std::array{25.0, 8.0, 12.0}}) {
    const Rig rig = declared_rig(l_mm, h_mm, z_mm);
    for (const auto& [figure, tally] : coverage_of(rig, rig, runs)) {
      std::printf("l %2.0f mm %-22s %5.1f %%\n", l_mm, figure.c_str(), tally.percent());
      EXPECT_GT(tally.percent(), 95 - three_sd) << figure;
    }
  }
}

// Control: the intervals must not cover faults that the rig does not declare.
TEST(CoverageOfRuns, UndeclaredFaultsAreNotCovered) {
  const Rig faulty = declared_rig(10, 15, 20);
  Rig declared = faulty;
  for (Probe& probe : declared.probes) probe.uncertainty.calibration.u = 0;
  const Coverage coverage = coverage_of(declared, faulty, 150);
  EXPECT_LT(coverage.at("EYX_um").percent(), 88);
}

}  // namespace
}  // namespace mdof::algo
