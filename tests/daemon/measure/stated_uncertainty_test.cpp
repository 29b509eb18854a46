// Checks how often the stated 95 % intervals of figures contain the true value. Runs along X and Y
// are simulated for five rigs. Each declared contributor is drawn from its distribution.
// Set MDOF_COVERAGE_RUNS=2000 (total number of pairs of runs) for figures that may be published.
#include <gtest/gtest.h>

#include <map>
#include <optional>

#include "algo/compensation/declared_uncertainty.h"
#include "algo/model/restate.h"
#include "algo/uncertainty/budget/budget.h"
#include "algo/uncertainty/budget/two_runs.h"
#include "algo/uncertainty/run_uncertainty.h"
#include "daemon/measure/pipeline.h"
#include "tests/algo/compensation/table_lever.h"
#include "tests/algo/uncertainty/faulty_fixture.h"
#include "tests/algo/uncertainty/synthetic_run.h"
#include "tests/coverage_runs.h"
#include "tests/daemon/measure/coverage_tally.h"

namespace mdof::daemon {
namespace {

using algo::test_faults::FaultyFixture;
using test::coverage_runs;

constexpr double kRate_hz = 250, kDwell_s = 0.5, kMove_s = 0.1;
constexpr double kWhite_m = 60e-9;   // sd of the white noise of one reading
constexpr double kBeside_m = 20e-9;  // pink: rms; random walk: sd at the end of the log
constexpr double kDrift_um_per_h = 3, kSquare_urad = 1;
constexpr int kRepeats = 3;
constexpr int kWatched = 6;  // number of the target, from 1, whose table values are checked
// Two positions in the frame of the fixture: a tool below the fixture, and a distant position.
// Their distances are typical of a small machine.
const Eigen::Vector3d kTool_m(6e-3, -4e-3, -30e-3), kFar_m(40e-3, 20e-3, 10e-3);

enum class Noise { white, pink, walk };  // pink and walk are added to white noise
enum class Declares { all, nothing };

struct Lengths {
  double l_mm, h_mm, z_mm;
  bool sixth, reversed;  // has a sixth probe; lists the probes in reverse order
  double flatness_length_mm = 30;
  // The rig declares only what a careful user in a typical workshop knows: u = 0.1 % of the gain,
  // a drift of 0.2 µm in the 33 s of a run, a fixture rotated by 2 mrad. Readings are quantised.
  bool shop = false;
};
constexpr Lengths kRigs[] = {{10, 15, 20, false, false},
                             {25, 8, 12, false, false},
                             {7, 20, 35, false, false},
                             {15, 12, 18, false, true},
                             {10, 15, 20, true, false}};

constexpr double kStep_m = 10e-9;
const char* const kOfShop = "[installation]\nu_angle_mrad = [2, 2, 2]\n[drift]\nu_um_per_h = 22\n";

// Inserts `lines` before each occurrence of `key`.
std::string insert_before_key(std::string toml, const std::string& key, const std::string& lines) {
  for (std::size_t at = 0; (at = toml.find(key, at)) != std::string::npos; at += key.size()) {
    toml.insert(at, lines);
    at += lines.size();
  }
  return toml;
}

// The rig of axis X or Y, parsed from TOML. In the frame of Y: x = +Y, y = -X.
Rig rig_of(const Lengths& of, Axis axis, Declares declares) {
  const bool y = axis == Axis::y;
  const auto probe = [&](const char* id, double along, double across, double up, bool top) {
    const std::string x_mm = std::to_string(y ? -across : along);
    const std::string y_mm = std::to_string(y ? along : across);
    return std::string("[[probe]]\nid = \"") + id + "\"\nposition_mm = [" + x_mm + ", " + y_mm +
           ", " + std::to_string(up) + "]\nmeasures = \"" +
           (top ? "+Z"
            : y ? "-X"
                : "+Y") +
           "\"\nrange_um = 400\n";
  };
  std::vector<std::string> probes = {
      probe("A", of.l_mm, 0, 0, true), probe("B", 0, of.l_mm, 0, true),
      probe("C", 0, -of.l_mm, 0, true), probe("D", 0, of.h_mm, of.z_mm, false),
      probe("E", of.l_mm, of.h_mm, of.z_mm, false)};
  if (of.sixth) probes.push_back(probe("F", -of.l_mm, of.l_mm / 2, 0, true));
  if (of.reversed) std::reverse(probes.begin(), probes.end());
  std::string toml = std::string("name = \"coverage\"\naxis = \"") + letter(axis) +
                     "\"\nu_artefact_angle_urad = " + std::to_string(kSquare_urad) + "\n";
  for (const auto& text : probes) toml += text;
  if (of.shop)
    return parse_rig(insert_before_key(toml, "measures", "u_sensitivity_ppm = 1000\n") + kOfShop,
                     "shop.toml")
        .value();
  if (declares == Declares::nothing)
    return parse_rig(toml + "[[plane]]\nid = \"top\"\nnormal = \"+Z\"\n[[plane]]\nid = \"side\"\n" +
                         "normal = \"" + (y ? "-X" : "+Y") + "\"\n",
                     "coverage.toml")
        .value();
  const std::string declared = insert_before_key(
      algo::test_faults::of_rig(kDrift_um_per_h, y ? "-X" : "+Y"), "u_flatness_um",
      "flatness_length_mm = " + std::to_string(of.flatness_length_mm) + "\n");
  return parse_rig(algo::test_faults::with_declared_probes(toml) + declared, "coverage.toml")
      .value();
}

// Noise of one probe. The white noise may have one of two additions: a sum of parts with different
// time constants, whose power is proportional to 1/f, or a random walk.
class ProbeNoise {
 public:
  double next(Noise kind, FaultyFixture& random) {
    const double white_m = kWhite_m * random.normal();
    if (kind == Noise::white) return white_m;
    if (kind == Noise::walk) return white_m + (walk_m_ += kStepOfWalk_m * random.normal());
    double sum = 0, share = 0.35;
    for (double& part : parts_) {
      part += -share * part + std::sqrt(share * (2 - share)) * random.normal();
      sum += part;
      share /= 4;
    }
    return white_m + kBeside_m / std::sqrt(6.0) * sum;
  }

