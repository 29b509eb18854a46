// Adaptive Monte Carlo, JCGM 101:2008 §7.9: as many blocks of trials as it takes until the mean,
// the standard uncertainty and both ends of the coverage interval of every output have settled to
// the numerical tolerance. A pure rule over the figures of blocks, fed in the order of the blocks.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "algo/sensitivity/experiment.h"
#include "schema/base/result.h"

namespace mdof::algo {

// One output over the trials of one block: JCGM 101 §7.9.4 c-f. In the output's unit.
struct BlockFigures {
  std::uint64_t n = 0;  // solved
  double mean = 0, u = 0;
  double low = 0, high = 0;  // probabilistically symmetric coverage interval, §7.7
};

// Trials of a block of the rule: the least multiple of block_trials() that is not below
// max(100 / (1 - coverage), 10^4), §7.9.4 b. Error: a coverage that asks for more than 10^7, as
// the values of a block are kept to be sorted.
Result<std::uint64_t> adaptive_block_trials(const Experiment& experiment, double coverage);

// One for each output, by sorting. StudyStatistics::add_block_with_figures gives them too.
std::vector<BlockFigures> block_figures(const Experiment& experiment, std::uint64_t first_trial,
                                        std::uint64_t trials, double coverage);

struct AdaptiveTolerance {
  int digits = 2;                          // significant digits of u; §7.9.2 gives the tolerance
  std::map<std::string, double> absolute;  // for an output by key, in its unit: instead
};

class AdaptiveRule {
 public:
  // Errors: digits out of 1 ... 6, a tolerance that is not positive, an unknown output.
  static Result<AdaptiveRule> create(const std::vector<std::string>& outputs,
                                     const AdaptiveTolerance& tolerance);

  // The next block, one entry an output.
  void add(const std::vector<BlockFigures>& block);
  // At least two blocks, and every 2 s (§7.9.4 j) below its tolerance.
  bool settled() const;
  // The first output that a block gave fewer than two values of: it never settles.
  std::optional<std::size_t> output_that_never_settles() const;
  std::uint64_t blocks() const { return blocks_; }

  struct Progress {
    double worst = 0;       // the largest 2 s
    double tolerance = 0;   // δ it has to get below, §7.9.2 from u so far
    bool constant = false;  // all trials alike: no digits to settle
    bool settled() const { return constant || worst < tolerance; }
  };
  // One for each output; before the second block the worst is infinite.
  std::vector<Progress> progress() const;

 private:
  // Σ and Σ² of a figure about its first value.
  struct Spread {
    double first = 0, sum = 0, squares = 0;
    void add(double x, bool is_first);
    double twice_s(std::uint64_t blocks) const;
  };
  struct Output {
    double absolute = 0;  // 0: by digits
    Spread mean, u, low, high;
    double square_sum = 0;       // Σ u²
    bool never_settles = false;  // a block without two solved trials
  };
  std::vector<Output> outputs_;
  int digits_ = 2;
  std::uint64_t blocks_ = 0;
};

}  // namespace mdof::algo
