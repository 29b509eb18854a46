// The stated u of tables is compared with the spread of their errors. The noise is drawn for each
// reading; the level and the slope are drawn for each pass and are the same at all its targets.
#include "algo/compensation/table_uncertainty.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "algo/compensation/compensation.h"
#include "tests/algo/rigs.h"
#include "tests/algo/uncertainty/synthetic_run.h"
#include "tests/coverage_runs.h"

namespace mdof::algo {
namespace {

constexpr double kWhite_m = 30e-9;

struct Spread {
  double square = 0, u_square = 0, n = 0;
  void add(double error, double u) { square += error * error, u_square += u * u, n += 1; }
  double ratio() const { return std::sqrt(u_square / square); }
};

// Root mean square of u divided by the root mean square of the error, for EYX and ECX. The values
// are taken at each target of many tables of an axis without errors. Each pass of nine targets has
// its own yaw, and its own level of probes D and E.
std::map<std::string, Spread> spreads(double level_m, double slope_m, bool remove_slope) {
  const Rig rig = test::rig_x_with("", "");
  std::mt19937_64 engine(17);
  std::normal_distribution<> normal;
  SyntheticRun synthetic{.rig = rig, .model = Model::simplified, .runs = 3};
  synthetic.u_reading_m = kWhite_m;
  TableOptions options;
  options.stated = kAtFixture;
  options.remove_slope = remove_slope;
  std::map<std::string, Spread> all;
  for (int table = 0; table < test::coverage_runs(250); ++table) {
    std::map<int, std::array<double, 2>> of_pass;
    synthetic.added = [&](std::size_t k, double, double, double time_s) {
      const int pass = static_cast<int>((time_s - 5) / 90);
      if (!of_pass.contains(pass)) of_pass[pass] = {normal(engine), normal(engine)};
      const auto& [level, yaw] = of_pass[pass];
      return kWhite_m * normal(engine) +
             (k < 3 ? 0 : level_m * level + (k == 4 ? slope_m * yaw : 0));
    };
    const CompensationTable built = build_table({synthetic.measure()}, options).value();
    for (std::size_t i = 0; i < 9; ++i) {
      const std::string at = i == 0 ? "first " : i == 4 ? "middle " : i == 8 ? "last " : "other ";
      for (const std::size_t k : {std::size_t{0}, std::size_t{4}}) {
        Spread& of = all[at + (k == 0 ? "EYX" : "ECX")];
        of.add(built.forward[k][i], built.u_forward[k][i]);
        of.add(built.reverse[k][i], built.u_reverse[k][i]);
      }
    }
  }
  for (const auto& [name, of] : all)
    std::printf("level %3.0f nm, %-12s u / spread %.3f\n", level_m * 1e9, name.c_str(), of.ratio());
  return all;
}

// 500 values at each target. Without a level, u exceeds the spread by 6 to 10 %: u uses the larger
// of noise and scatter, and replaces a negative estimate of a variance by 0.
TEST(TableUncertainty, IsTheSpreadOfItsErrors) {
  for (const double level_m : {0.0, 200e-9})
    for (const bool remove_slope : {true, false})
      for (const auto& [name, of] : spreads(level_m, level_m, remove_slope))
        EXPECT_NEAR(of.ratio(), level_m > 0 ? 1 : 1.08, 0.15)
            << name << ", level " << level_m << " " << remove_slope;
}

// Calculated by hand: five targets have equal distances. The value of the least-squares line at the
// first target is the sum of the five values with the weights 3/5, 2/5, 1/5, 0, -1/5.
TEST(TableUncertainty, ReferencesAreWeightsOfTheMeans) {
  const Reference end = line_at({0, 1, 2, 3, 4}, 0), beyond = line_at({0, 1, 2}, 4);
  const double expected[] = {0.6, 0.4, 0.2, 0, -0.2};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(end[i], expected[i], 1e-15);
  EXPECT_NEAR(beyond[0] * 7 + beyond[1] * 9 + beyond[2] * 11, 15, 1e-12);
  EXPECT_EQ(interpolation_at({1, 2, 4}, 1), (Reference{1, 0, 0}));
  EXPECT_EQ(interpolation_at({1, 2, 4}, 2.5), (Reference{0, 0.75, 0.25}));
  // Beyond the ends the end value applies.
  EXPECT_EQ(interpolation_at({1, 2, 4}, 0), (Reference{1, 0, 0}));
  EXPECT_EQ(interpolation_at({1, 2, 4}, 9), (Reference{0, 0, 1}));
  EXPECT_EQ(as_measured(2), (Reference{0, 0}));
}

}  // namespace
}  // namespace mdof::algo
