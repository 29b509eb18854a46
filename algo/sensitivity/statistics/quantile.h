// Order statistics from a histogram that contains every finite value. The bins of the core have
// equal width. Outside the core, the width of the bins increases with the distance from the
// core, up to the largest double.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <vector>

#include "algo/sensitivity/kernels/kernels.h"

namespace mdof::algo {

// Core of the histogram of one output: its lower end, and the width of each of its 8192 bins.
struct OutputScale {
  double low = 0, width = 0;
  double high() const { return low + width * static_cast<double>(kCoreBins); }
  bool operator==(const OutputScale&) const = default;
};

// The core for these values; values that are not finite are ignored. The core is twice as wide as
// the central 98 % of the values, with the same middle. If the values are equal except for
// rounding, the scatter of later values is unknown. The width of the core is then 1/512 of the
// values, or 1/512 of the unit if the values are below 1. The sums are then valid for later values
// from pm (prad) to more than mm (mrad).
OutputScale scale_for(std::vector<double> values);

// Counts of the values of one output. Core bin i is [low + i width, low + (i+1) width]; a value on
// an edge may be in either bin. The two tails are outside the core. Their bins have a relative
// width of 1/64: the number j of a bin is calculated from the top bits of the double 64 + distance
// / width. The key of a tail bin is j above the core and -j below the core.
class OutputHistogram {
 public:
  // `recent_capacity`: after this number of trials, the 32-bit counters are added to 64-bit
  // counters.
  explicit OutputHistogram(
      std::uint64_t recent_capacity = std::numeric_limits<std::uint32_t>::max())
      : recent_capacity_(recent_capacity), recent_(kCoreBins + 2) {}

  // Adds the values of a cell. `index`: bins from Kernels::scan. x is used only for values outside
  // the core.
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
  std::vector<std::uint32_t> recent_;   // below the core, core bins, above the core; 32 bits, so
                                        // that they stay in the cache
  std::uint64_t recent_n_ = 0;          // flush() is called before a counter can overflow
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

  // Index of the slice that contains the trial with this rank, 1 <= rank <= size().
  std::size_t find(std::uint64_t rank) const;
  // Estimate of the value with this rank. The values of a slice are assumed to be equally spaced.
  double value(std::size_t slice, std::uint64_t rank) const;
  double value(std::uint64_t rank) const { return value(find(rank), rank); }
  // Upper bound of the error of value().
  double resolution(std::uint64_t rank) const;

 private:
  void append(double from, double to, std::uint64_t count);

  std::vector<Slice> slices_;
  std::uint64_t n_ = 0;
  double min_, max_;
};

}  // namespace mdof::algo
