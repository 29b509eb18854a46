#include "daemon/measure/several_runs/compared_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "algo/compensation/imported_table.h"
#include "algo/uncertainty/coverage.h"
#include "daemon/measure/imported/positioning_figures.h"
#include "schema/imported/series.h"
#include "schema/iso230/targets.h"
#include "schema/sample.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

constexpr double kSameTarget_m = 1e-4;
constexpr double kManyReadings = std::numeric_limits<double>::infinity();

// Mean of the points of one target with one approach.
struct ApproachMean {
  double value = kNaN, u_random = kNaN;
  double freedom = kManyReadings;  // degrees of freedom of u_random
  double u_declared = 0;
  double u() const { return std::hypot(u_random, u_declared); }
};

double at_row(const std::vector<double>& values, std::size_t row, double none) {
  return values.empty() ? none : values[row];
}

// Number of readings for each target and approach. A reading without an approach counts for both
// approaches.
struct Counts {
  std::vector<double> forward, reverse;  // one number for each row of the table
  bool no_reversal = false;  // true: an imported run with readings that have no approach
};

Counts counts_of(const TabledRun& of) {
  const std::size_t rows = of.table.position_m.size();
  Counts counts{std::vector<double>(rows), std::vector<double>(rows),
                is_imported(of.run.header) && has_unknown_approach(of.run)};
  for (const MeasuredPoint& p : of.run.points) {
    const std::size_t row = target_at(of.table.position_m, p.target_m);
    if (p.point.direction >= 0) ++counts.forward[row];
    if (p.point.direction <= 0) ++counts.reverse[row];
  }
  return counts;
}

ApproachMean mean_at(const TabledRun& of, const Counts& counts, std::size_t error, std::size_t row,
                     int direction) {
  const CompensationTable& t = of.table;
  const bool forward = direction > 0;
  if (t.has_positioning())
    return {(forward ? t.positioning.forward : t.positioning.reverse)[row],
            (forward ? t.positioning.u_forward : t.positioning.u_reverse)[row],
            (forward ? counts.forward : counts.reverse)[row] - 1,
            at_row(t.positioning.u_declared, row, 0)};
  return {(forward ? t.forward : t.reverse)[error][row],
          (forward ? t.u_forward : t.u_reverse)[error][row], kManyReadings,
          at_row(t.u_declared[error], row, 0)};
}

double expanded(double u, std::initializer_list<algo::UncertaintyPart> parts) {
  return std::isnan(u) ? kNaN : u * algo::coverage_factor(algo::effective_freedom(parts));
}

// The value and U of the value, for each item of kComparedSides.
std::array<std::pair<double, double>, 3> sides_at(const TabledRun& of, const Counts& counts,
                                                  std::size_t error, std::size_t row) {
  const ApproachMean f = mean_at(of, counts, error, row, 1),
                     r = mean_at(of, counts, error, row, -1);
  const auto U_of = [](const ApproachMean& m) {
    return expanded(m.u(), {{m.u_random, m.freedom}, {m.u_declared, kManyReadings}});
  };
  return {std::pair{f.value, U_of(f)},
          {r.value, U_of(r)},
          {counts.no_reversal ? kNaN : f.value - r.value,
           counts.no_reversal ? kNaN
                              : expanded(std::hypot(f.u_random, r.u_random),
                                         {{f.u_random, f.freedom}, {r.u_random, r.freedom}})}};
}

std::vector<std::string> errors_of(const CompensationTable& table) {
  if (table.has_positioning()) return {positioning_name(table.axis) + "_um"};
  std::vector<std::string> keys;
  for (const ErrorName& name : error_names(table.axis)) keys.emplace_back(name.key);
  return keys;
}

}  // namespace

ComparedPoints compared_points(const TabledRun& before, const TabledRun& after) {
  ComparedPoints compared{errors_of(before.table), {}};
  const std::vector<double>& places = after.table.position_m;
  const Counts counts_before = counts_of(before), counts_after = counts_of(after);
  for (std::size_t row = 0; row < before.table.position_m.size(); ++row) {
    ComparedPoint point;
    point.position_m = before.table.position_m[row];
    const std::size_t other = target_at(places, point.position_m);
    if (std::abs(places[other] - point.position_m) > kSameTarget_m) continue;
    for (std::size_t error = 0; error < compared.errors.size(); ++error) {
      const auto a = sides_at(before, counts_before, error, row),
                 b = sides_at(after, counts_after, error, other);
      for (std::size_t side = 0; side < a.size(); ++side)
        point.side[side].push_back({a[side].first, b[side].first, a[side].second, b[side].second});
    }
    compared.points.push_back(std::move(point));
  }
  return compared;
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
