// Reads the quantities of a plan, including the true errors, and the dependence of the quantities.
#include <algorithm>
#include <cmath>

#include "schema/axis.h"
#include "schema/study/distribution.h"
#include "schema/study/plan_parts.h"

namespace mdof::plan_parts {

bool has_quantity(const StudyPlan& plan, const std::string& name) {
  return std::any_of(plan.quantities.begin(), plan.quantities.end(),
                     [&](const PlannedQuantity& q) { return q.name == name; });
}

namespace {

using Kind = Distribution::Kind;
using Path = std::filesystem::path;

// Default values from the simulations in the paper, for a plan without [truth].
constexpr double kTruth_um = 50, kTruth_urad = 1000, kTravel_mm = 60;

// Returns the targets of a name on the rigs of the plan. If no rig has the name, returns the error
// for the first rig.
Result<std::vector<QuantityTarget>> resolve_on_rigs(const StudyPlan& plan,
                                                    const std::string& name) {
  auto targets = resolve_quantity(name, plan.rig);
  if (!targets && plan.rig_y) {
    if (auto second = resolve_quantity(name, *plan.rig_y)) return second;
  }
  return targets;
}

void add_range(TomlTable& truth, StudyPlan& plan, const std::string& key, const std::string& name) {
  const auto range = truth.numbers(key, std::vector<double>{});
  if (!truth.has(key)) return;
  PlannedQuantity quantity{name, {}, truth.where(key)};
  if (range.size() == 1) {
    quantity.distribution.centre = range[0];
  } else if (range.size() == 2 && range[0] < range[1]) {
    quantity.distribution.kind = Kind::rectangular;
    quantity.distribution.low = range[0];
    quantity.distribution.high = range[1];
  } else {
    truth.reject(key, "must be [value] for a fixed value, or [low, high] with low less than high");
  }
  plan.quantities.push_back(std::move(quantity));
}

void add_usual_range(StudyPlan& plan, const std::string& name, double low, double high) {
  Distribution d;
  d.kind = Kind::rectangular;
  d.low = low;
  d.high = high;
  plan.quantities.push_back({name, d, plan.source + ": " + name + " (by default)"});
}

// Reads [truth]: the ranges of the five errors and of the travel. If there are two rigs, the ranges
// of the errors apply to both axes.
void read_truth(TomlTable& table, StudyPlan& plan) {
  auto truth = table.table("truth");
  if (!truth) return;
  add_range(*truth, plan, "travel_mm", "travel_mm");
  std::vector<Axis> axes = {plan.rig.axis};
  if (plan.rig_y && plan.rig_y->axis != plan.rig.axis) axes.push_back(plan.rig_y->axis);
  for (const Axis axis : axes) {
    for (const ErrorName& error : error_names(axis)) {
      const std::string key = error.key;
      add_range(*truth, plan, key, "truth." + key);
    }
  }
}

// Sets the values of the truth that are missing to the values in the paper.
void set_default_truth(StudyPlan& plan, bool said) {
  if (!has_quantity(plan, "travel_mm")) add_usual_range(plan, "travel_mm", 0, kTravel_mm);
  const bool any = std::any_of(plan.quantities.begin(), plan.quantities.end(),
                               [](const auto& q) { return q.name.starts_with("truth."); });
  if (said || any) return;
  for (const Rig* rig : {&plan.rig, plan.rig_y ? &*plan.rig_y : nullptr}) {
    if (!rig) continue;
    for (const ErrorName& error : error_names(rig->axis)) {
      const double most = error.angle ? kTruth_urad : kTruth_um;
      add_usual_range(plan, std::string("truth.") + error.key, -most, most);
    }
  }
}

// A radius, or an angle from an axis, has no sign. A negative value would only mean the opposite
// side.
bool may_be_negative(Effect effect) {
  return effect != Effect::probe_circle && effect != Effect::probe_tilt;
}

const char* key_of_low(const Distribution& d) {
  switch (d.kind) {
    case Kind::constant:
      return d.centre < 0 ? "value" : nullptr;
    case Kind::empirical:
      return !d.sample.empty() && d.sample.front() < 0 ? "file" : nullptr;
    case Kind::normal:
    case Kind::t:
      return nullptr;
    default:
      return d.low < 0 ? "low" : nullptr;
  }
}

Status read_quantity(TomlTable& table, const Path& folder, StudyPlan& plan) {
  PlannedQuantity quantity;
  quantity.name = table.string("name");
  quantity.where = table.where("name");
  MDOF_TRY(quantity.distribution, read_distribution(table, folder));
  const auto targets = resolve_on_rigs(plan, quantity.name);
  if (!targets) {
    table.reject("name", targets.error().message);
    return {};
  }
  const char* low = key_of_low(quantity.distribution);
  if (low && !may_be_negative(targets->front().effect))
    table.reject(low, "must not be negative, because " + quantity.name + " is a " +
                          (targets->front().effect == Effect::probe_circle ? "radius" : "tilt") +
                          " without a direction");
  plan.quantities.push_back(std::move(quantity));
  return {};
}

// The same random number must not be given twice, for example by its own name and by a name with a
// star.
void reject_doubles(TomlTable& table, const StudyPlan& plan) {
  std::set<std::string> seen;
  for (const auto& quantity : plan.quantities) {
    const auto targets = resolve_on_rigs(plan, quantity.name);
    for (const auto& target : targets ? *targets : std::vector<QuantityTarget>{}) {
      if (!seen.insert(target.name).second)
        table.reject("quantity", target.name + " is given twice, the second time by \"" +
                                     quantity.name + "\"; give this quantity only once");
    }
  }
}

const PlannedQuantity* quantity_with(const StudyPlan& plan, const std::string& target) {
  for (const auto& quantity : plan.quantities) {
    const auto targets = resolve_on_rigs(plan, quantity.name);
    if (!targets) continue;
    for (const auto& t : *targets)
      if (t.name == target) return &quantity;
  }
  return nullptr;
}

// Reads one coefficient for all pairs, or a matrix row by row.
void read_matrix(TomlTable& table, PlannedCorrelation& group) {
  const std::size_t n = group.quantities.size();
  if (table.has("coefficient")) {
    if (table.has("matrix"))
      table.reject("matrix", "contradicts \"coefficient\"; give only one of the two keys");
    const double r = table.number("coefficient");
    if (!(std::abs(r) < 1)) table.reject("coefficient", "must lie between -1 and 1");
    group.matrix.assign(n * n, r);
    for (std::size_t i = 0; i < n; ++i) group.matrix[i * n + i] = 1;
    return;
  }
  if (!table.has("matrix"))
    return table.reject("matrix", "is missing; add \"matrix\" or \"coefficient\"");
  const auto rows = table.matrix("matrix");
  bool square = rows.size() == n;
  for (const auto& row : rows) {
    square = square && row.size() == n;
    group.matrix.insert(group.matrix.end(), row.begin(), row.end());
  }
  if (!square) {
    table.reject("matrix", "must have a row and a column for each of the " + std::to_string(n) +
                               " quantities (a name with * counts once for each probe)");
    group.matrix.assign(n * n, 0);
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      const double r = group.matrix[i * n + j];
      if (r != group.matrix[j * n + i] || (i == j ? r != 1 : !(std::abs(r) < 1)))
        return table.reject("matrix",
                            "must be symmetric with ones on the diagonal and coefficients "
                            "between -1 and 1");
    }
  }
}

PlannedCorrelation read_correlation(TomlTable& table, StudyPlan& plan,
                                    std::set<std::string>& grouped) {
  PlannedCorrelation group;
  group.where = table.where("quantities");
  for (const std::string& name : table.strings("quantities")) {
    const auto targets = resolve_on_rigs(plan, name);
    if (!targets) {
      table.reject("quantities", targets.error().message);
      return group;
    }
    for (const auto& target : *targets) {
      const PlannedQuantity* quantity = quantity_with(plan, target.name);
      if (!quantity || quantity->distribution.kind == Kind::constant)
        table.reject("quantities", target.name +
                                       " has no [[quantity]] in this plan, or its distribution is "
                                       "\"constant\"; add a [[quantity]] that varies");
      if (!grouped.insert(target.name).second)
        table.reject(
            "quantities",
            target.name + " is in two groups, or twice in one group; list each quantity only once");
      group.quantities.push_back(target.name);
    }
  }
  if (group.quantities.size() < 2)
    table.reject(
        "quantities",
        "must list at least two quantities; * stands for any name, such as probe.*.drift_nm");
  read_matrix(table, group);
  return group;
}

void read_bins(TomlTable& table, StudyPlan& plan, const std::set<std::string>& grouped) {
  auto bins = table.table("bins");
  if (!bins) return;
  plan.binned_key = bins->string("quantity", "travel_mm");
  plan.bins = static_cast<std::size_t>(bins->integer("count", 20));
  if (plan.bins < 1 || plan.bins > kMostStudyBins)  // a negative count becomes a large number
    bins->reject("count", "must be from 1 to " + std::to_string(kMostStudyBins) +
                              ", because each bin needs 33 kB of memory for each output and "
                              "thread; for smaller bins, write several plans, each with a part of "
                              "the range");
  const PlannedQuantity* quantity = quantity_with(plan, plan.binned_key);
  if (!quantity || quantity->distribution.kind != Kind::rectangular ||
      quantity->name != plan.binned_key)
    bins->reject("quantity", "\"" + plan.binned_key +
                                 "\" must be the full name (without \"*\") of one "
                                 "quantity of this plan that has a rectangular distribution");
  if (grouped.contains(plan.binned_key))
    bins->reject("quantity", "\"" + plan.binned_key +
                                 "\" is correlated with other quantities; for bins, choose a "
                                 "quantity without correlation");
}

}  // namespace

Status read_quantities(TomlTable& table, const Path& folder, StudyPlan& plan) {
  read_truth(table, plan);
  for (auto& quantity : table.tables("quantity")) MDOF_CHECK(read_quantity(quantity, folder, plan));
  set_default_truth(plan, table.has("truth"));
  reject_doubles(table, plan);
  return {};
}

void read_dependence(TomlTable& table, StudyPlan& plan) {
  std::set<std::string> grouped;
  for (auto& group : table.tables("correlation"))
    plan.correlations.push_back(read_correlation(group, plan, grouped));
  read_bins(table, plan, grouped);
}

}  // namespace mdof::plan_parts
