// Variance-based sensitivity (Sobol): the share of each cause in the variance of an output.
//
// f_A and f_B are two independent evaluations, f_ABi is f_A with the numbers of cause i from B, c
// is a constant near the mean:
//   first order  S_i = mean((f_B - c)(f_ABi - f_A)) / V      (Saltelli et al., Comput. Phys.
//                                                             Commun. 181 (2010), table 2 (b))
//   total        T_i = mean((f_A - f_ABi)²) / 2V             (Jansen 1999, ibid. (f))
//   V is the variance of f_A and f_B together.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "algo/sensitivity/experiment.h"
#include "algo/sensitivity/plan/columns.h"
#include "schema/study/study.h"

namespace mdof::algo {

// Sums over blocks of trials. The sums of each block are stored separately and are added in the
// order of the blocks. Therefore the results have the same bits for any number of threads. Block b
// begins with trial b * block_trials. Each trial needs 2 + number of causes evaluations. For
// `block_trials` use sum_block_trials().
class SobolSums {
 public:
  // Runs the first block, or 16 trials if this is more, to calculate the centres c.
  SobolSums(const CausalExperiment& experiment, std::uint64_t block_trials);
  void add_block(const CausalExperiment& experiment, std::uint64_t block);
  void merge(const SobolSums& other);  // `other` must have the same experiment
  std::uint64_t blocks() const { return blocks_.size(); }
  // Standard errors are calculated from the scatter of the blocks; they are NaN for fewer than two
  // blocks. If an output does not vary, its indices are 0. Trials without a solution of an output
  // are ignored for this output.
  std::vector<OutputIndices> result() const;

 private:
  struct Cause {
    double first = 0, total = 0;
  };
  struct Sums {  // sums for one output in one block
    double n = 0, s1 = 0, s2 = 0;
    std::vector<Cause> causes;
  };
  void add_trial(const Columns& a, const Columns& b, const std::vector<Columns>& mixed,
                 std::size_t output, std::size_t j, Sums& sums) const;
  OutputIndices result_of(std::size_t output) const;

  std::uint64_t block_trials_;
  std::vector<std::string> outputs_, causes_;
  std::vector<double> centre_;
  std::map<std::uint64_t, std::vector<Sums>> blocks_;
};

}  // namespace mdof::algo
