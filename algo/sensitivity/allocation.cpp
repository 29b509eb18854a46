#include "algo/sensitivity/allocation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "algo/sensitivity/plan/columns.h"

namespace mdof::algo {
namespace {

constexpr std::size_t kChunk = 128;  // number of trials of one task; they take about a second for
                                     // whole runs
constexpr double kSettled = 5e-4;    // the bisection ends at this relative accuracy of the scale
constexpr double kLargest = 0x1p20, kSmallest = 0x1p-20;
constexpr double kTwoSided95 = 1.95996398454005423552;
constexpr std::size_t kFrontierPoints = 8;
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// Counts the trials whose output is within the limit, for given scales of the quantities.
class TrialsWithinLimit {
 public:
  TrialsWithinLimit(const ScalableExperiment& experiment, const PlannedAllocation& planned,
                    std::size_t output, const ForEach& for_each)
      : experiment_(experiment), planned_(planned), output_(output), for_each_(for_each) {}

  std::uint64_t count(const std::vector<double>& scale) const {
    const std::size_t chunks = (planned_.trials + kChunk - 1) / kChunk;
    std::vector<std::uint64_t> within(chunks, 0);
    for_each_(chunks, [&](std::size_t c) {
      const std::uint64_t first = c * kChunk;
      const std::size_t n = std::min<std::uint64_t>(kChunk, planned_.trials - first);
      Columns out(experiment_.outputs().size(), n);
      experiment_.run_scaled(scale, first, 1, n, out.place());
      for (std::size_t j = 0; j < n; ++j)
        if (std::abs(out.at(output_, j)) <= planned_.limit)
          ++within[c];  // NaN is not within the
                        // limit
    });
    return std::accumulate(within.begin(), within.end(), std::uint64_t{0});
  }

 private:
  const ScalableExperiment& experiment_;
  const PlannedAllocation& planned_;
  std::size_t output_;
  const ForEach& for_each_;
};

// Finds the largest common factor of the quantities `which`, with the other quantities at the
// scales `base`. Stores the counts, because the three searches for one tolerance use the same
// factors.
class FactorSearch {
 public:
  FactorSearch(const TrialsWithinLimit& within, std::vector<double> base,
               std::vector<std::size_t> which)
      : within_(within), base_(std::move(base)), which_(std::move(which)) {}

  // The largest factor for which at least `needed` trials are within the limit. 0: no factor is
  // small enough. Infinite: all factors are small enough.
  double largest(std::uint64_t needed) {
    if (count(0) < needed) return 0;
    double low = 1, high = 1;
    if (count(1) >= needed) {
      while (count(high) >= needed) {
        if (high >= kLargest) return std::numeric_limits<double>::infinity();
        low = high;
        high *= 2;
      }
    } else {
      while (count(low) < needed) {
        if (low <= kSmallest) return 0;
        high = low;
        low /= 2;
      }
    }
    while (high - low > kSettled * high) {
      const double middle = (low + high) / 2;
      (count(middle) >= needed ? low : high) = middle;
    }
    return low;
  }

 private:
  std::uint64_t count(double factor) {
    const auto known = known_.find(factor);
    if (known != known_.end()) return known->second;
    std::vector<double> scale = base_;
    for (const std::size_t q : which_) scale[q] *= factor;
    return known_[factor] = within_.count(scale);
  }

