#include "algo/sensitivity/adaptive.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace mdof::algo {
namespace {

// Tolerance of §7.9.2: u = c 10^l, where c is an integer with `digits` digits. The tolerance is
// 10^l / 2. Powers of ten are calculated as products, so they have the same bits on every computer.
double tolerance_of(double u, int digits) {
  double least = 1;  // smallest c: 10^(digits-1)
  for (int i = 1; i < digits; ++i) least *= 10;
  if (!(u > 0) || !std::isfinite(u)) return 0;
  double unit = 1;
  while (std::round(u / unit) >= least * 10) unit *= 10;
  while (std::round(u / unit) < least) unit /= 10;
  return unit / 2;
}

}  // namespace

Result<AdaptiveRule> AdaptiveRule::create(const std::vector<std::string>& outputs,
                                          const AdaptiveTolerance& tolerance) {
  if (tolerance.digits < 1 || tolerance.digits > 6) {
    return bad_input("digits is " + std::to_string(tolerance.digits) +
                     "; the number of significant digits of the standard uncertainty must be from "
                     "1 to 6");
  }
  AdaptiveRule rule;
  rule.digits_ = tolerance.digits;
  rule.outputs_.resize(outputs.size());
  for (const auto& [key, value] : tolerance.absolute) {
    const auto found = std::find(outputs.begin(), outputs.end(), key);
    if (found == outputs.end()) {
      std::string known;
      for (const std::string& output : outputs) known += (known.empty() ? "" : ", ") + output;
      return bad_input("tolerance of \"" + key + "\": the output is unknown; the outputs are " +
                       known);
    }
    if (!(value > 0) || !std::isfinite(value)) {
      return bad_input("tolerance of \"" + key + "\": must be a finite number above zero");
    }
    rule.outputs_[static_cast<std::size_t>(found - outputs.begin())].absolute = value;
  }
  return rule;
}

void AdaptiveRule::Spread::add(double x, bool is_first) {
  if (is_first) first = x;
  sum += x - first;
  squares += (x - first) * (x - first);
}

// Twice the standard deviation of the mean over the blocks, §7.9.4 g-h.
double AdaptiveRule::Spread::twice_s(std::uint64_t blocks) const {
  const auto h = static_cast<double>(blocks);
  const double about_mean = squares - sum * sum / h;
  return 2 * std::sqrt(std::max(0.0, about_mean) / (h * (h - 1)));
}

void AdaptiveRule::add(const std::vector<BlockFigures>& block) {
  assert(block.size() == outputs_.size());
  const bool first = blocks_ == 0;
  for (std::size_t k = 0; k < block.size(); ++k) {
    Output& o = outputs_[k];
    const BlockFigures& f = block[k];
    if (f.n < 2) o.never_settles = true;
    o.mean.add(f.mean, first);
    o.u.add(f.u, first);
    o.low.add(f.low, first);
    o.high.add(f.high, first);
    o.square_sum += f.u * f.u;
  }
  ++blocks_;
}

std::vector<AdaptiveRule::Progress> AdaptiveRule::progress() const {
  std::vector<Progress> progress;
  for (const Output& o : outputs_) {
    Progress& p = progress.emplace_back();
    p.worst = std::numeric_limits<double>::infinity();
    if (blocks_ == 0) continue;
    const double u = std::sqrt(o.square_sum / static_cast<double>(blocks_));
    p.tolerance = o.absolute > 0 ? o.absolute : tolerance_of(u, digits_);
    if (blocks_ < 2 || o.never_settles) continue;
    p.worst = std::max({o.mean.twice_s(blocks_), o.u.twice_s(blocks_), o.low.twice_s(blocks_),
                        o.high.twice_s(blocks_)});
    p.constant = u == 0 && p.worst == 0;
  }
  return progress;
}

std::optional<std::size_t> AdaptiveRule::unsettled_output() const {
  for (std::size_t k = 0; k < outputs_.size(); ++k)
    if (outputs_[k].never_settles) return k;
  return std::nullopt;
}

bool AdaptiveRule::settled() const {
  const std::vector<Progress> all = progress();
  return std::all_of(all.begin(), all.end(), [](const Progress& p) { return p.settled(); });
}

}  // namespace mdof::algo
