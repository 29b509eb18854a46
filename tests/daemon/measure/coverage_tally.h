// Counts for each figure how often its stated 95 % interval contains the true value.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <string>

namespace mdof::daemon {

constexpr double kTwoSided = 1.959964;

struct Tally {
  int inside = 0, all = 0;
  double square = 0, U_square = 0;
  double percent() const { return 100.0 * inside / all; }
  double over_spread() const { return std::sqrt(U_square / square) / kTwoSided; }
};
using Coverage = std::map<std::string, Tally>;

inline void count(Coverage& coverage, const std::string& what, double value, double truth,
                  double U) {
  Tally& tally = coverage[what];
  ++tally.all;
  tally.inside += std::abs(value - truth) <= U;
  tally.square += (value - truth) * (value - truth);
  tally.U_square += U * U;
}

inline void expect_covered(const Coverage& coverage, int pairs, double least_percent) {
  const double three_sd = 65 / std::sqrt(pairs);
  for (const auto& [what, tally] : coverage) {
    std::printf("%-22s %5.1f %%, U %.2f of 1.96 times the spread\n", what.c_str(), tally.percent(),
                tally.over_spread());
    EXPECT_GT(tally.percent(), least_percent - three_sd) << what;
  }
}

}  // namespace mdof::daemon
