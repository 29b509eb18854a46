// Ranks, quantiles and coverage intervals of a sorted list, and of the histogram that replaces one.
// Definitions of JCGM 101:2008 §7.7, over M trials in ascending order, ranks from 1.
#pragma once

#include <cstdint>
#include <vector>

#include "algo/sensitivity/statistics/quantile.h"
#include "schema/study/study.h"

namespace mdof::algo {

// Rank of the quantile p: the integer part of p M + 1/2, within 1 ... M.
std::uint64_t quantile_rank(double p, std::uint64_t trials);

// [y(r), y(r + q)] with q = p M, or the integer part of p M + 1/2; r = (M - q) / 2, or the integer
// part of (M - q + 1) / 2.
struct IntervalRanks {
  std::uint64_t low = 1, high = 1;
};
IntervalRanks symmetric_ranks(double coverage, std::uint64_t trials);

// The interval r, r + q for which y(r + q) - y(r) is smallest (§7.7.4; the smallest such r). Its
// length differs from the shortest length of the exact order statistics by at most twice the width
// of the bins.
IntervalRanks shortest_ranks(double coverage, const OrderedTrials& trials);

// Sets quantiles, intervals and resolution of a summary.
void summarise_order(const OrderedTrials& trials, double coverage,
                     const std::vector<double>& quantiles, OutputSummary& summary);

// For drawing: about 120 bars over the central 99.8 % and a tenth more on each side.
Histogram histogram_for_drawing(const OutputHistogram& counts, const OutputScale& scale,
                                const OrderedTrials& trials);

}  // namespace mdof::algo
