// Simulates parts with known causes and counts how often the stated intervals contain the truth.
// The truth is calculated here, from closed forms of the planted errors. MDOF_COVERAGE_RUNS is the
// number of parts for each case: by default 100; the campaign uses 1,000 and stricter limits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "algo/part/part_error.h"
#include "tests/coverage_runs.h"

namespace mdof::algo {
namespace {

constexpr std::size_t kPlacesOfPath = 40;

// A cause: `size` times one of the forms along the path, measured with `u`. A quantity that all
// causes share, such as the sensitivity of a probe, adds `u_shared`. If the cause is not measured,
// the part has a random multiple of `u`, and `size` is not used.
struct Planted {
  std::size_t layer = 0, form = 0;
  double size = 0, u = 0;
  bool is_measured = true;
  double u_shared = 0;
};

double form(std::size_t number, std::size_t point) {
  const double t = static_cast<double>(point) / kPlacesOfPath;
  switch (number) {
    case 0:
      return 2 * t - 1;
    case 1:
      return 1;
    case 2:
      return std::sin(9 * t);
    case 3:
      return t * t;
    case 4:
      return std::cos(20 * t);
    default:
      return std::sin(31 * t) > 0 ? 1 : -1;
  }
}

// The error of each point, in um.
using Errors = std::vector<double>;

double rms_over_places(const Errors& errors) {
  double sum = 0;
  for (const double x : errors) sum += x * x;
  return std::sqrt(sum / kPlacesOfPath);
}

// Counts how often an interval, and value ± U, contain the truth.
struct Count {
  int within = 0, within_U = 0, outside = 0;  // outside: value outside its interval
  std::vector<double> lengths{};
  void add(double value, const Interval& interval, double truth, double unit = 1e6) {
    // The figures of a cause without u have rounding errors.
    const double low = unit * interval.low - 1e-9, high = unit * interval.high + 1e-9;
    within += truth >= low && truth <= high ? 1 : 0;
    within_U += std::abs(truth - unit * value) <= unit * interval.U(value) + 1e-9 ? 1 : 0;
    // A value outside its interval would contradict it.
    outside += value < interval.low || value > interval.high ? 1 : 0;
    lengths.push_back(unit * (interval.high - interval.low));
  }
  double percent() const { return 100.0 * within / static_cast<double>(lengths.size()); }
  double median_length() const {
    std::vector<double> sorted = lengths;
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2];
  }
};

struct Counts {
  Count share, rms, p95, max;
  std::vector<double> u_um{};  // at the point of the largest error
};

struct SimulatedPart {
  std::string name;
  std::vector<Planted> causes;
};

class Parts {
 public:
  Parts(const SimulatedPart& simulated, bool with_normals, std::uint64_t seed, PartTrials trials)
      : case_(simulated), engine_(seed), trials_(trials) {
    trials_.seed = seed * 100'000;
    for (std::size_t p = 0; p < kPlacesOfPath; ++p) {
      path_.at_m.emplace_back(static_cast<double>(p) * 1e-3, 0, 0);
      if (with_normals) path_.normal.emplace_back(0, 0, 1);
    }
  }

