// The random numbers of a plan for one rig, in SI units.
//
// The numbers of a quantity are selected by its name: word 2 of the random counter is the FNV-1a
// hash of the name, word 3 is 2 * reading + stream. Therefore the numbers depend only on seed,
// trial, name, reading and stream. They do not change if other quantities are added or reordered.
// Quantities with the same name have the same numbers in two rigs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "algo/sensitivity/distribution.h"
#include "schema/base/result.h"
#include "schema/study/plan.h"

namespace mdof::algo {

inline constexpr std::size_t kFlatnessWaves = 4;
inline constexpr std::size_t kNoCause = static_cast<std::size_t>(-1);

// The requested trials, and optional changes of their numbers. Empty spans: no change.
struct DrawRequest {
  std::uint64_t first = 0, step = 1;
  std::size_t n = 0;
  std::span<const std::uint8_t> second;  // for each cause: not 0 to use the second stream
  std::span<const double> scale;         // for each quantity of the plan: factor for the value
};

// One random quantity of the rig, and the columns of its numbers.
struct DrawnQuantity {
  QuantityTarget target;
  std::size_t quantity = 0;      // index of the quantity in the plan
  std::size_t cause = kNoCause;  // kNoCause: constant
  std::size_t group = kNoCause;  // group of correlated quantities
  std::uint32_t hash = 0;
  std::size_t readings = 1;  // number of values in each trial; reading 0 is the point, readings 1
                             // ... are the series
  bool turned = false;       // the quantity has a value and also an angle or phase, in turns
  std::size_t slot = 0;      // first column; for a flatness, the columns of the waves follow
};

// Numbers of n trials in columns.
class DrawnNumbers {
 public:
  double value(std::size_t slot, std::size_t j) const { return value_[slot * stride_ + j]; }
  double turns(std::size_t slot, std::size_t j) const { return turns_[slot * stride_ + j]; }

 private:
  friend class PlanDraws;
  std::size_t stride_ = 0;
  std::vector<double> value_, turns_;
};

class PlanDraws {
 public:
  // `prefix`: added before the names when hashes are calculated. Appends new causes to `causes`.
  // Errors: a correlation matrix that is not positive definite; a correlation between noise and a
  // quantity that has only one number in each trial.
  static Result<PlanDraws> create(const StudyPlan& plan, const Rig& rig, const std::string& prefix,
                                  std::size_t readings, std::vector<std::string>& causes);

  const std::vector<DrawnQuantity>& drawn() const { return drawn_; }
  void fill(const DrawRequest& request, DrawnNumbers& numbers) const;
  // The number for a reading of a noise quantity. The quantity must not be correlated.
  double reading(const DrawnQuantity& quantity, const DrawRequest& request,
                 std::uint32_t reading) const;

 private:
  struct Group {
    std::vector<std::size_t> members;  // indices in drawn_
    std::vector<double> factor;        // Cholesky factor, row-major
  };
  std::uint32_t stream(const DrawnQuantity& q, const DrawRequest& request,
                       std::uint32_t reading) const;
  void draw_one(const DrawnQuantity& q, const DrawRequest& request, DrawnNumbers& numbers) const;
  void draw_waves(const DrawnQuantity& q, const DrawRequest& request, DrawnNumbers& numbers) const;
  void draw_group(const Group& group, const DrawRequest& request, DrawnNumbers& numbers) const;
  void stratify(const DrawnQuantity& q, const DrawRequest& request, std::span<double> u) const;
  Status add_group(const PlannedCorrelation& planned);
  void name_causes(const StudyPlan& plan, std::vector<std::string>& causes);

  std::uint64_t seed_ = 0;
  std::string prefix_;
  std::string binned_key_;
  std::size_t bins_ = 1, slots_ = 0;
  std::vector<QuantileFunction> function_;  // one for each quantity of the plan
  std::vector<DrawnQuantity> drawn_;
  std::vector<Group> groups_;
};

// Names and numbers of one trial. `prefix` is added before the names. Values are in the unit of the
// name, directions in turns.
std::vector<std::pair<std::string, double>> drawn_inputs(const PlanDraws& draws,
                                                         std::uint64_t trial,
                                                         const std::string& prefix);

// Error: two names have the same hash.
Status check_hashes(const std::vector<const PlanDraws*>& all);

}  // namespace mdof::algo
