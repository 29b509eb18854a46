#include "algo/sensitivity/comparison.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace mdof::algo {
namespace {

Columns evaluate(const Experiment& experiment, std::uint64_t first, std::uint64_t n) {
  Columns columns(experiment.outputs().size(), n);
  experiment.run(first, 1, n, columns.place());
  return columns;
}

double variance(double n, double sum, double squares) {
  return n > 1 ? std::max(0.0, (squares - sum * sum / n) / (n - 1)) : 0;
}

double squares_about(double mean, double n, double sum, double squares) {
  return std::max(0.0, squares - 2 * mean * sum + mean * mean * n);
}

}  // namespace

ComparisonSums::ComparisonSums(const Experiment& ours, const Experiment& other,
                               std::uint64_t block_trials)
    : block_trials_(block_trials), ours_(ours.outputs().size()), other_(other.outputs().size()) {
  const Columns a = evaluate(ours, 0, block_trials), b = evaluate(other, 0, block_trials);
  for (std::size_t i = 0; i < ours_; ++i) {
    const auto& names = other.outputs();
    const auto found = std::find(names.begin(), names.end(), ours.outputs()[i]);
    if (found == names.end()) continue;
    const auto k = static_cast<std::size_t>(found - names.begin());
    pairs_.push_back({*found, i, k, a.mean(i), b.mean(k)});
  }
}

void ComparisonSums::add_block(const Experiment& ours, const Experiment& other,
                               std::uint64_t block) {
  assert(ours.outputs().size() == ours_ && other.outputs().size() == other_);
  const std::uint64_t first = block * block_trials_;
  const Columns a = evaluate(ours, first, block_trials_);
  const Columns b = evaluate(other, first, block_trials_);
  auto& sums = blocks_[block];
  sums.assign(pairs_.size(), Sums{});
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    const Pair& pair = pairs_[p];
    for (std::size_t j = 0; j < block_trials_; ++j) {
      const double x = a.at(pair.ours, j) - pair.centre_ours;
      const double y = b.at(pair.other, j) - pair.centre_other;
      if (!std::isfinite(x) || !std::isfinite(y)) continue;
      Sums& s = sums[p];
      s.n += 1;
      s.ours += x;
      s.ours2 += x * x;
      s.other += y;
      s.other2 += y * y;
    }
  }
}

void ComparisonSums::merge(const ComparisonSums& sums) {
  assert(sums.pairs_.size() == pairs_.size());
  blocks_.insert(sums.blocks_.begin(), sums.blocks_.end());
}

std::vector<ComparedOutput> ComparisonSums::result() const {
  std::vector<ComparedOutput> results;
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    Sums all;
    for (const auto& [block, sums] : blocks_) {
      all.n += sums[p].n;
      all.ours += sums[p].ours;
      all.ours2 += sums[p].ours2;
      all.other += sums[p].other;
      all.other2 += sums[p].other2;
    }
    const double v = variance(all.n, all.ours, all.ours2);
    const double w = variance(all.n, all.other, all.other2);
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    ComparedOutput c{pairs_[p].key, std::sqrt(v), std::sqrt(w), unknown, unknown};
    if (v > 0) c.ratio = std::sqrt(w / v);
    if (v > 0 && w > 0 && blocks_.size() > 1) {
      // To first order, the change of the ratio √(w/v) of the variances v and w is ratio/2 (dw/w -
      // dv/v). The squares are taken about the means of all trials, so that a block can have only
      // one trial.
      const double mean_ours = all.ours / all.n, mean_other = all.other / all.n;
      double squares = 0;
      for (const auto& [block, sums] : blocks_) {
        const Sums& s = sums[p];
        const double off = squares_about(mean_other, s.n, s.other, s.other2) / w -
                           squares_about(mean_ours, s.n, s.ours, s.ours2) / v;
        squares += off * off;
      }
      const auto n = static_cast<double>(blocks_.size());
      c.ratio_se = c.ratio / 2 * std::sqrt(squares * n / (n - 1)) / all.n;
    }
    results.push_back(c);
  }
  return results;
}

}  // namespace mdof::algo
