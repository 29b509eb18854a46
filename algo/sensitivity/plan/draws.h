// The random numbers of a plan on one rig, in SI units.
//
// The name of a quantity addresses its numbers: counter word 2 is the FNV-1a hash of the name, word
// 3 is twice the reading plus the stream. So the numbers depend only on seed, trial, name, reading
// and stream. Another quantity or another order changes no other number, and two rigs share the
// numbers of quantities with the same name.
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

// Selects trials, and changes their numbers. Empty spans: no change.
struct DrawRequest {
  std::uint64_t first = 0, step = 1;
  std::size_t n = 0;
  std::span<const std::uint8_t> second;  // by cause: use the second stream
  std::span<const double> scale;         // by quantity of the plan: factor of the value
};

// One random quantity of the rig and the place of its numbers.
struct DrawnQuantity {
  QuantityTarget target;
  std::size_t quantity = 0;      // index in the plan
  std::size_t cause = kNoCause;  // kNoCause: constant
  std::size_t group = kNoCause;  // group of correlated quantities
  std::uint32_t hash = 0;
  std::size_t readings = 1;  // numbers in each trial; reading 0 is the point, 1 ... a series
  bool turned = false;       // has an angle or phase, in turns, besides its value
  std::size_t slot = 0;      // its first column; the waves of a height follow its value
};

// Columns of n numbers.
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
  // `prefix`: placed before the names in their hashes. Appends new causes to `causes`. Errors: a
  // correlation matrix that is not positive definite; a correlation of noise with a quantity that
  // has one number in each trial.
  static Result<PlanDraws> create(const StudyPlan& plan, const Rig& rig, const std::string& prefix,
                                  std::size_t readings, std::vector<std::string>& causes);

  const std::vector<DrawnQuantity>& drawn() const { return drawn_; }
  void fill(const DrawRequest& request, DrawnNumbers& numbers) const;
  // One more reading of an uncorrelated quantity that has a number for each reading.
  double reading(const DrawnQuantity& quantity, const DrawRequest& request,
                 std::uint32_t reading) const;

 private:
  struct Group {
    std::vector<std::size_t> members;  // indices in drawn_
    std::vector<double> factor;        // Cholesky, row-major
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
  std::vector<QuantileFunction> function_;  // by quantity of the plan
  std::vector<DrawnQuantity> drawn_;
  std::vector<Group> groups_;
};

// Numbers of one trial: names after `prefix`, values in the unit of the name, directions in turns.
std::vector<std::pair<std::string, double>> drawn_inputs(const PlanDraws& draws,
                                                         std::uint64_t trial,
                                                         const std::string& prefix);

// Error if two names have the same hash; the message has the remedy.
Status check_hashes(const std::vector<const PlanDraws*>& all);

}  // namespace mdof::algo
