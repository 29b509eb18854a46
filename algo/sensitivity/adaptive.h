// Adaptive Monte Carlo, JCGM 101:2008 §7.9. Blocks of trials are added until the mean, the standard
// uncertainty and both ends of the coverage interval of every output are stable within the
// numerical tolerance. The rule depends only on the figures of the blocks, in the order of the
// blocks.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "algo/sensitivity/experiment.h"
#include "schema/base/result.h"

namespace mdof::algo {

// One output over the trials of one block: JCGM 101 §7.9.4 c-f, in the output's unit.
struct BlockFigures {
  std::uint64_t n = 0;  // solved trials
  double mean = 0, u = 0;
  double low = 0, high = 0;  // probabilistically symmetric coverage interval, §7.7
};

// Number of trials of a block of the rule: the least multiple of block_trials() that is at least
// max(100 / (1 - coverage), 10^4), §7.9.4 b. Error: a coverage that needs more than 10^7, because
// the values of a block are kept for sorting.
Result<std::uint64_t> adaptive_block_trials(const Experiment& experiment, double coverage);

// One element for each output, by sorting. StudyStatistics::add_block_with_figures() gives the same
// figures.
std::vector<BlockFigures> block_figures(const Experiment& experiment, std::uint64_t first_trial,
                                        std::uint64_t trials, double coverage);

struct AdaptiveTolerance {
  int digits = 2;                          // significant digits of u; §7.9.2 gives the tolerance
  std::map<std::string, double> absolute;  // replaces it for an output, by key, in its unit
};

class AdaptiveRule {
 public:
  // Errors: digits outside 1 ... 6, a tolerance that is not positive, an unknown output.
  static Result<AdaptiveRule> create(const std::vector<std::string>& outputs,
                                     const AdaptiveTolerance& tolerance);

  // Adds the next block, one element for each output.
  void add(const std::vector<BlockFigures>& block);
  // True after at least two blocks, if every 2 s (§7.9.4 j) is below its tolerance.
  bool settled() const;
  // The first output that has fewer than two values in a block: it never settles.
  std::optional<std::size_t> unsettled_output() const;
  std::uint64_t blocks() const { return blocks_; }

  struct Progress {
    double worst = 0;       // the largest 2 s
    double tolerance = 0;   // δ, the limit of worst, §7.9.2, from u so far
    bool constant = false;  // all trials are equal: no digits to settle
    bool settled() const { return constant || worst < tolerance; }
  };
  // One element for each output; `worst` is infinite before the second block.
  std::vector<Progress> progress() const;

 private:
  // Σ and Σ² of a figure relative to its first value.
  struct Spread {
    double first = 0, sum = 0, squares = 0;
    void add(double x, bool is_first);
    double twice_s(std::uint64_t blocks) const;
  };
  struct Output {
    double absolute = 0;  // 0: the tolerance follows from the digits
    Spread mean, u, low, high;
    double square_sum = 0;       // Σ u²
    bool never_settles = false;  // a block had fewer than two solved trials
  };
  std::vector<Output> outputs_;
  int digits_ = 2;
  std::uint64_t blocks_ = 0;
};

}  // namespace mdof::algo
