#include "algo/sensitivity/plan/draws.h"

#include <algorithm>
#include <cassert>
#include <map>

#include "algo/sensitivity/correlation.h"
#include "algo/sensitivity/random.h"
#include "schema/base/random.h"

namespace mdof::algo {
namespace {

std::uint32_t hash_of(const std::string& name) {
  std::uint32_t hash = 2166136261U;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
  return hash;
}

std::uint32_t wave_hash(const DrawnQuantity& q, std::size_t wave) {
  return hash_of(q.target.name + "#wave" + std::to_string(wave)) ^ q.hash;
}

bool is_noise(Effect effect) {
  return effect == Effect::probe_noise || effect == Effect::encoder_noise;
}

bool has_angle(Effect effect) {
  return effect == Effect::probe_circle || effect == Effect::probe_tilt || effect == Effect::truth;
}

// True: the quantity has different values in different trials. Without a series, the phase of a
// true error has no effect.
bool varies(const DrawnQuantity& q, const Distribution& d, bool series) {
  if (d.kind != Distribution::Kind::constant) return true;
  if (d.centre == 0) return false;
  if (q.target.effect == Effect::truth) return series;
  return q.turned || q.target.effect == Effect::plane_flatness;
}

void add_once(std::string& list, const std::string& name) {
  const bool there = (" + " + list + " + ").find(" + " + name + " + ") != std::string::npos;
  if (!there) list += (list.empty() ? "" : " + ") + name;
}

}  // namespace

Result<PlanDraws> PlanDraws::create(const StudyPlan& plan, const Rig& rig,
                                    const std::string& prefix, std::size_t readings,
                                    std::vector<std::string>& causes) {
  PlanDraws draws;
  draws.seed_ = plan.seed;
  draws.prefix_ = prefix;
  draws.binned_key_ = plan.binned_key;
  draws.bins_ = plan.bins;
  for (std::size_t i = 0; i < plan.quantities.size(); ++i) {
    draws.function_.emplace_back(plan.quantities[i].distribution);
    auto targets = resolve_quantity(plan.quantities[i].name, rig);
    if (!targets) continue;  // the quantity belongs to the other axis
    for (QuantityTarget& target : *targets) {
      DrawnQuantity q;
      q.target = std::move(target);
      q.quantity = i;
      q.hash = hash_of(prefix + q.target.name);
      q.readings = is_noise(q.target.effect) ? readings : 1;
      q.turned = has_angle(q.target.effect);
      q.slot = draws.slots_;
      draws.slots_ += q.readings;
      if (q.target.effect == Effect::plane_flatness) draws.slots_ += kFlatnessWaves;
      if (varies(q, plan.quantities[i].distribution, readings > 1)) q.cause = 0;
      draws.drawn_.push_back(std::move(q));
    }
  }
  for (const auto& group : plan.correlations) MDOF_CHECK(draws.add_group(group));
  draws.name_causes(plan, causes);
  return draws;
}

Status PlanDraws::add_group(const PlannedCorrelation& planned) {
  Group group;
  for (const std::string& name : planned.quantities) {
    const auto found = std::find_if(drawn_.begin(), drawn_.end(),
                                    [&](const DrawnQuantity& q) { return q.target.name == name; });
    if (found == drawn_.end()) continue;  // the quantity belongs to the other axis
    found->group = groups_.size();
    group.members.push_back(static_cast<std::size_t>(found - drawn_.begin()));
  }
  MDOF_TRY(group.factor, cholesky_factor(planned));
  if (group.members.empty()) return {};
  if (group.members.size() != planned.quantities.size())
    return bad_input(planned.where +
                     ": these quantities belong to two rigs; correlate only quantities of one rig");
  for (const std::size_t m : group.members) {
    if (drawn_[m].readings != drawn_[group.members[0]].readings)
      return bad_input(planned.where + ": " + drawn_[m].target.name + " and " +
                       drawn_[group.members[0]].target.name +
                       " cannot be correlated, because one of the two is noise (a new random value "
                       "for each reading); remove one of the two");
  }
  groups_.push_back(std::move(group));
  return {};
}

// Assigns each quantity to a cause. The name of a cause is the name of the quantity in the plan, or
// with each_probe the name for each probe. A group of correlated quantities is one cause.
void PlanDraws::name_causes(const StudyPlan& plan, std::vector<std::string>& causes) {
  const bool each = plan.indices && plan.indices->each_probe;
  const auto name_of = [&](const DrawnQuantity& q) {
    return each ? prefix_ + q.target.name : plan.quantities[q.quantity].name;
  };
  std::vector<std::string> group_name(groups_.size());
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    for (const std::size_t m : groups_[g].members) add_once(group_name[g], name_of(drawn_[m]));
  }
  for (DrawnQuantity& q : drawn_) {
    if (q.cause == kNoCause) continue;
    const std::string name = q.group == kNoCause ? name_of(q) : group_name[q.group];
    const auto found = std::find(causes.begin(), causes.end(), name);
    q.cause = static_cast<std::size_t>(found - causes.begin());
    if (found == causes.end()) causes.push_back(name);
  }
}

std::uint32_t PlanDraws::stream(const DrawnQuantity& q, const DrawRequest& request,
                                std::uint32_t reading) const {
  const bool second =
      q.cause != kNoCause && !request.second.empty() && request.second[q.cause] != 0;
  return 2 * reading + (second ? 1 : 0);
}

