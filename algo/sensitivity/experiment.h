// The trials of a sensitivity study. The outputs of a trial depend only on its number, and not on
// other trials, threads or the time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace mdof::algo {

// A quantity whose range is divided into bins of equal width, usually the travel. Results are also
// calculated for each bin. Trial i draws the quantity from a uniform distribution in bin i % bins.
// Therefore every bin has the same number of trials, and the quantity is uniform over its range.
struct BinnedQuantity {
  std::string key;          // "travel_mm"; empty, with one bin, if results have no bins
  double from = 0, to = 0;  // in the unit of the key
  std::size_t bins = 1;
};

class Experiment {
 public:
  virtual ~Experiment() = default;

  // Each name ends in the unit of run(): "EAX_urad", "EYX_um".
  const std::vector<std::string>& outputs() const { return outputs_; }
  const BinnedQuantity& binned() const { return binned_; }

  // Runs n trials: first, first + step, ... out[k][j] is output k of trial j; all outputs are NaN
  // if the trial has no solution. The bits of a trial depend only on the experiment and the number
  // of the trial. Thread-safe.
  virtual void run(std::uint64_t first, std::uint64_t step, std::size_t n,
                   std::span<double* const> out) const = 0;

 protected:
  std::vector<std::string> outputs_;
  BinnedQuantity binned_;
};

// An experiment with a list of the causes of its outputs, for variance-based indices.
class CausalExperiment : public Experiment {
 public:
  // Names of the causes. The causes are independent of each other; a group of correlated quantities
  // is one cause.
  const std::vector<std::string>& causes() const { return causes_; }
  // As run(), but cause c uses random numbers of a second, independent stream if second[c] is not
  // 0. If all second[c] are 0, the results have the bits of run().
  virtual void run_mixed(std::span<const std::uint8_t> second, std::uint64_t first,
                         std::uint64_t step, std::size_t n, std::span<double* const> out) const = 0;

 protected:
  std::vector<std::string> causes_;
};

}  // namespace mdof::algo
