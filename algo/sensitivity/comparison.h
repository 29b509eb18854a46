// Compares two fixtures with the same random numbers, so that only the fixtures differ.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "algo/sensitivity/experiment.h"
#include "algo/sensitivity/plan/columns.h"
#include "schema/study/study.h"

namespace mdof::algo {

// Blocks may be added in any order from any thread and give the same bits, as in SobolSums.
// Compares the outputs that both experiments have.
class ComparisonSums {
 public:
  // Runs the first block to find the centres; sum_block_trials() gives a good block length.
  ComparisonSums(const Experiment& ours, const Experiment& other, std::uint64_t block_trials);
  void add_block(const Experiment& ours, const Experiment& other, std::uint64_t block);
  void merge(const ComparisonSums& sums);
  // The standard error of the ratio is that of paired trials, from the scatter of the blocks.
  std::vector<ComparedOutput> result() const;

 private:
  struct Pair {
    std::string key;
    std::size_t ours, other;  // index among the outputs of each
    double centre_ours = 0, centre_other = 0;
  };
  struct Sums {  // sums for one output in one block, about the centres
    double n = 0, ours = 0, ours2 = 0, other = 0, other2 = 0;
  };
  std::uint64_t block_trials_;
  std::size_t ours_, other_;  // number of outputs of each
  std::vector<Pair> pairs_;
  std::map<std::uint64_t, std::vector<Sums>> blocks_;
};

}  // namespace mdof::algo