  void simulate(Counts& counts) {
    std::vector<PartCause> causes;
    std::size_t layers = 0;
    for (const Planted& planted : case_.causes) layers = std::max(layers, planted.layer + 1);
    std::vector<Errors> of_layer(layers, Errors(kPlacesOfPath, 0.0));
    Errors all(kPlacesOfPath, 0.0);
    const double shared = normal_(engine_);
    for (const Planted& planted : case_.causes) {
      const double off = planted.u * normal_(engine_) + planted.u_shared * shared;
      const double truth = planted.is_measured ? planted.size : off,
                   value = planted.is_measured ? planted.size + off : 0;
      causes.push_back(new_cause("c", kPlacesOfPath));
      causes.back().layer = planted.layer;
      if (planted.u_shared != 0) causes.back().common.push_back({0, causes.back().u_m});
      for (std::size_t p = 0; p < kPlacesOfPath; ++p) {
        const double f = form(planted.form, p);
        // Without normals, an error has two components.
        const Eigen::Vector3d along =
            path_.normal.empty() ? Eigen::Vector3d(0.6e-6, 0, 0.8e-6) : Eigen::Vector3d(0, 0, 1e-6);
        causes.back().value_m[p] = value * f * along;
        causes.back().u_m[p] = planted.u * f * along;
        for (CommonPart& part : causes.back().common) part.u_m[p] = planted.u_shared * f * along;
        of_layer[planted.layer][p] += truth * f;
        all[p] += truth * f;
      }
    }
    ++trials_.seed;
    const PartError found = part_error(path_, causes, layers, trials_);
    double sum = 0;
    for (const Errors& errors : of_layer) sum += rms_over_places(errors) * rms_over_places(errors);
    double shares = 0;
    for (std::size_t k = 0; k < layers; ++k) {
      const PartShare& layer = found.layers[k];
      const double truth = rms_over_places(of_layer[k]);
      if (sum > 0) counts.share.add(layer.share, layer.share_interval, truth * truth / sum, 1);
      counts.rms.add(layer.rms_m, layer.rms_interval_m, truth);
      shares += layer.share;
    }
    EXPECT_NEAR(shares, 1, 1e-12) << case_.name;
    EXPECT_LE(found.p95_m, found.max_m) << case_.name;
    if (layers == 1) {
      EXPECT_EQ(found.layers[0].share_interval.U(1), 0) << case_.name;
      EXPECT_TRUE(has_budget() || found.layers[0].rms_m <= found.max_m) << case_.name;
    }
    const double u_um = u_of_largest(all);
    for (double& x : all) x = std::abs(x);
    std::sort(all.begin(), all.end());
    const std::size_t within_95 = kPlacesOfPath * 95 / 100;
    counts.p95.add(found.p95_m, found.p95_interval_m, all[within_95]);
    counts.max.add(found.max_m, found.max_interval_m, all.back());
    counts.u_um.push_back(u_um);
  }

 private:
  // The standard uncertainty at the point of the largest error: the least that U of the largest
  // error can be is 1.96 times this, if the error is known to be there.
  double u_of_largest(const Errors& errors) const {
    std::size_t at = 0;
    for (std::size_t p = 0; p < errors.size(); ++p)
      if (std::abs(errors[p]) > std::abs(errors[at])) at = p;
    double square = 0, shared = 0;
    for (const Planted& planted : case_.causes) {
      square += std::pow(planted.u * form(planted.form, at), 2);
      shared += planted.u_shared * form(planted.form, at);
    }
    return std::sqrt(square + shared * shared);
  }

  bool has_budget() const {
    return std::any_of(case_.causes.begin(), case_.causes.end(),
                       [](const Planted& planted) { return !planted.is_measured; });
  }

