// An experiment with slow trials, which divides each call among threads.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "algo/sensitivity/experiment.h"

namespace mdof::tools {

// Runs the same trials as `experiment`, but divides each call to run() among threads, because a
// cell of slow trials, such as whole runs, takes seconds. Only one call at a time.
class DividedTrials final : public algo::Experiment {
 public:
  // go_on() is called several times a second. When it returns false, run() leaves out the trials
  // that have not begun.
  DividedTrials(const algo::Experiment& experiment, unsigned threads, std::function<bool()> go_on)
      : experiment_(experiment), threads_(threads), go_on_(std::move(go_on)) {}
  const std::vector<std::string>& outputs() const override { return experiment_.outputs(); }
  const algo::BinnedQuantity& binned() const override { return experiment_.binned(); }
  void run(std::uint64_t first, std::uint64_t step, std::size_t n,
           std::span<double* const> out) const override;
  std::uint64_t trials_run() const { return trials_run_; }  // Any thread.
  // True: trials are missing, so the results are invalid.
  bool was_interrupted() const { return is_interrupted_; }

 private:
  const algo::Experiment& experiment_;
  unsigned threads_;
  std::function<bool()> go_on_;
  mutable std::atomic<std::uint64_t> trials_run_ = 0;
  mutable std::atomic<bool> is_interrupted_ = false;
};

}  // namespace mdof::tools
