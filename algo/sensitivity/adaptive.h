// Adaptive Monte Carlo, JCGM 101:2008 §7.9. Blocks of trials are added until the mean, the standard
// uncertainty and both ends of the coverage interval of every output are stable within the
// numerical tolerance. The decision depends only on the figures of the blocks, in the order of the
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

// Figures of one output in one block: JCGM 101 §7.9.4 c-f, in the unit of the output.
struct BlockFigures {
  std::uint64_t n = 0;  // number of solved trials
  double mean = 0, u = 0;
  double low = 0, high = 0;  // probabilistically symmetric coverage interval, §7.7
};

// Number of trials of one block: the smallest multiple of block_trials(experiment) that is at least
// 100 / (1 - coverage) (§7.9.4 b; block_trials(experiment) is at least 10^4). Error: a coverage
// that needs more than 10^7 trials, because the values of a block are stored for sorting.
Result<std::uint64_t> adaptive_block_trials(const Experiment& experiment, double coverage);

// Figures of one block by sorting, one element for each output.
// StudyStatistics::add_block_with_figures() returns the same figures.
std::vector<BlockFigures> block_figures(const Experiment& experiment, std::uint64_t first_trial,
                                        std::uint64_t trials, double coverage);

struct AdaptiveTolerance {
  int digits = 2;  // significant digits of u, from which §7.9.2 calculates the tolerance
  std::map<std::string, double> absolute;  // tolerances that replace the calculated tolerance: key
                                           // of the output, value in its unit
};

class AdaptiveRule {
 public:
  // Errors: digits outside 1 ... 6, a tolerance that is not positive, an unknown output.
  static Result<AdaptiveRule> create(const std::vector<std::string>& outputs,
                                     const AdaptiveTolerance& tolerance);

  // Adds the figures of the next block, one element for each output.
  void add(const std::vector<BlockFigures>& block);
  // True after at least two blocks, if 2 s of all figures are below their tolerances (§7.9.4 j). s
  // is the standard deviation of the mean of a figure over the blocks.
  bool settled() const;
  // The first output that has fewer than two solved trials in a block. Such an output never
  // settles.
  std::optional<std::size_t> unsettled_output() const;
  std::uint64_t blocks() const { return blocks_; }

  struct Progress {
    double worst = 0;       // the largest 2 s of mean, u, low and high
    double tolerance = 0;   // limit δ for `worst` (§7.9.2), from u of all blocks so far
    bool constant = false;  // all trials are equal, so u is 0
    bool settled() const { return constant || worst < tolerance; }
  };
  // One element for each output; `worst` is infinite before the second block.
  std::vector<Progress> progress() const;

 private:
  // Sum and sum of squares over the blocks of a figure minus its value in the first block.
  struct Spread {
    double first = 0, sum = 0, squares = 0;
    void add(double x, bool is_first);
    double twice_s(std::uint64_t blocks) const;
  };
  struct Output {
    double absolute = 0;  // 0: the tolerance is calculated from the digits
    Spread mean, u, low, high;
    double square_sum = 0;       // Σ u²
    bool never_settles = false;  // a block had fewer than two solved trials
  };
  std::vector<Output> outputs_;
  int digits_ = 2;
  std::uint64_t blocks_ = 0;
};

}  // namespace mdof::algo
