// Variance-based sensitivity (Sobol): which cause makes how much of an output's variance.
//
// With f_A, f_B two independent evaluations and f_ABi that of A with cause i from B, c a centre:
//   first order  S_i = mean((f_B - c)(f_ABi - f_A)) / V      (Saltelli et al., Comput. Phys.
//                                                             Commun. 181 (2010), table 2 (b))
//   total        T_i = mean((f_A - f_ABi)²) / 2V             (Jansen 1999, ibid. (f))
//   V the variance of f_A and f_B together.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "algo/sensitivity/experiment.h"
#include "algo/sensitivity/plan/columns.h"
#include "schema/study/study.h"

namespace mdof::algo {

// Sums of blocks of trials, kept apart so that the result is taken in the order of the blocks
// whoever computed them: the same bits for any number of threads. Block b has the trials
// b * block_trials ...; it costs 2 + causes evaluations a trial. sum_block_trials() says how long
// a block had best be.
class SobolSums {
 public:
  // Runs the first block, 16 trials at least, for the centres.
  SobolSums(const CausalExperiment& experiment, std::uint64_t block_trials);
  void add_block(const CausalExperiment& experiment, std::uint64_t block);
  void merge(const SobolSums& other);  // of the same experiment
  std::uint64_t blocks() const { return blocks_.size(); }
  // Standard errors from the scatter of the blocks, NaN below two. An output that does not vary
  // has indices of 0. Trials that could not be solved are left out of their output.
  std::vector<OutputIndices> result() const;

 private:
  struct Cause {
    double first = 0, total = 0;
  };
  struct Sums {  // of one output in one block
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
