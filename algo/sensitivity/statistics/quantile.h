// Order statistics from a histogram that loses no trial: bins of equal width in a core, and beyond
// it bins that become wider with the distance, up to the largest double.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <vector>

#include "algo/sensitivity/kernels/kernels.h"

namespace mdof::algo {

// Core of the histogram of one output: `low`, and the width of each of its 8192 bins.
struct OutputScale {
  double low = 0, width = 0;
  double high() const { return low + width * static_cast<double>(kCoreBins); }
  bool operator==(const OutputScale&) const = default;
};

// The core for these values (finite or not): twice as wide as their central 98 %, with the same
// middle. Values that are equal except for rounding do not show how much later values differ: the
// core is then 1/512 of the values, or 1/512 of the unit if they are smaller. Sums are then valid
// from pm and prad to beyond mm and mrad.
OutputScale scale_for(std::vector<double> values);

// Counts of one output. Core bin i is [low + i width, low + (i+1) width]; a value on an edge may be
// in either bin. The bins of a tail have a relative width of 1/64: bin j starts where 64 + distance
// / width has j in the top bits of its double. Tail keys above the core are positive, those below
// are negative.
class OutputHistogram {
 public:
  // `recent_capacity`: number of trials after which the small counters are added to large ones.
  explicit OutputHistogram(
      std::uint64_t recent_capacity = std::numeric_limits<std::uint32_t>::max())
      : recent_capacity_(recent_capacity), recent_(kCoreBins + 2) {}

  // Adds a cell. `index`: from Kernels::scan; x is read only for values outside the core.
  void add(std::span<const double> x, const std::uint64_t* index, const OutputScale& scale);
  void add(const OutputHistogram& other);
  void add_core(std::size_t bin, std::uint64_t n) { total_at(bin) += n; }
  void add_tail(std::int32_t key, std::uint64_t n) { tails_[key] += n; }

  std::uint64_t core(std::size_t bin) const {
    return recent_[bin + 1] + (flushed_.empty() ? 0 : flushed_[bin]);
  }
  const std::map<std::int32_t, std::uint64_t>& tails() const { return tails_; }
  static constexpr std::int32_t kLastTail = 65153;
  std::size_t memory_bytes() const;

 private:
  void flush();
  std::uint64_t& total_at(std::size_t bin);

  std::uint64_t recent_capacity_;
  std::vector<std::uint32_t> recent_;   // below, core, above; small, to stay in the cache
  std::uint64_t recent_n_ = 0;          // flushed before a counter could overflow
  std::vector<std::uint64_t> flushed_;  // empty until the first flush
  std::map<std::int32_t, std::uint64_t> tails_;
};

// The trials of one output in ascending order, with the resolution of the histogram.
class OrderedTrials {
 public:
  OrderedTrials(const OutputHistogram& counts, const OutputScale& scale, double min, double max);

  // `count` trials in [from, to]; the first one has the rank before + 1.
  struct Slice {
    double from, to;
    std::uint64_t before, count;
  };
  const std::vector<Slice>& slices() const { return slices_; }
  std::uint64_t size() const { return n_; }
  double min() const { return min_; }
  double max() const { return max_; }

  // Index of the slice of the trial of this rank, 1 <= rank <= size().
  std::size_t find(std::uint64_t rank) const;
  // Estimate of the rank-th smallest value, evenly spread within its slice.
  double value(std::size_t slice, std::uint64_t rank) const;
  double value(std::uint64_t rank) const { return value(find(rank), rank); }
  // Largest distance of value() from the true rank-th smallest value.
  double resolution(std::uint64_t rank) const;

 private:
  void append(double from, double to, std::uint64_t count);

  std::vector<Slice> slices_;
  std::uint64_t n_ = 0;
  double min_, max_;
};

}  // namespace mdof::algo