  const TrialsWithinLimit& within_;
  std::vector<double> base_;
  std::vector<std::size_t> which_;
  std::map<double, std::uint64_t> known_;
};

// Necessary numbers of trials within the limit: for the probability (nominal), and for the two ends
// of its sampling uncertainty (more, fewer).
struct CountsNeeded {
  std::uint64_t nominal, more, fewer;
  CountsNeeded(std::uint64_t trials, double p) {
    const auto n = static_cast<double>(trials);
    const double spread = kTwoSided95 * std::sqrt(n * p * (1 - p));
    nominal = static_cast<std::uint64_t>(std::ceil(n * p));
    more = static_cast<std::uint64_t>(std::min(n, std::ceil(n * p + spread)));
    fewer = static_cast<std::uint64_t>(std::max(1.0, std::floor(n * p - spread)));
  }
};

// factor * size. A tolerance of size 0 has size 0 also for an infinite factor.
double times(double factor, double size) {
  return size == 0 ? 0 : factor * size;
}

using Frontier = std::vector<std::vector<AllocatedTolerance>>;

Frontier frontier(const ScalableExperiment& experiment, const TrialsWithinLimit& within,
                  const CountsNeeded& needed, std::size_t first, std::size_t second) {
  const auto& names = experiment.quantities();
  const auto& sizes = experiment.sizes();
  std::vector<double> base(names.size(), 1.0);
  base[second] = 0;
  const double most = FactorSearch(within, base, {first}).largest(needed.nominal);
  Frontier pairs;
  if (!std::isfinite(most) || most == 0) return pairs;
  base[second] = 1;
  for (std::size_t i = 0; i < kFrontierPoints; ++i) {
    const double factor = most * static_cast<double>(i) / static_cast<double>(kFrontierPoints - 1);
    base[first] = factor;
    const double other = FactorSearch(within, base, {second}).largest(needed.nominal);
    pairs.push_back({{names[first], times(factor, sizes[first]), kUnknown, kUnknown},
                     {names[second], times(other, sizes[second]), kUnknown, kUnknown}});
  }
  return pairs;
}

Result<std::size_t> place_of(const char* kind, const std::string& name,
                             const std::vector<std::string>& names,
                             const PlannedAllocation& planned) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    return bad_input(planned.where + ": this study has no " + kind + " \"" + name + "\"");
  return static_cast<std::size_t>(found - names.begin());
}

}  // namespace

void one_after_the_other(std::size_t count, const std::function<void(std::size_t)>& task) {
  for (std::size_t i = 0; i < count; ++i) task(i);
}

Result<Allocation> allocate(const ScalableExperiment& experiment, const PlannedAllocation& planned,
                            const ForEach& for_each) {
  MDOF_TRY(const std::size_t output,
           place_of("output", planned.output, experiment.outputs(), planned));
  std::vector<std::size_t> which;
  for (const auto& name : planned.tolerances) {
    MDOF_TRY(const std::size_t at, place_of("quantity", name, experiment.quantities(), planned));
    which.push_back(at);
  }
  const TrialsWithinLimit within(experiment, planned, output, for_each);
  const CountsNeeded needed(planned.trials, planned.probability);
  const std::vector<double> as_planned(experiment.quantities().size(), 1.0);
  Allocation result{planned.output, planned.limit, planned.probability, 0, {}, 0, {}};
  result.reached =
      static_cast<double>(within.count(as_planned)) / static_cast<double>(planned.trials);
  for (const std::size_t q : which) {
    FactorSearch search(within, as_planned, {q});
    const double size = experiment.sizes()[q];
    result.alone.push_back({experiment.quantities()[q], times(search.largest(needed.nominal), size),
                            times(search.largest(needed.more), size),
                            times(search.largest(needed.fewer), size)});
  }
  result.common_factor = FactorSearch(within, as_planned, which).largest(needed.nominal);
  if (which.size() >= 2) result.frontier = frontier(experiment, within, needed, which[0], which[1]);
  return result;
}

Result<double> largest_factor(const ScalableExperiment& experiment,
                              const PlannedAllocation& planned,
                              const std::vector<std::size_t>& which, const ForEach& for_each) {
  MDOF_TRY(const std::size_t output,
           place_of("output", planned.output, experiment.outputs(), planned));
  const TrialsWithinLimit within(experiment, planned, output, for_each);
  const std::vector<double> as_planned(experiment.quantities().size(), 1.0);
  return FactorSearch(within, as_planned, which)
      .largest(CountsNeeded(planned.trials, planned.probability).nominal);
}

}  // namespace mdof::algo
