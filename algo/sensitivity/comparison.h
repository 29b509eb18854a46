// Compares two fixtures in a study. Both use the same random numbers, so only the fixtures cause a
// difference.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "algo/sensitivity/experiment.h"
#include "algo/sensitivity/plan/columns.h"
#include "schema/study/study.h"

namespace mdof::algo {

// Compares the outputs that both experiments have. The result has the same bits for any order of
// the blocks and any number of threads, as in SobolSums.
class ComparisonSums {
 public:
  // Runs the first block, because the sums are taken about its mean outputs. For `block_trials` use
  // sum_block_trials().
  ComparisonSums(const Experiment& ours, const Experiment& other, std::uint64_t block_trials);
  void add_block(const Experiment& ours, const Experiment& other, std::uint64_t block);
  void merge(const ComparisonSums& sums);
  // The standard error of a ratio of standard deviations is calculated for paired trials, from the
  // scatter of the blocks.
  std::vector<ComparedOutput> result() const;

 private:
  struct Pair {
    std::string key;
    std::size_t ours, other;  // index in the outputs of each experiment
    double centre_ours = 0, centre_other = 0;
  };
  struct Sums {  // sums for one output in one block, about the centres
    double n = 0, ours = 0, ours2 = 0, other = 0, other2 = 0;
  };
  std::uint64_t block_trials_;
  std::size_t ours_, other_;  // number of outputs of each experiment
  std::vector<Pair> pairs_;
  std::map<std::uint64_t, std::vector<Sums>> blocks_;
};

}  // namespace mdof::algo
