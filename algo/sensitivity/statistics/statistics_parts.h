// The data of StudyStatistics. Its two source files include this header.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "algo/sensitivity/statistics/moments.h"
#include "algo/sensitivity/statistics/quantile.h"
#include "algo/sensitivity/statistics/statistics.h"

namespace mdof::algo {

// The sums for one output in one bin of the binned quantity.
struct Accumulator {
  std::uint64_t n = 0, unsolved = 0;
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();
  PowerSums powers;
  OutputHistogram histogram;

  void add(const Accumulator& other);
};

struct StudyStatistics::Parts {
  std::vector<std::string> outputs;
  BinnedQuantity binned;
  StudyScale scale;
  InstructionSet set = InstructionSet::baseline;
  std::uint64_t trials = 0;
  std::vector<Accumulator> sums;  // [bin][output]

  Accumulator& at(std::size_t bin, std::size_t output) {
    return sums[bin * outputs.size() + output];
  }
};

}  // namespace mdof::algo
