// Ranks, quantiles and coverage intervals of a sorted list, or of a histogram in place of a list.
// Definitions as in JCGM 101:2008 §7.7. The M trials are in ascending order; the first rank is 1.
#pragma once

#include <cstdint>
#include <vector>

#include "algo/sensitivity/statistics/quantile.h"
#include "schema/study/study.h"

namespace mdof::algo {

// Rank of the quantile p: the integer part of p M + 1/2, limited to 1 ... M.
std::uint64_t quantile_rank(double p, std::uint64_t trials);

// Ranks of the symmetric coverage interval [y(r), y(r + q)] for the coverage p:
//   q = p M if this is an integer, otherwise the integer part of p M + 1/2
//   r = (M - q) / 2 if this is an integer, otherwise the integer part of (M - q + 1) / 2
struct IntervalRanks {
  std::uint64_t low = 1, high = 1;
};
IntervalRanks symmetric_ranks(double coverage, std::uint64_t trials);

// Ranks r and r + q of the shortest coverage interval: y(r + q) - y(r) is smallest (§7.7.4). If
// several r are possible, r is the smallest one. The length of the interval exceeds the shortest
// length of the exact order statistics by at most twice the width of the bins.
IntervalRanks shortest_ranks(double coverage, const OrderedTrials& trials);

// Sets quantiles, coverage intervals and resolution of `summary`.
void summarise_order(const OrderedTrials& trials, double coverage,
                     const std::vector<double>& quantiles, OutputSummary& summary);

// A histogram for drawing: about 120 bars over the central 99.8 % of the trials, plus a tenth of
// this range at each end.
Histogram histogram_for_drawing(const OutputHistogram& counts, const OutputScale& scale,
                                const OrderedTrials& trials);

}  // namespace mdof::algo
