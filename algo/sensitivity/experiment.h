// What one trial of a sensitivity study is: from its number to its outputs, and nothing in between
// that depends on another trial, a thread or the time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace mdof::algo {

// The quantity against which results are also given in bins of equal width, usually the travel.
// Trial i draws it from bin i % bins, uniformly within the bin: every bin gets the same number of
// trials, and over all bins the quantity is uniform.
struct BinnedQuantity {
  std::string key;          // "travel_mm"; "" with one bin: results are not binned
  double from = 0, to = 0;  // in the unit of the key
  std::size_t bins = 1;
};

class Experiment {
 public:
  virtual ~Experiment() = default;

  // Each ends in the unit in which run() gives it: "EAX_urad", "EYX_um".
  virtual const std::vector<std::string>& outputs() const = 0;
  virtual const BinnedQuantity& binned() const = 0;

  // Trials first, first + step, ... (n of them): out[k][j] is output k of the j-th; NaN in all
  // outputs where the trial could not be solved. The bits depend on nothing but the experiment and
  // the trial's number. Any thread, several at once.
  virtual void run(std::uint64_t first, std::uint64_t step, std::size_t n,
                   std::span<double* const> out) const = 0;
};

// One that says what its outputs depend on, for variance-based indices.
class CausalExperiment : public Experiment {
 public:
  // Independent of each other; a correlated group is one cause.
  virtual const std::vector<std::string>& causes() const = 0;
  // As run(), but cause c takes its random numbers from a second, independent stream where
  // second[c] is not 0. All 0: the same bits as run().
  virtual void run_mixed(std::span<const std::uint8_t> second, std::uint64_t first,
                         std::uint64_t step, std::size_t n, std::span<double* const> out) const = 0;
};

}  // namespace mdof::algo
