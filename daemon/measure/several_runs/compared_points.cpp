#include "daemon/measure/several_runs/compared_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "algo/compensation/imported_table.h"
#include "algo/uncertainty/budget/budget.h"
#include "algo/uncertainty/coverage.h"
#include "schema/imported/series.h"
#include "schema/sample.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

constexpr double kSameTarget_m = 1e-4;
constexpr double kManyReadings = std::numeric_limits<double>::infinity();

// The mean of one approach at a target.
struct ApproachMean {
  double value = kNaN, u_random = kNaN;
  double freedom = kManyReadings;  // of u_random
  double u_declared = 0;
  double u() const { return std::hypot(u_random, u_declared); }
};

double at_row(const std::vector<double>& values, std::size_t row, double none) {
  return values.empty() ? none : values[row];
}

// Readings less one, of a target and an approach; those that do not say theirs are of both.
double freedom_at(const TabledRun& of, std::size_t row, int direction) {
  double readings = 0;
  for (const MeasuredPoint& p : of.run.points)
    readings += algo::target_at(of.table.position_m, p.target_m) == row &&
                (p.point.direction == direction || p.point.direction == 0);
  return readings - 1;
}

ApproachMean mean_at(const TabledRun& of, std::size_t error, std::size_t row, int direction) {
  const CompensationTable& t = of.table;
  const bool forward = direction > 0;
  if (t.has_positioning())
    return {(forward ? t.positioning.forward : t.positioning.reverse)[row],
            (forward ? t.positioning.u_forward : t.positioning.u_reverse)[row],
            freedom_at(of, row, direction), at_row(t.positioning.u_declared, row, 0)};
  return {(forward ? t.forward : t.reverse)[error][row],
          (forward ? t.u_forward : t.u_reverse)[error][row], kManyReadings,
          at_row(t.u_declared[error], row, 0)};
}

// Whether a reading does not say its approach, so that nothing is known of the reversal.
bool has_unknown_approach(const Run& run) {
  return is_imported(run.header) &&
         std::any_of(run.points.begin(), run.points.end(),
                     [](const auto& p) { return p.point.direction == 0; });
}

double expanded(double u, std::initializer_list<algo::UncertaintyPart> parts) {
  return std::isnan(u) ? kNaN : u * algo::coverage_factor(algo::effective_freedom(parts));
}

// The value and its U, of each of kComparedSides.
std::array<std::pair<double, double>, 3> sides_at(const TabledRun& of, std::size_t error,
                                                  std::size_t row) {
  const ApproachMean f = mean_at(of, error, row, 1), r = mean_at(of, error, row, -1);
  const bool no_reversal = has_unknown_approach(of.run);
  const auto U_of = [](const ApproachMean& m) {
    return expanded(m.u(), {{m.u_random, m.freedom}, {m.u_declared, kManyReadings}});
  };
  return {std::pair{f.value, U_of(f)},
          {r.value, U_of(r)},
          {no_reversal ? kNaN : f.value - r.value,
           no_reversal ? kNaN
                       : expanded(std::hypot(f.u_random, r.u_random),
                                  {{f.u_random, f.freedom}, {r.u_random, r.freedom}})}};
}

std::vector<std::string> errors_of(const CompensationTable& table) {
  if (table.has_positioning()) return {positioning_name(table.axis) + "_um"};
  std::vector<std::string> keys;
  for (const ErrorName& name : error_names(table.axis)) keys.emplace_back(name.key);
  return keys;
}

struct PlacedMean {
  ApproachMean mean;
  std::size_t row = 0;
};

Budget range_budget(const std::string& figure, const std::vector<PlacedMean>& means) {
  const auto [low, high] = std::minmax_element(
      means.begin(), means.end(),
      [](const PlacedMean& a, const PlacedMean& b) { return a.mean.value < b.mean.value; });
  Budget budget;
  budget.figure = figure;
  budget.value = high->mean.value - low->mean.value;
  using enum ContributorKind;
  for (const auto& [end, of_repeats, of_import] :
       {std::tuple{high, upper_end_repeats, upper_end_declared},
        {low, lower_end_repeats, lower_end_declared}}) {
    BudgetLine repeats;
    repeats.name = {of_repeats};
    repeats.distribution = "t";
    repeats.contribution = end->mean.u_random;
    repeats.freedom = end->mean.freedom;
    budget.lines.push_back(repeats);
    if (end->mean.u_declared <= 0) continue;
    BudgetLine declared;
    declared.name = {of_import};
    declared.key = "u_um";
    declared.unit = "um";
    declared.value = to_um(end->mean.u_declared);
    declared.distribution = "normal";
    declared.contribution = end->mean.u_declared;
    budget.lines.push_back(declared);
  }
  budget.u_random = std::hypot(high->mean.u_random, low->mean.u_random);
  return budget;
}

