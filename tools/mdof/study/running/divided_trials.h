// An experiment whose trials are slow, each call on several threads.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "algo/sensitivity/experiment.h"

namespace mdof::tools {

// The same trials, each call to run() divided among threads: for trials so slow that a cell of
// them takes seconds, as whole runs are. One call at a time.
class DividedTrials final : public algo::Experiment {
 public:
  // go_on(): asked several times a second; once false, run() leaves out the trials not begun.
  DividedTrials(const algo::Experiment& experiment, unsigned threads, std::function<bool()> go_on)
      : experiment_(experiment), threads_(threads), go_on_(std::move(go_on)) {}
  const std::vector<std::string>& outputs() const override { return experiment_.outputs(); }
  const algo::BinnedQuantity& binned() const override { return experiment_.binned(); }
  void run(std::uint64_t first, std::uint64_t step, std::size_t n,
           std::span<double* const> out) const override;
  std::uint64_t trials_run() const { return trials_run_; }  // any thread
  bool cut_short() const { return cut_short_; }  // trials were left out: what came of it is void

 private:
  const algo::Experiment& experiment_;
  unsigned threads_;
  std::function<bool()> go_on_;
  mutable std::atomic<std::uint64_t> trials_run_ = 0;
  mutable std::atomic<bool> cut_short_ = false;
};

}  // namespace mdof::tools
