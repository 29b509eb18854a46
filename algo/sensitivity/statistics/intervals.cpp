#include "algo/sensitivity/statistics/intervals.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mdof::algo {
namespace {

// q of §7.7: rank of the upper end minus rank of the lower end of an interval, limited to M - 1.
std::uint64_t covered(double coverage, std::uint64_t trials) {
  const auto q =
      static_cast<std::uint64_t>(std::floor(coverage * static_cast<double>(trials) + 0.5));
  return std::min(q, trials - 1);
}

// Finds the values of ascending ranks, in constant time for each rank.
class Cursor {
 public:
  explicit Cursor(const OrderedTrials& trials) : trials_(&trials) {}
  double value(std::uint64_t rank) {
    const auto& slices = trials_->slices();
    while (slices[at_].before + slices[at_].count < rank) ++at_;
    return trials_->value(at_, rank);
  }

 private:
  const OrderedTrials* trials_;
  std::size_t at_ = 0;
};

struct Shortest {
  double length = std::numeric_limits<double>::infinity();
  std::uint64_t low = 1;
};

// Searches the shortest interval among the ranks r = (rank at one end of a slice) - shift, for all
// slices. last: true: at the upper end of each slice; false: at the lower end.
void search_at_slice_ends(const OrderedTrials& trials, std::uint64_t q, std::uint64_t shift,
                          bool last, Shortest& best) {
  Cursor low(trials), high(trials);
  for (const OrderedTrials::Slice& s : trials.slices()) {
    const std::uint64_t end = s.before + (last ? s.count : 1);
    if (end <= shift || end - shift + q > trials.size()) continue;
    const std::uint64_t r = end - shift;
    const double length = high.value(r + q) - low.value(r);
    if (length < best.length || (length == best.length && r < best.low)) best = {length, r};
  }
}

}  // namespace

std::uint64_t quantile_rank(double p, std::uint64_t trials) {
  const double rank = std::floor(p * static_cast<double>(trials) + 0.5);
  return std::clamp<std::uint64_t>(static_cast<std::uint64_t>(rank), 1, trials);
}

IntervalRanks symmetric_ranks(double coverage, std::uint64_t trials) {
  const std::uint64_t q = covered(coverage, trials);
  const std::uint64_t r = (trials - q + 1) / 2;  // equal to (trials - q) / 2 if trials - q is even
  return {r, r + q};
}

// y(r + q) - y(r) is linear in r while r and r + q stay in their slices. Therefore the minimum is
// where r or r + q is at an end of a slice.
IntervalRanks shortest_ranks(double coverage, const OrderedTrials& trials) {
  const std::uint64_t q = covered(coverage, trials.size());
  Shortest best;
  for (const std::uint64_t shift : {std::uint64_t{0}, q}) {
    search_at_slice_ends(trials, q, shift, false, best);
    search_at_slice_ends(trials, q, shift, true, best);
  }
  return {best.low, best.low + q};
}

void summarise_order(const OrderedTrials& trials, double coverage,
                     const std::vector<double>& quantiles, OutputSummary& summary) {
  const auto value = [&](std::uint64_t rank) {
    summary.resolution = std::max(summary.resolution, trials.resolution(rank));
    return trials.value(rank);
  };
  for (const double p : quantiles) {
    summary.quantiles.push_back({p, value(quantile_rank(p, trials.size()))});
  }
  const IntervalRanks symmetric = symmetric_ranks(coverage, trials.size());
  const IntervalRanks shortest = shortest_ranks(coverage, trials);
  summary.coverage = coverage;
  summary.symmetric = {value(symmetric.low), value(symmetric.high)};
  summary.shortest = {value(shortest.low), value(shortest.high)};
}

Histogram histogram_for_drawing(const OutputHistogram& counts, const OutputScale& scale,
                                const OrderedTrials& trials) {
  constexpr double kBars = 120;
  const double q_low = trials.value(quantile_rank(0.001, trials.size()));
  const double q_high = trials.value(quantile_rank(0.999, trials.size()));
  const double more = (q_high - q_low) / 10;
  // Each bar contains complete bins of the core.
  const auto bin = [&](double x) {
    const double i = std::floor((x - scale.low) / scale.width);
    return static_cast<std::size_t>(std::clamp(i, 0.0, static_cast<double>(kCoreBins - 1)));
  };
  const auto& slices = trials.slices();
  const std::size_t first = bin(std::max(q_low - more, slices.front().from));
  const std::size_t last = bin(std::min(q_high + more, slices.back().to));
  const auto group = static_cast<std::size_t>(
      std::max(1.0, std::ceil(static_cast<double>(last - first + 1) / kBars)));
  Histogram h;
  h.from = scale.low + scale.width * static_cast<double>(first);
  h.width = scale.width * static_cast<double>(group);
  h.counts.assign((last - first) / group + 1, 0);
  for (const auto& [key, n] : counts.tails()) (key < 0 ? h.below : h.above) += n;
  for (std::size_t i = 0; i < kCoreBins; ++i) {
    const std::size_t bar = i < first ? h.counts.size() : (i - first) / group;
    (i < first ? h.below : bar < h.counts.size() ? h.counts[bar] : h.above) += counts.core(i);
  }
  return h;
}

}  // namespace mdof::algo
