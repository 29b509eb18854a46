#include "algo/sensitivity/indices.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace mdof::algo {
namespace {

constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

// Ratio of two sums over blocks, and the standard error of this ratio from the residuals of the
// blocks (Cochran, Sampling Techniques, §6.4).
struct Ratio {
  double value = 0, se = kNotKnown;
};
Ratio ratio_of(const std::vector<double>& above, const std::vector<double>& below) {
  double top = 0, bottom = 0;
  for (const double x : above) top += x;
  for (const double x : below) bottom += x;
  if (!(bottom > 0)) return {0, 0};
  Ratio ratio{top / bottom, kNotKnown};
  const auto n = static_cast<double>(above.size());
  if (above.size() < 2) return ratio;
  double sum = 0;
  for (std::size_t b = 0; b < above.size(); ++b) {
    const double left = above[b] - ratio.value * below[b];
    sum += left * left;
  }
  ratio.se = std::sqrt(sum * n / (n - 1)) / bottom;
  return ratio;
}

}  // namespace

SobolSums::SobolSums(const CausalExperiment& experiment, std::uint64_t block_trials)
    : block_trials_(block_trials), outputs_(experiment.outputs()), causes_(experiment.causes()) {
  const std::uint64_t trials = std::max<std::uint64_t>(block_trials, 16);
  Columns pilot(outputs_.size(), trials);
  experiment.run(0, 1, trials, pilot.place());
  for (std::size_t k = 0; k < outputs_.size(); ++k) centre_.push_back(pilot.mean(k));
}

void SobolSums::add_block(const CausalExperiment& experiment, std::uint64_t block) {
  assert(experiment.outputs() == outputs_ && experiment.causes() == causes_);
  const std::size_t n = block_trials_;
  const std::uint64_t first = block * n;
  std::vector<std::uint8_t> second(causes_.size(), 0);
  Columns a(outputs_.size(), n), b(outputs_.size(), n);
  experiment.run_mixed(second, first, 1, n, a.place());
  std::fill(second.begin(), second.end(), std::uint8_t{1});
  experiment.run_mixed(second, first, 1, n, b.place());
  std::vector<Columns> mixed;
  for (std::size_t c = 0; c < causes_.size(); ++c) {
    std::fill(second.begin(), second.end(), std::uint8_t{0});
    second[c] = 1;
    mixed.emplace_back(outputs_.size(), n);
    experiment.run_mixed(second, first, 1, n, mixed.back().place());
  }
  auto& sums = blocks_[block];
  for (std::size_t k = 0; k < outputs_.size(); ++k) {
    sums.push_back({0, 0, 0, std::vector<Cause>(causes_.size())});
    for (std::size_t j = 0; j < n; ++j) add_trial(a, b, mixed, k, j, sums.back());
  }
}

void SobolSums::add_trial(const Columns& a, const Columns& b, const std::vector<Columns>& mixed,
                          std::size_t output, std::size_t j, Sums& s) const {
  const double centre = centre_[output];
  const double fa = a.at(output, j) - centre, fb = b.at(output, j) - centre;
  bool solved = std::isfinite(fa) && std::isfinite(fb);
  for (const Columns& m : mixed) solved = solved && std::isfinite(m.at(output, j));
  if (!solved) return;
  s.n += 1;
  s.s1 += fa + fb;
  s.s2 += fa * fa + fb * fb;
  for (std::size_t c = 0; c < causes_.size(); ++c) {
    const double change = (mixed[c].at(output, j) - centre) - fa;
    s.causes[c].first += fb * change;
    s.causes[c].total += change * change;
  }
}

void SobolSums::merge(const SobolSums& other) {
  assert(other.outputs_ == outputs_ && other.causes_ == causes_);
  blocks_.insert(other.blocks_.begin(), other.blocks_.end());
}

OutputIndices SobolSums::result_of(std::size_t output) const {
  double n = 0, s1 = 0;
  for (const auto& [block, sums] : blocks_) {
    n += sums[output].n;
    s1 += sums[output].s1;
  }
  const double mean = n > 0 ? s1 / (2 * n) : 0;
  // For each block: n times the variance of f_A and f_B together about `mean`.
  std::vector<double> variance;
  for (const auto& [block, sums] : blocks_) {
    const Sums& s = sums[output];
    variance.push_back(std::max(0.0, (s.s2 - 2 * mean * s.s1) / 2 + mean * mean * s.n));
  }
  OutputIndices result{outputs_[output], {}};
  for (std::size_t c = 0; c < causes_.size(); ++c) {
    std::vector<double> first, total;
    for (const auto& [block, sums] : blocks_) {
      first.push_back(sums[output].causes[c].first);
      total.push_back(sums[output].causes[c].total / 2);
    }
    const Ratio s = ratio_of(first, variance), t = ratio_of(total, variance);
    result.causes.push_back({causes_[c], s.value, s.se, t.value, t.se});
  }
  std::stable_sort(result.causes.begin(), result.causes.end(),
                   [](const CauseIndex& x, const CauseIndex& y) { return x.total > y.total; });
  return result;
}

std::vector<OutputIndices> SobolSums::result() const {
  std::vector<OutputIndices> all;
  for (std::size_t k = 0; k < outputs_.size(); ++k) all.push_back(result_of(k));
  return all;
}

}  // namespace mdof::algo
