// Simulates parts with known causes and counts how often the stated intervals contain the truth.
// The truth is calculated here, from closed forms of the planted errors. MDOF_COVERAGE_RUNS is the
// number of parts for each case: by default 40; the campaign uses 1,000 and checks the limits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "algo/part/part_error.h"

namespace mdof::algo {
namespace {

constexpr std::size_t kPlacesOfPath = 100;

// A cause: `size` times one of the forms along the path, measured with `u`. If it is not measured,
// the part has a random multiple of `u`, and `size` is not used.
struct Planted {
  std::size_t layer = 0, form = 0;
  double size = 0, u = 0;
  bool is_measured = true;
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

// Counts how often an interval contains the truth.
struct Count {
  int within = 0, all = 0;
  void add(double low, double truth, double high) {
    // The figures of a cause without u have rounding errors.
    within += truth >= low - 1e-9 && truth <= high + 1e-9 ? 1 : 0;
    ++all;
  }
  double percent() const { return 100.0 * within / all; }
};

struct Counts {
  Count share, rms, p95, max;
};

struct SimulatedPart {
  std::string name;
  std::vector<Planted> causes;
};

class Parts {
 public:
  Parts(const SimulatedPart& simulated, bool with_normals, unsigned seed)
      : case_(simulated), engine_(seed), seed_(seed) {
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
    for (const Planted& planted : case_.causes) {
      const double off = planted.u * normal_(engine_);
      const double truth = planted.is_measured ? planted.size : off,
                   value = planted.is_measured ? planted.size + off : 0;
      causes.push_back(new_cause("c", kPlacesOfPath));
      causes.back().layer = planted.layer;
      for (std::size_t p = 0; p < kPlacesOfPath; ++p) {
        const double f = form(planted.form, p);
        // Without normals, an error has two components.
        const Eigen::Vector3d along =
            path_.normal.empty() ? Eigen::Vector3d(0.6e-6, 0, 0.8e-6) : Eigen::Vector3d(0, 0, 1e-6);
        causes.back().value_m[p] = value * f * along;
        causes.back().u_m[p] = planted.u * f * along;
        of_layer[planted.layer][p] += truth * f;
        all[p] += truth * f;
      }
    }
    const PartError found =
        part_error(path_, causes, layers, {.seed = seed_ * 100'000ull + part_++, .shares = 1000});
    double sum = 0;
    for (const Errors& errors : of_layer) sum += rms_over_places(errors) * rms_over_places(errors);
    for (std::size_t k = 0; k < layers; ++k) {
      const PartShare& layer = found.layers[k];
      const double truth = rms_over_places(of_layer[k]);
      if (sum > 0)
        counts.share.add(layer.share_interval.low, truth * truth / sum, layer.share_interval.high);
      counts.rms.add(1e6 * layer.rms_interval_m.low, truth, 1e6 * layer.rms_interval_m.high);
    }
    for (double& x : all) x = std::abs(x);
    std::sort(all.begin(), all.end());
    counts.p95.add(1e6 * found.p95_interval_m.low, all[95], 1e6 * found.p95_interval_m.high);
    counts.max.add(1e6 * found.max_interval_m.low, all.back(), 1e6 * found.max_interval_m.high);
  }

 private:
  const SimulatedPart& case_;
  std::mt19937 engine_;
  std::normal_distribution<double> normal_;
  std::uint64_t seed_, part_ = 0;
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
    {"one layer of six causes equal to u",
     {{0, 0, 1, 1}, {0, 1, 1, 1}, {0, 2, 1, 1}, {0, 3, 1, 1}, {0, 4, 1, 1}, {0, 5, 1, 1}}},
};

TEST(PartCoverage, IntervalsContainTheTruth) {
  const char* const asked = std::getenv("MDOF_COVERAGE_RUNS");
  const int parts = asked ? std::atoi(asked) : 40;
  ASSERT_GT(parts, 0);
  std::printf("%-40s %8s %8s %8s %8s\n", "within the interval, %", "share", "RMS", "p95", "max");
  for (const SimulatedPart& simulated : kSimulatedParts)
    for (const bool with_normals : {true, false}) {
      Counts counts;
      Parts simulation(simulated, with_normals, with_normals ? 3 : 4);
      for (int part = 0; part < parts; ++part) simulation.simulate(counts);
      std::printf("%-40s %8.1f %8.1f %8.1f %8.1f\n",
                  (simulated.name + (with_normals ? "" : ", no normals")).c_str(),
                  counts.share.percent(), counts.rms.percent(), counts.p95.percent(),
                  counts.max.percent());
      for (const Count* count : {&counts.share, &counts.rms, &counts.p95, &counts.max})
        if (count->all > 0) {
          EXPECT_GE(count->percent(), parts >= 1000 ? 92 : 70) << simulated.name;
        }
    }
}

}  // namespace
}  // namespace mdof::algo
