// Outputs of successive trials, one column for each output. Used for sums over blocks of trials.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace mdof::algo {

// Largest number of trials in a block if a trial takes milliseconds.
inline constexpr std::uint64_t kSlowSumBlock = 8;

// With fewer blocks the relative uncertainty 1/√(2(blocks - 1)) of a standard error is above 13 %.
inline constexpr std::uint64_t kFewSumBlocks = 30;

class Columns {
 public:
  Columns(std::size_t outputs, std::size_t n) : n_(n), value_(outputs * n) {
    for (std::size_t k = 0; k < outputs; ++k) place_.push_back(value_.data() + k * n);
  }
  Columns(Columns&&) = default;  // moving keeps the addresses in place_
  Columns(const Columns&) = delete;

  std::span<double* const> place() const { return place_; }
  double at(std::size_t output, std::size_t j) const { return value_[output * n_ + j]; }

  // Mean of the solved trials; 0 if no trial was solved.
  double mean(std::size_t output) const {
    double sum = 0, count = 0;
    for (std::size_t j = 0; j < n_; ++j) {
      if (!std::isfinite(at(output, j))) continue;
      sum += at(output, j);
      count += 1;
    }
    return count > 0 ? sum / count : 0;
  }

 private:
  std::size_t n_;
  std::vector<double> value_;
  std::vector<double*> place_;
};

// Number of trials in a block if the study has `trials` trials. There are at least 64 blocks, or
// one block for each trial, because the standard errors are calculated from the scatter of the
// blocks. A block has at most 4096 trials, so that the work is divided evenly among threads.
inline std::uint64_t sum_block_trials(std::uint64_t trials) {
  return std::clamp<std::uint64_t>(trials / 64, 1, 4096);
}

}  // namespace mdof::algo