 private:
  static constexpr double kScans = 54 * (kDwell_s + kMove_s) * kRate_hz;
  inline static const double kStepOfWalk_m = kBeside_m / std::sqrt(kScans);

  std::array<double, 6> parts_{};
  double walk_m_ = 0;
};

const std::vector<double> kTargets_mm = {0, 5, 10.2, 14.9, 20, 25.1, 30, 34.8, 40};

class MeasuredAxis {
 public:
  MeasuredAxis(const Rig& rig, const Rig& faulty, Noise kind, std::uint64_t seed)
      : rig_(rig), fixture_(faulty, seed), kind_(kind), noise_(rig.probes.size()) {}

  Run measure() {
    block_.device = "daq";
    block_.channels.push_back({kEncoderChannel, Unit::mm});
    for (const Probe& probe : rig_.probes) block_.channels.push_back({probe.id, Unit::um});
    block_.value.resize(block_.channels.size());
    dwell_at(-1, 0.02);
    for (int r = 0; r < kRepeats; ++r) {
      for (const double mm : kTargets_mm) stop_at(mm);
      go_to(kTargets_mm.back() + 1);
      for (auto at = kTargets_mm.rbegin(); at != kTargets_mm.rend(); ++at) stop_at(*at);
      go_to(-1);
    }
    Pipeline pipeline = Pipeline::create(rig_, {}).value();
    EXPECT_TRUE(pipeline.push(block_));
    Run run = pipeline.finish().value();
    run.header.axis = rig_.axis;
    run.header.sides = rig_.sides;
    run.header.provenance.model = to_string(Model::rigid);
    return run;
  }
  void quantise() { step_m_ = kStep_m; }
  double normal() { return fixture_.normal(); }
  FaultyFixture& fixture() { return fixture_; }