// Limits the uniform numbers to the bin of the trial. In the first stream, trial i is in bin i %
// bins. The second stream has another order of the bins, so that each pair of bins occurs once in
// bins² trials.
void PlanDraws::stratify(const DrawnQuantity& q, const DrawRequest& request,
                         std::span<double> u) const {
  const bool second = stream(q, request, 0) != 0;
  for (std::size_t j = 0; j < u.size(); ++j) {
    const std::uint64_t trial = request.first + request.step * j;
    const std::uint64_t bin = (second ? trial + trial / bins_ : trial) % bins_;
    u[j] = (static_cast<double>(bin) + u[j]) / static_cast<double>(bins_);
  }
}

void PlanDraws::draw_one(const DrawnQuantity& q, const DrawRequest& request,
                         DrawnNumbers& numbers) const {
  const QuantileFunction& function = function_[q.quantity];
  const double scale = request.scale.empty() ? 1.0 : request.scale[q.quantity];
  for (std::uint32_t r = 0; r < q.readings; ++r) {
    double* value = &numbers.value_[(q.slot + r) * numbers.stride_];
    double* turns = &numbers.turns_[(q.slot + r) * numbers.stride_];
    draw_pairs({seed_, stream(q, request, r)}, q.hash, request.first, request.step,
               {value, request.n}, {turns, request.n});
    if (!binned_key_.empty() && q.target.name == binned_key_)
      stratify(q, request, {value, request.n});
    for (std::size_t j = 0; j < request.n; ++j)
      value[j] = function.at(value[j]) * scale * q.target.to_si;
  }
}

// Draws direction and phase of each wave, both in turns.
void PlanDraws::draw_waves(const DrawnQuantity& q, const DrawRequest& request,
                           DrawnNumbers& numbers) const {
  for (std::size_t w = 0; w < kFlatnessWaves; ++w) {
    const std::size_t at = (q.slot + 1 + w) * numbers.stride_;
    draw_pairs({seed_, stream(q, request, 0)}, wave_hash(q, w), request.first, request.step,
               {&numbers.value_[at], request.n}, {&numbers.turns_[at], request.n});
  }
}

void PlanDraws::draw_group(const Group& group, const DrawRequest& request,
                           DrawnNumbers& numbers) const {
  const std::size_t m = group.members.size();
  const std::size_t readings = drawn_[group.members[0]].readings;
  std::vector<double> score(m * request.n);
  for (std::uint32_t r = 0; r < readings; ++r) {
    for (std::size_t k = 0; k < m; ++k) {
      const DrawnQuantity& q = drawn_[group.members[k]];
      double* u = &score[k * request.n];
      draw_pairs({seed_, stream(q, request, r)}, q.hash, request.first, request.step,
                 {u, request.n}, {&numbers.turns_[(q.slot + r) * numbers.stride_], request.n});
      for (std::size_t j = 0; j < request.n; ++j) u[j] = gaussian(u[j]);
    }
    for (std::size_t k = 0; k < m; ++k) {
      const DrawnQuantity& q = drawn_[group.members[k]];
      const double scale = request.scale.empty() ? 1.0 : request.scale[q.quantity];
      for (std::size_t j = 0; j < request.n; ++j) {
        double mixed = 0;
        for (std::size_t i = 0; i <= k; ++i)
          mixed += group.factor[k * m + i] * score[i * request.n + j];
        numbers.value_[(q.slot + r) * numbers.stride_ + j] =
            function_[q.quantity].at_score(mixed) * scale * q.target.to_si;
      }
    }
  }
}

void PlanDraws::fill(const DrawRequest& request, DrawnNumbers& numbers) const {
  numbers.stride_ = request.n;
  numbers.value_.resize(slots_ * request.n);
  numbers.turns_.resize(slots_ * request.n);
  for (const DrawnQuantity& q : drawn_) {
    if (q.group == kNoCause) draw_one(q, request, numbers);
    if (q.target.effect == Effect::plane_flatness) draw_waves(q, request, numbers);
  }
  for (const Group& group : groups_) draw_group(group, request, numbers);
}

double PlanDraws::reading(const DrawnQuantity& q, const DrawRequest& request,
                          std::uint32_t reading) const {
  assert(q.group == kNoCause && is_noise(q.target.effect));
  const double scale = request.scale.empty() ? 1.0 : request.scale[q.quantity];
  const double p =
      draw({seed_, stream(q, request, reading)}, request.first, std::uint64_t{q.hash} * 2);
  return function_[q.quantity].at(p) * scale * q.target.to_si;
}

std::vector<std::pair<std::string, double>> drawn_inputs(const PlanDraws& draws,
                                                         std::uint64_t trial,
                                                         const std::string& prefix) {
  std::vector<std::pair<std::string, double>> inputs;
  DrawnNumbers numbers;
  draws.fill({trial, 1, 1, {}, {}}, numbers);
  for (const DrawnQuantity& q : draws.drawn()) {
    inputs.emplace_back(prefix + q.target.name, numbers.value(q.slot, 0) / q.target.to_si);
    if (q.turned && q.target.effect != Effect::truth)
      inputs.emplace_back(prefix + q.target.name + " direction/turns", numbers.turns(q.slot, 0));
  }
  return inputs;
}

Status check_hashes(const std::vector<const PlanDraws*>& all) {
  std::map<std::uint32_t, std::string> seen;
  for (const PlanDraws* draws : all) {
    for (const DrawnQuantity& q : draws->drawn()) {
      std::vector<std::uint32_t> hashes = {q.hash};
      if (q.target.effect == Effect::plane_flatness)
        for (std::size_t w = 0; w < kFlatnessWaves; ++w) hashes.push_back(wave_hash(q, w));
      for (const std::uint32_t hash : hashes) {
        const auto [at, fresh] = seen.emplace(hash, q.target.name);
        if (!fresh)
          return bad_input("quantities " + at->second + " and " + q.target.name +
                           " would get the same random numbers; change the id of one probe");
      }
    }
  }
  return {};
}

}  // namespace mdof::algo
