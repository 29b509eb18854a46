// An experiment for slow trials: each call to run() uses several threads.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "algo/sensitivity/experiment.h"

namespace mdof::tools {

// Runs the same trials as `experiment`, but divides the trials of each call to run() among threads.
// This is useful if one call takes seconds, for example if a trial is a whole simulated run. Only
// one call to run() at a time.
class DividedTrials final : public algo::Experiment {
 public:
  // run() calls go_on() several times a second. After go_on() has returned false, run() begins no
  // further trial.
  DividedTrials(const algo::Experiment& experiment, unsigned threads, std::function<bool()> go_on)
      : experiment_(experiment), threads_(threads), go_on_(std::move(go_on)) {
    outputs_ = experiment.outputs();
    binned_ = experiment.binned();
  }
  void run(std::uint64_t first, std::uint64_t step, std::size_t n,
           std::span<double* const> out) const override;
  std::uint64_t trials_run() const { return trials_run_; }  // Any thread.
  // True: run() has omitted trials; the results are invalid.
  bool was_interrupted() const { return is_interrupted_; }

 private:
  const algo::Experiment& experiment_;
  unsigned threads_;
  std::function<bool()> go_on_;
  mutable std::atomic<std::uint64_t> trials_run_ = 0;
  mutable std::atomic<bool> is_interrupted_ = false;
};

}  // namespace mdof::tools
