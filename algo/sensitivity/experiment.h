// One trial of a sensitivity study: from its number to its outputs, independent of other trials,
// threads and the time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace mdof::algo {

// Results are also given in bins of this quantity with equal width, usually the travel. Trial i
// draws the quantity from bin i % bins, uniformly within the bin: every bin gets the same number of
// trials, and over all bins the quantity is uniform.
struct BinnedQuantity {
  std::string key;          // "travel_mm"; "" with one bin: results without bins
  double from = 0, to = 0;  // in the unit of the key
  std::size_t bins = 1;
};

class Experiment {
 public:
  virtual ~Experiment() = default;

  // Each name ends in the unit of run(): "EAX_urad", "EYX_um".
  virtual const std::vector<std::string>& outputs() const = 0;
  virtual const BinnedQuantity& binned() const = 0;

  // Runs n trials: first, first + step, ... out[k][j] is output k of trial j; all outputs are NaN
  // if the trial has no solution. The bits depend only on the experiment and the number of the
  // trial. Any thread, several at once.
  virtual void run(std::uint64_t first, std::uint64_t step, std::size_t n,
                   std::span<double* const> out) const = 0;
};

// An experiment that names the causes of its outputs, for variance-based indices.
class CausalExperiment : public Experiment {
 public:
  // The causes are independent of each other; a correlated group is one cause.
  virtual const std::vector<std::string>& causes() const = 0;
  // Like run(), but cause c takes its random numbers from a second, independent stream if second[c]
  // is not 0. If all are 0, the bits are those of run().
  virtual void run_mixed(std::span<const std::uint8_t> second, std::uint64_t first,
                         std::uint64_t step, std::size_t n, std::span<double* const> out) const = 0;
};

}  // namespace mdof::algo