 private:
  std::vector<double> readings_at(double mm) const {
    const double d = 1e-3 * mm;
    return fixture_.readings_m(d, algo::test_faults::true_errors(d), time_s());
  }
  double time_s() const { return static_cast<double>(block_.time_ns.size()) / kRate_hz; }
  void scan(double mm, const std::vector<double>& readings_m) {
    block_.time_ns.push_back(static_cast<std::int64_t>(time_s() * 1e9) + 1'000'000'000);
    block_.value[0].push_back(mm);
    for (std::size_t k = 0; k < readings_m.size(); ++k)
      block_.value[k + 1].push_back(1e6 *
                                    in_steps(readings_m[k] + noise_[k].next(kind_, fixture_)));
  }
  double in_steps(double reading_m) const {
    return step_m_ > 0 ? step_m_ * std::round(reading_m / step_m_) : reading_m;
  }
  void dwell_at(double mm, double for_s) {
    const auto readings = readings_at(at_mm_ = mm);
    for (int i = 0; i < static_cast<int>(for_s * kRate_hz); ++i) scan(mm, readings);
  }
  void go_to(double mm) {
    const double from_mm = at_mm_;
    const auto from = readings_at(from_mm), to = readings_at(mm);
    const int steps = static_cast<int>(kMove_s * kRate_hz);
    for (int i = 1; i <= steps; ++i) {
      const double share = static_cast<double>(i) / steps;
      std::vector<double> between;
      for (std::size_t k = 0; k < from.size(); ++k)
        between.push_back(from[k] + share * (to[k] - from[k]));
      scan(from_mm + share * (mm - from_mm), between);
    }
    at_mm_ = mm;
  }
  void stop_at(double mm) {
    go_to(mm);
    dwell_at(mm, kDwell_s);
  }

  const Rig& rig_;
  FaultyFixture fixture_;
  Noise kind_;
  std::vector<ProbeNoise> noise_;
  SampleBlock block_;
  double at_mm_ = -1, step_m_ = 0;
};

// The run that a fixture without faults would measure on this axis.
Run true_run(const Rig& rig) {
  std::vector<double> targets_m;
  for (const double mm : kTargets_mm) targets_m.push_back(1e-3 * mm);
  algo::SyntheticRun exact{.rig = rig, .targets_m = targets_m, .runs = 1};
  exact.truth = algo::test_faults::true_errors;
  return exact.measure();
}

// Counts, for each error, whether the interval of one point contains the true value. The seed
// selects the point.
void count_points(Coverage& coverage, const Rig& rig, const Run& run, const Run& truth,
                  std::uint64_t seed) {
  const auto u = algo::run_uncertainty(rig, run);
  const MovingAxis moving = run.header.moving();
  const std::size_t at = seed % run.points.size();
  const std::size_t true_at = at % truth.points.size();
  ASSERT_EQ(run.points[at].target, truth.points[true_at].target);
  const Errors5 value = named_from_local(moving, run.points[at].errors.local);
  const Errors5 true_value = named_from_local(moving, truth.points[true_at].errors.local);
  for (std::size_t k = 0; k < kErrorCount; ++k)
    count(coverage, std::string("point ") + error_names(run.header.axis)[k].name, value[k],
          true_value[k], u.points[at].U[k]);
  if (rig.declares_uncertainty()) return;
  // For comparison: U without the repeatability of the run, which pink noise makes too small.
  const auto of_stops = algo::stop_uncertainty(rig, run);
  for (std::size_t k = 0; k < kErrorCount; ++k)
    count(coverage, "by stops", value[k], true_value[k], of_stops.points[at].U[k]);
}

void count_table(Coverage& coverage, const Rig& rig, const Run& run, const Run& truth) {
  algo::TableOptions options;
  options.stated = kAtFixture;
  auto table = algo::build_table({run}, options).value();
  ASSERT_TRUE(algo::add_declared_uncertainty(table, {rig}, {run}, options));
  const auto true_table = algo::build_table({truth}, options).value();
  for (std::size_t k = 0; k < kErrorCount; ++k)
    count(coverage, std::string("table ") + error_names(run.header.axis)[k].name,
          table.forward[k][kWatched - 1], true_table.forward[k][kWatched - 1],
          kTwoSided * table.u_of(table.u_forward, k, kWatched - 1));
  const auto together = algo::error_covariances(table, {rig}, {run}, options).value();
  for (const Eigen::Vector3d& p : {kTool_m, kFar_m}) {
    const Eigen::Vector3d u =
        test::tool_uncertainty(test::machine_of(table, p, together), table, kWatched - 1);
    const Eigen::Vector3d value = test::moved_by(table, kWatched - 1, p);
    const Eigen::Vector3d true_value = test::moved_by(true_table, kWatched - 1, p);
    for (int k = 0; k < 3; ++k)
      count(coverage, std::string(p == kTool_m ? "tool " : "far ") + "xyz"[k], value(k),
            true_value(k), kTwoSided * u(k));
  }
}

double count_figures(Coverage& coverage, const Rig& rig, const Run& run, const Run& truth) {
  const auto budgets = algo::RunBudgets::create(rig, run).value();
  const auto exact = algo::RunBudgets::create(rig, truth).value();
  double slope = 0;
  for (const algo::Figure& figure : algo::figures_of_run(run.header.axis)) {
    const double true_value = figure.of(exact.means());
    if (figure.name.find("_slope") != std::string::npos && slope == 0) slope = true_value;
    const Budget budget = budgets.of(figure);
    count(coverage, figure.name, budget.value, true_value, budget.U);
  }
  return slope;
}

// Measures a run along X and a run along Y, and counts their figures. If `declare_calibration` is
// false, the rig of the evaluation has u = 0 for the zeros of the probes.
void measure_pair(Coverage& coverage, const Lengths& of, Noise kind, std::uint64_t seed,
                  bool declare_calibration, Declares declares) {
  std::map<Axis, Rig> rigs, faulty;
  std::map<Axis, Run> runs;
  double slopes = 0, square = 0, inclinations = 1;
  std::vector<double> gains;  // X and Y use the same probes and the same top surface of the target
  std::optional<algo::test_faults::DrawnSurface> top;
  for (const Axis axis : {Axis::x, Axis::y}) {
    faulty[axis] = rigs[axis] = rig_of(of, axis, declares);
    if (!declare_calibration)
      for (Probe& probe : rigs[axis].probes) probe.uncertainty.calibration.u = 0;
    MeasuredAxis machine(rigs[axis], faulty[axis], kind, 2 * seed + (axis == Axis::y ? 1 : 0));
    if (of.shop) machine.quantise();
    if (axis == Axis::y) machine.fixture().take_gains(gains);
    if (top) machine.fixture().share_x_top(*top);
    gains = machine.fixture().gains();
    if (!rigs[axis].planes.empty()) top = machine.fixture().top();
    Run& run = runs[axis] = machine.measure();
    ASSERT_EQ(run.points.size(), 2u * kRepeats * kTargets_mm.size());
    const Run truth = true_run(rigs[axis]);
    inclinations *=
        algo::slope_figure(axis, 1).of(algo::RunBudgets::create(rigs[axis], truth).value().means());
    if (axis == Axis::x) {
      count_points(coverage, rigs[axis], run, truth, seed);
      count_table(coverage, rigs[axis], run, truth);
      slopes += count_figures(coverage, rigs[axis], run, truth);
      square = 1e-6 * kSquare_urad * machine.normal();
    } else {
      const auto slope = algo::slope_figure(axis, 0);
      const double true_slope =
          slope.of(algo::RunBudgets::create(rigs[axis], truth).value().means());
      const Budget of_y = algo::RunBudgets::create(rigs[axis], run).value().of(slope);
      count(coverage, slope.name, of_y.value, true_slope, of_y.U);
      slopes += true_slope;
    }
  }
  const SquareArtefact artefact{0, 1e-6 * kSquare_urad, -1};
  const auto budget =
      algo::squareness_budget(rigs[Axis::x], runs[Axis::x], rigs[Axis::y], runs[Axis::y], artefact)
          .value();
  // The true EC0Y includes the error of the square. This error is unknown and the slopes of the
  // runs do not include it. Both axes are inclined to the top of the target: the cosine of the
  // angle between them is the scalar product of their directions.
  count(coverage, "EC0Y", budget.value, -slopes - inclinations - square, budget.U);
}

Coverage coverage_of(Noise kind, int pairs, Declares declares = Declares::all,
                     bool declare_calibration = true) {
  Coverage coverage;
  for (int i = 0; i < pairs; ++i)
    measure_pair(coverage, kRigs[static_cast<std::size_t>(i) % std::size(kRigs)], kind,
                 test::coverage_seed(5000) + static_cast<std::uint64_t>(i), declare_calibration,
                 declares);
  return coverage;
}

// Coverage for one rig.
Coverage coverage_of(const Lengths& of, int pairs) {
  Coverage coverage;
  for (int i = 0; i < pairs; ++i)
    measure_pair(coverage, of, Noise::white,
                 test::coverage_seed(9000) + static_cast<std::uint64_t>(i), true, Declares::all);
  return coverage;
}

TEST(StatedUncertainty, HoldsTheTruthWithWhiteNoise) {
  const int pairs = coverage_runs(15);
  expect_covered(coverage_of(Noise::white, pairs), pairs, 95);
}

TEST(StatedUncertainty, HoldsTheTruthWithPinkNoise) {
  const int pairs = coverage_runs(15);
  expect_covered(coverage_of(Noise::pink, pairs), pairs, 94);
}

TEST(StatedUncertainty, HoldsTheTruthWithARandomWalk) {
  const int pairs = coverage_runs(15);
  expect_covered(coverage_of(Noise::walk, pairs), pairs, 94);
}

// Without declared contributors, u of a point contains only noise and the repeatability of the
// run. This must be sufficient.
TEST(StatedUncertainty, HoldsTheTruthOfPointsIfNothingIsDeclared) {
  const int pairs = coverage_runs(100);
  for (const Noise kind : {Noise::white, Noise::pink}) {
    SCOPED_TRACE(static_cast<int>(kind));
    Coverage points = coverage_of(kind, pairs, Declares::nothing);
    if (kind == Noise::pink) {
      EXPECT_LT(points["by stops"].percent(), 85);
    }
    std::printf("by the stops alone     %5.1f %%\n", points["by stops"].percent());
    std::erase_if(points, [](const auto& of) { return !of.first.starts_with("point"); });
    expect_covered(points, pairs, 94);
  }
}

// The travel is 40 mm. The flatness lengths are from a tenth of the travel to ten times the
// travel.
TEST(StatedUncertainty, HoldsTheTruthWhateverTheLengthOfTheFlatness) {
  const int pairs = coverage_runs(8);
  for (const double length_mm : {4.0, 13.0, 400.0}) {
    SCOPED_TRACE(length_mm);
    std::printf("flatness length %g mm\n", length_mm);
    expect_covered(coverage_of({10, 15, 20, false, false, length_mm}, pairs), pairs, 94);
  }
}

TEST(StatedUncertainty, HoldsTheTruthOfATypicalShopThatDeclaresIt) {
  const int pairs = coverage_runs(10);
  expect_covered(coverage_of({10, 15, 20, false, false, 30, true}, pairs), pairs, 93);
}

// Control: if the rig does not declare a contributor, the intervals are too short.
TEST(StatedUncertainty, DoesNotHoldTheTruthWithoutOneContributor) {
  const Coverage coverage =
      coverage_of(Noise::white, std::max(25, coverage_runs(25) / 10), Declares::all, false);
  EXPECT_LT(coverage.at("point EYX").percent(), 88);
}

}  // namespace
}  // namespace mdof::daemon
