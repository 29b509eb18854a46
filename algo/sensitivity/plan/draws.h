// The random numbers of a plan on one rig, in SI units.
//
// A quantity's numbers are addressed by its name: counter word 2 is the FNV-1a hash of the name,
// word 3 twice the reading plus the stream. So they depend on seed, trial, name, reading and stream
// only; another quantity more or less, or another order, changes none of them, and two rigs share
// those of the names they share.
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

// Which trials, and what of them is other than usual. Empty spans: nothing.
struct DrawRequest {
  std::uint64_t first = 0, step = 1;
  std::size_t n = 0;
  std::span<const std::uint8_t> second;  // by cause: take the second stream
  std::span<const double> scale;         // by quantity of the plan: value times this
};

// One random quantity of the rig and where its numbers are.
struct DrawnQuantity {
  QuantityTarget target;
  std::size_t quantity = 0;      // place in the plan
  std::size_t cause = kNoCause;  // kNoCause: does not vary
  std::size_t group = kNoCause;  // of correlated ones
  std::uint32_t hash = 0;
  std::size_t readings = 1;  // numbers a trial; reading 0 is the point, 1 ... a series
  bool turned = false;       // has an angle (or phase), in turns, beside its value
  std::size_t slot = 0;      // first of its columns; a height's waves follow its value
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
  // `prefix` goes before the names in their hashes; new causes are appended to `causes`. Refuses a
  // correlation matrix that is none, or that ties noise to what is drawn once a trial.
  static Result<PlanDraws> create(const StudyPlan& plan, const Rig& rig, const std::string& prefix,
                                  std::size_t readings, std::vector<std::string>& causes);

  const std::vector<DrawnQuantity>& drawn() const { return drawn_; }
  void fill(const DrawRequest& request, DrawnNumbers& numbers) const;
  // One more reading of an uncorrelated quantity that has a number each reading.
  double reading(const DrawnQuantity& quantity, const DrawRequest& request,
                 std::uint32_t reading) const;

 private:
  struct Group {
    std::vector<std::size_t> members;  // in drawn_
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

// What one trial drew: names after `prefix`, values in the unit of the name, directions in turns.
std::vector<std::pair<std::string, double>> drawn_inputs(const PlanDraws& draws,
                                                         std::uint64_t trial,
                                                         const std::string& prefix);

// Whether any two names have one hash; the message has the remedy.
Status check_hashes(const std::vector<const PlanDraws*>& all);

}  // namespace mdof::algo