  const SimulatedPart& case_;
  std::mt19937_64 engine_;
  std::normal_distribution<double> normal_;
  PartTrials trials_;
  PartPath path_;
};

const std::vector<SimulatedPart> kSimulatedParts = {
    {"errors large against u", {{0, 0, 2, .1}, {1, 1, 1.5, .08}, {2, 2, 1, .1}, {3, 3, 1.2, .05}}},
    {"errors equal to u", {{0, 0, 1, 1}, {1, 1, 1, 1}, {2, 2, 1, 1}, {3, 3, 1, 1}}},
    {"errors of two u", {{0, 0, 2, 1}, {1, 1, 2, 1}, {2, 2, 2, 1}, {3, 3, 2, 1}}},
    {"one cause of five u", {{0, 2, 5, 1}}},
    {"one cause equal to u", {{0, 2, 1, 1}}},
    {"equal causes", {{0, 1, 1, .1}, {1, 1, 1, .1}, {2, 1, 1, .1}, {3, 1, 1, .1}}},
    {"one cause is zero", {{0, 0, 2, .1}, {1, 1, 1, .1}, {2, 2, 0, .1}}},
    {"all causes are zero", {{0, 0, 0, .1}, {1, 1, 0, .1}, {2, 2, 0, .1}}},
    {"budget", {{0, 0, 2, .1}, {1, 1, 1.5, .08}, {2, 2, 1, .1}, {3, 3, 0, 1.2, false}}},
    {"budget as large as u",
     {{0, 0, 1, .7}, {1, 1, .5, .5}, {2, 2, 0, 1, false}, {2, 3, 0, 1, false}}},
    {"layers of three causes equal to u",
     {{0, 0, 1, 1}, {0, 1, 1, 1}, {0, 2, 1, 1}, {1, 3, 1, 1}, {1, 4, 1, 1}, {1, 5, 1, 1}}},
    {"layers of three causes of five u",
     {{0, 0, 1, .2}, {0, 1, 1, .2}, {0, 2, 1, .2}, {1, 3, 1, .2}, {1, 4, 1, .2}, {1, 5, 1, .2}}},
    {"correlated errors of one layer",
     {{0, 0, 1, .1, true, .5}, {0, 1, 2, .1, true, .5}, {0, 3, 1, .1, true, .5}}},
    {"correlated errors of three layers",
     {{0, 0, 2, .1, true, .3}, {1, 1, 2, .1, true, -.3}, {2, 2, 1, .1, true, .3}}},
    {"causes of both signs",
     {{0, 0, 1, 1}, {0, 1, -1, 1}, {1, 2, 2, 1}, {1, 3, -1, 1}, {2, 4, 2, 1}, {2, 5, -1, 1}}},
    {"one known cause beside four that are zero",
     {{0, 0, 1, .01}, {1, 1, 0, 1}, {1, 2, 0, 1}, {1, 4, 0, 1}, {1, 5, 0, 1}}},
    {"one layer of six causes that are zero",
     {{0, 0, 0, 1}, {0, 1, 0, 1}, {0, 2, 0, 1}, {0, 3, 0, 1}, {0, 4, 0, 1}, {0, 5, 0, 1}}},
    {"one layer of six causes and a budget",
     {{0, 0, .3, 1}, {0, 1, .3, 1}, {0, 2, 0, 1}, {0, 4, 0, 1}, {0, 5, 0, 1}, {0, 3, 0, 1, false}}},
    {"one layer of six causes equal to u",
     {{0, 0, 1, 1}, {0, 1, 1, 1}, {0, 2, 1, 1}, {0, 3, 1, 1}, {0, 4, 1, 1}, {0, 5, 1, 1}}},
};

TEST(PartCoverage, IntervalsContainTheTruth) {
  const int parts = test::coverage_runs(100);
  ASSERT_GT(parts, 0);
  const bool is_campaign = parts >= 1000;
  // With 100 parts, one standard error of a percentage is 2.2.
  const double least = is_campaign ? 92 : 88;
  const PartTrials trials = is_campaign ? PartTrials{} : PartTrials{.shares = 400, .errors = 200};
  const std::uint64_t seed = test::coverage_seed(3);
  double of_all_cases = 0;  // the mean percentage of the largest error
  std::printf("%-58s %6s %6s %6s %6s %8s %8s %8s %8s\n", "within the interval, %; median length",
              "share", "RMS", "p95", "max", "share", "RMS/um", "p95/um", "max/um");
  for (const SimulatedPart& simulated : kSimulatedParts)
    for (const bool with_normals : {true, false}) {
      const std::string name = simulated.name + (with_normals ? "" : ", no normals");
      Counts counts;
      Parts simulation(simulated, with_normals, 2 * seed + with_normals, trials);
      for (int part = 0; part < parts; ++part) simulation.simulate(counts);
      const Count* const all[] = {&counts.share, &counts.rms, &counts.p95, &counts.max};
      std::printf("%-58s", name.c_str());
      for (const Count* count : all)
        std::printf(" %6.1f", count->lengths.empty() ? std::nan("") : count->percent());
      for (const Count* count : all)
        std::printf(" %8.3f", count->lengths.empty() ? std::nan("") : count->median_length());
      std::printf("\n");
      for (const Count* count : all)
        if (!count->lengths.empty()) {
          EXPECT_GE(count->percent(), least) << name;
          EXPECT_GE(count->within_U, count->within) << name;
          EXPECT_EQ(count->outside, 0) << name;
        }
      of_all_cases += counts.max.percent() / (2.0 * static_cast<double>(kSimulatedParts.size()));
      // An interval that is too long contains the truth, too.
      std::sort(counts.u_um.begin(), counts.u_um.end());
      EXPECT_LE(counts.max.median_length(), 1.25 * 3.92 * counts.u_um[counts.u_um.size() / 2])
          << name;
    }
  EXPECT_NEAR(of_all_cases, 95, 1.5);
}

}  // namespace
}  // namespace mdof::algo