void complete_or_unknown(Budget& budget) {
  if (!std::isnan(budget.u_random)) return algo::complete(budget);
  budget.u = budget.U = budget.freedom = budget.coverage_factor = kNaN;
  budget.is_single_run = true;
  budget.lines.clear();
}

Budget reversal_budget(const std::string& figure, const std::vector<PlacedMean>& forward,
                       const std::vector<PlacedMean>& reverse) {
  Budget largest;
  for (const PlacedMean& f : forward)
    for (const PlacedMean& r : reverse) {
      if (f.row != r.row) continue;
      Budget at;
      at.value = f.mean.value - r.mean.value;
      at.u_random = std::hypot(f.mean.u_random, r.mean.u_random);
      for (const ApproachMean* mean : {&f.mean, &r.mean}) {
        BudgetLine line;
        line.name = {mean == &f.mean ? ContributorKind::forward_repeats
                                     : ContributorKind::reverse_repeats};
        line.distribution = "t";
        line.contribution = mean->u_random;
        line.freedom = mean->freedom;
        at.lines.push_back(line);
      }
      if (largest.lines.empty() || std::abs(at.value) > std::abs(largest.value)) largest = at;
    }
  largest.figure = figure;
  return largest;
}

}  // namespace

ComparedPoints compared_points(const TabledRun& before, const TabledRun& after) {
  ComparedPoints compared{errors_of(before.table), {}};
  const std::vector<double>& places = after.table.position_m;
  for (std::size_t row = 0; row < before.table.position_m.size(); ++row) {
    ComparedPoint point;
    point.position_m = before.table.position_m[row];
    const std::size_t other = algo::target_at(places, point.position_m);
    if (std::abs(places[other] - point.position_m) > kSameTarget_m) continue;
    for (std::size_t error = 0; error < compared.errors.size(); ++error) {
      const auto a = sides_at(before, error, row), b = sides_at(after, error, other);
      for (std::size_t side = 0; side < a.size(); ++side)
        point.side[side].push_back({a[side].first, b[side].first, a[side].second, b[side].second});
    }
    compared.points.push_back(std::move(point));
  }
  return compared;
}

std::vector<Budget> positioning_budgets(const TabledRun& of) {
  std::vector<PlacedMean> forward, reverse;
  for (std::size_t row = 0; row < of.table.position_m.size(); ++row)
    for (auto& [means, direction] : {std::pair{&forward, 1}, {&reverse, -1}}) {
      const ApproachMean mean = mean_at(of, 0, row, direction);
      if (std::isfinite(mean.value)) means->push_back({mean, row});
    }
  std::vector<PlacedMean> both = forward;
  both.insert(both.end(), reverse.begin(), reverse.end());
  const std::string name = positioning_name(of.table.axis);
  const bool directed = !has_unknown_approach(of.run);
  std::vector<Budget> budgets;
  if (!forward.empty() && !reverse.empty()) {
    budgets.push_back(range_budget(name + "_E_um", both));
    const Budget reversal = reversal_budget(name + "_B_um", forward, reverse);
    if (directed && !reversal.lines.empty()) budgets.push_back(reversal);
  }
  if (directed && !forward.empty())
    budgets.push_back(range_budget(name + "_E_forward_um", forward));
  if (directed && !reverse.empty())
    budgets.push_back(range_budget(name + "_E_reverse_um", reverse));
  for (Budget& budget : budgets) {
    budget.is_imported = true;
    complete_or_unknown(budget);
    if (!of.table.has_declared()) budget.not_declared = {"u_um"};
  }
  return budgets;
}

void write_compared_points(JsonWriter& json, const ComparedPoints& compared) {
  json.key("points").begin_array();
  for (const ComparedPoint& point : compared.points) {
    json.begin_object().field("position_mm", to_mm(point.position_m));
    for (std::size_t side = 0; side < kComparedSides.size(); ++side) {
      json.key(kComparedSides[side]).begin_object();
      for (std::size_t error = 0; error < compared.errors.size(); ++error) {
        const ComparedValue& value = point.side[side][error];
        json.key(compared.errors[error])
            .begin_object()
            .field("before", to_key_unit(value.before))
            .field("after", to_key_unit(value.after))
            .field("U_before", to_key_unit(value.U_before))
            .field("U_after", to_key_unit(value.U_after))
            .end_object();
      }
      json.end_object();
    }
    json.end_object();
  }
  json.end_array();
}

}  // namespace mdof::daemon
