#include "algo/sensitivity/statistics/quantile.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

namespace mdof::algo {
namespace {

// The tails have 64 bins for each octave of 64 + distance. The unit of the distance is the width of
// a core bin.
constexpr int kMantissaBits = 6;
constexpr double kOffset = 64;

std::uint64_t top_bits(double x) {
  return std::bit_cast<std::uint64_t>(x) >> (52 - kMantissaBits);
}

std::int32_t tail_bin(double distance) {
  return static_cast<std::int32_t>(top_bits(kOffset + distance) - top_bits(kOffset)) + 1;
}

// Distance at which a tail bin begins, in widths of a core bin.
double tail_edge(std::int32_t bin) {
  const std::uint64_t bits = top_bits(kOffset) + static_cast<std::uint64_t>(bin - 1);
  return std::bit_cast<double>(bits << (52 - kMantissaBits)) - kOffset;
}

std::int32_t tail_key(double x, const OutputScale& scale) {
  const double high = scale.high();
  if (x > scale.low + (high - scale.low) / 2) {
    return tail_bin(std::max(0.0, (x - high) / scale.width));
  }
  return -tail_bin(std::max(0.0, (scale.low - x) / scale.width));
}

// Because of rounding, a value can be in the wrong bin if it is nearer to the edge than this part
// of the width of a bin.
constexpr double kEdgeSlack = 1e-9;

}  // namespace

OutputScale scale_for(std::vector<double> values) {
  std::erase_if(values, [](double x) { return !std::isfinite(x); });
  if (values.empty()) return {-1, 2.0 / kCoreBins};
  std::sort(values.begin(), values.end());
  const std::size_t cut = values.size() / 100;
  double from = values[cut], to = values[values.size() - 1 - cut];
  if (from == to) {
    from = values.front();
    to = values.back();
  }
  const double middle = from / 2 + to / 2, size = std::abs(middle);
  const bool constant = to - from <= size * 0x1p-44;
  // The core must be so wide that the edges of the bins are different numbers, and must not
  // overflow.
  const double least = constant ? std::max(size, 1.0) / 512 : std::max(size * 0x1p-30, 1e-200);
  const double range = std::clamp(2 * (to - from), std::min(least, 1e300), 1e300);
  return {middle - range / 2, range / kCoreBins};
}

void OutputHistogram::add(std::span<const double> x, const std::uint64_t* index,
                          const OutputScale& scale) {
  if (recent_n_ + x.size() > recent_capacity_) flush();
  recent_n_ += x.size();
  std::uint32_t* const counts = recent_.data();
#pragma GCC unroll 8
  for (std::size_t i = 0; i < x.size(); ++i) ++counts[index[i]];
  if (counts[0] == 0 && counts[kCoreBins + 1] == 0) return;
  counts[0] = counts[kCoreBins + 1] = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (index[i] == 0 || index[i] == kCoreBins + 1) ++tails_[tail_key(x[i], scale)];
  }
}

void OutputHistogram::add(const OutputHistogram& other) {
  for (std::size_t i = 0; i < kCoreBins; ++i) {
    if (const std::uint64_t n = other.core(i); n > 0) total_at(i) += n;
  }
  for (const auto& [key, n] : other.tails_) tails_[key] += n;
}

void OutputHistogram::flush() {
  for (std::size_t i = 0; i < kCoreBins; ++i) total_at(i) += recent_[i + 1];
  std::fill(recent_.begin(), recent_.end(), 0);
  recent_n_ = 0;
}

std::uint64_t& OutputHistogram::total_at(std::size_t bin) {
  if (flushed_.empty()) flushed_.resize(kCoreBins);
  return flushed_[bin];
}

std::size_t OutputHistogram::memory_bytes() const {
  constexpr std::size_t kNode =
      64;  // bytes of a map node: three pointers, colour, key, count, heap header
  return recent_.capacity() * sizeof(std::uint32_t) + flushed_.capacity() * sizeof(std::uint64_t) +
         tails_.size() * kNode;
}

OrderedTrials::OrderedTrials(const OutputHistogram& counts, const OutputScale& scale, double min,
                             double max)
    : min_(min), max_(max) {
  const auto above = counts.tails().lower_bound(0);
  const double high = scale.high();
  for (auto tail = counts.tails().begin(); tail != above; ++tail) {
    append(scale.low - scale.width * tail_edge(-tail->first + 1),
           scale.low - scale.width * tail_edge(-tail->first), tail->second);
  }
  for (std::size_t i = 0; i < kCoreBins; ++i) {
    if (const std::uint64_t n = counts.core(i); n > 0) {
      const double from = scale.low + scale.width * static_cast<double>(i);
      append(from, from + scale.width, n);
    }
  }
  for (auto tail = above; tail != counts.tails().end(); ++tail) {
    append(high + scale.width * tail_edge(tail->first),
           high + scale.width * tail_edge(tail->first + 1), tail->second);
  }
}

// Adds a slice. If an edge of the slice is not finite, or is outside [min, max], it is replaced by
// min or max.
void OrderedTrials::append(double from, double to, std::uint64_t count) {
  if (!std::isfinite(from)) from = min_;
  if (!std::isfinite(to)) to = max_;
  slices_.push_back({std::clamp(from, min_, max_), std::clamp(to, min_, max_), n_, count});
  n_ += count;
}

std::size_t OrderedTrials::find(std::uint64_t rank) const {
  assert(rank >= 1 && rank <= n_);
  const auto after =
      std::upper_bound(slices_.begin(), slices_.end(), rank - 1,
                       [](std::uint64_t before, const Slice& s) { return before < s.before; });
  return static_cast<std::size_t>(after - slices_.begin()) - 1;
}

double OrderedTrials::value(std::size_t slice, std::uint64_t rank) const {
  if (rank == 1) return min_;
  if (rank == n_) return max_;
  const Slice& s = slices_[slice];
  const double share = (static_cast<double>(rank - s.before) - 0.5) / static_cast<double>(s.count);
  return s.from + (s.to - s.from) * share;
}

double OrderedTrials::resolution(std::uint64_t rank) const {
  if (rank == 1 || rank == n_) return 0;
  const Slice& s = slices_[find(rank)];
  return (s.to - s.from) * (1 + kEdgeSlack);
}

}  // namespace mdof::algo
