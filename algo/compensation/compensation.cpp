#include "algo/compensation/compensation.h"

#include <algorithm>
#include <cmath>

#include "algo/compensation/between_targets.h"
#include "algo/compensation/table_uncertainty.h"
#include "algo/iso230/line_fit.h"
#include "algo/iso230/target_means.h"
#include "algo/machine/frames.h"
#include "algo/model/restate.h"
#include "algo/sequence/uneven_visits.h"
#include "algo/sequence/usable_runs.h"
#include "algo/uncertainty/statistics/visit_scatter.h"
#include "schema/base/number/number_text.h"
#include "schema/sample.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr double kSameTargetShare = 0.02;

double smallest_step(const std::vector<double>& x) {
  double step = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < x.size(); ++i) step = std::min(step, x[i] - x[i - 1]);
  return step;
}

// Returns all points of all runs. The target number is the index in `grid` plus 1. The repeat
// numbers continue from one run to the next.
Result<std::vector<MeasuredPoint>> on_one_grid(const std::vector<Run>& runs,
                                               const std::vector<double>& grid) {
  std::vector<MeasuredPoint> points;
  const double window = kSameTargetShare * smallest_step(grid);
  int repeats = 0;
  for (const Run& run : runs) {
    const int before = repeats;
    for (MeasuredPoint p : run.points) {
      if (!p.errors.valid) continue;
      const auto near = std::min_element(grid.begin(), grid.end(), [&](double a, double b) {
        return std::abs(a - p.point.position_m) < std::abs(b - p.point.position_m);
      });
      if (std::abs(*near - p.point.position_m) > window) {
        return bad_input(
            "run " + std::to_string(run.header.id) + " has a measured point at " +
            plain_number(to_mm(p.point.position_m), 7) + " mm, but run " +
            std::to_string(runs.front().header.id) +
            " has no target at this position; build a table from runs with the same targets");
      }
      p.target = static_cast<int>(near - grid.begin()) + 1;
      p.run += before;
      repeats = std::max(repeats, p.run);
      points.push_back(std::move(p));
    }
  }
  return points;
}

double mean_at(const std::vector<double>& x, const std::vector<double>& y, double at) {
  const Reference shares = interpolation_at(x, at);
  double mean = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (shares[i] != 0) mean += shares[i] * y[i];
  return mean;
}

// Returns the reference that is subtracted from each named error: a line for straightness, a
// constant for angles.
std::array<Line, 5> references(Axis axis, const std::vector<TargetMean>& mean,
                               const TableOptions& options) {
  std::array<Line, 5> lines{};
  const auto x = positions(mean);
  for (std::size_t k = 0; k < 5; ++k) {
    const auto y = column(mean, k);
    if (error_names(axis)[k].angle) {
      lines[k].intercept = mean_at(x, y, options.angles_zero_m.value_or(x.front()));
    } else if (options.remove_slope) {
      lines[k] = least_squares_line(x, y);
    }
  }
  return lines;
}

void fill_side(const MovingAxis& moving, const std::vector<MeasuredPoint>& points,
               Approach approach, const std::vector<TargetMean>& grid,
               const std::array<Line, 5>& reference, std::array<std::vector<double>, 5>& values) {
  const auto series = target_means(moving, points, approach);
  const double window = kSameTargetShare * smallest_step(positions(grid));
  for (std::size_t k = 0; k < 5; ++k) {
    values[k].assign(grid.size(), kNaN);
    for (const TargetMean& m : series) {
      for (std::size_t i = 0; i < grid.size(); ++i) {
        if (std::abs(grid[i].position_m - m.position_m) > window) continue;
        values[k][i] = m.named[k] - reference[k].at(m.position_m);
      }
    }
  }
}

// A position between the grid points `below` and `below` + 1. `share` is the share of the interval,
// 0 ... 1; a position outside the grid has the share of the nearer end.
struct Place {
  std::size_t below = 0;
  double share = 0;
};

Place place_on(const std::vector<double>& x, double at) {
  if (!(at > x.front()) || x.size() == 1) return {0, 0.0};
  if (at >= x.back()) return {x.size() - 2, 1.0};
  const auto above = std::upper_bound(x.begin(), x.end(), at);
  const auto i = static_cast<std::size_t>(above - x.begin()) - 1;
  return {i, (at - x[i]) / (x[i + 1] - x[i])};
}

// Interpolates linearly between the grid points that have a value. Only for the rare series with
// gaps.
double interpolate_over_gaps(const std::vector<double>& x, const std::vector<double>& y,
                             double at) {
  std::size_t below = x.size(), above = x.size();
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(y[i])) continue;
    if (x[i] <= at) below = i;
    if (x[i] >= at && above == x.size()) above = i;
  }
  if (below == x.size() && above == x.size()) return kNaN;
  if (below == x.size()) return y[above];
  if (above == x.size() || above == below) return y[below];
  return y[below] + (y[above] - y[below]) * ((at - x[below]) / (x[above] - x[below]));
}

double interpolate(const std::vector<double>& x, const std::vector<double>& y, double at,
                   const Place& place) {
  const double low = y[place.below], high = y[std::min(place.below + 1, y.size() - 1)];
  if (!std::isfinite(low) || !std::isfinite(high)) return interpolate_over_gaps(x, y, at);
  return place.share == 1.0 ? high : low + (high - low) * place.share;
}

// Returns whether the position is between the first and the last position with a value of this
// column, or outside by at most kEndTolerance of the interval at that end.
bool spans(const std::vector<double>& x, const std::vector<double>& y, double at) {
  std::size_t first = 0, last = x.size();
  while (first < x.size() && !std::isfinite(y[first])) ++first;
  while (last > 0 && !std::isfinite(y[last - 1])) --last;
  if (first >= last) return false;
  if (first + 1 == last) return at == x[first];
  return at >= x[first] - kEndTolerance * (x[first + 1] - x[first]) &&
         at <= x[last - 1] + kEndTolerance * (x[last - 1] - x[last - 2]);
}

bool measured_there(const CompensationTable& table, double position_m, TableSide side) {
  const auto all = [&](const std::array<std::vector<double>, 5>& columns) {
    return std::all_of(columns.begin(), columns.end(),
                       [&](const auto& y) { return spans(table.position_m, y, position_m); });
  };
  return (side == TableSide::reverse || all(table.forward)) &&
         (side == TableSide::forward || all(table.reverse));
}

// Errors: runs of different axes; runs of rigs with different sides.
Status add_sources(const std::vector<Run>& runs, CompensationTable& table) {
  for (const Run& run : runs) {
    if (run.header.axis != table.axis) {
      return bad_input("run " + std::to_string(run.header.id) + " measures axis " +
                       letter(run.header.axis) + ", but run " +
                       std::to_string(runs.front().header.id) + " measures axis " +
                       letter(table.axis) + "; build a table from runs of one axis");
    }
    if (run.header.sides != table.sides) {
      return bad_input(
          "the rigs of run " + std::to_string(run.header.id) + " and run " +
          std::to_string(runs.front().header.id) +
          " differ in the key \"moves\" or \"travel\"; build a table from runs of one set-up");
    }
    table.runs.push_back(run.header.id);
    table.simulated = table.simulated || run.header.simulated;
  }
  return {};
}

}  // namespace

Result<MeanTable> mean_table(const std::vector<Run>& measured, const TableOptions& options) {
  if (measured.empty()) return bad_input("a compensation table needs at least one run");
  MeanTable out;
  CompensationTable& table = out.table;
  table.axis = measured.front().header.axis;
  table.sides = measured.front().header.sides;
  table.slope_removed = options.remove_slope;
  table.stated = options.stated;
  table.machine = options.machine;
  MDOF_CHECK(check_usable(all_of(measured), options.take_partial, "a table"));
  MDOF_CHECK(add_sources(measured, table));
  std::vector<Run> runs;
  for (const Run& run : measured) runs.push_back(restate(run, options.stated));
  const MovingAxis moving{table.axis, table.sides};
  const auto first = target_means(moving, runs.front().points, Approach::both);
  if (first.size() < 3 || !can_fit(positions(first))) {
    return bad_input(
        "run " + std::to_string(runs.front().header.id) + " has " + std::to_string(first.size()) +
        " targets with calculated errors, but a compensation table needs at least three");
  }
  MDOF_TRY(out.points, on_one_grid(runs, positions(first)));
  out.grid = target_means(moving, out.points, Approach::both);
  const auto reference = references(table.axis, out.grid, options);
  table.position_m = positions(out.grid);
  fill_side(moving, out.points, Approach::forward, out.grid, reference, table.forward);
  fill_side(moving, out.points, Approach::reverse, out.grid, reference, table.reverse);
  table.visited_once = VisitScatter(out.points).are_single();
  return out;
}

std::array<std::vector<Reference>, kErrorCount> references_of(const CompensationTable& table,
                                                              const TableOptions& options) {
  const std::size_t n = table.position_m.size();
  const double zero_m = options.angles_zero_m.value_or(table.position_m.front());
  std::array<std::vector<Reference>, kErrorCount> all;
  for (std::size_t k = 0; k < kErrorCount; ++k)
    for (const double at_m : table.position_m)
      all[k].push_back(error_names(table.axis)[k].angle ? interpolation_at(table.position_m, zero_m)
                       : table.slope_removed            ? line_at(table.position_m, at_m)
                                                        : as_measured(n));
  return all;
}

Result<CompensationTable> build_table(const std::vector<Run>& measured,
                                      const TableOptions& options) {
  MDOF_TRY(MeanTable of, mean_table(measured, options));
  const auto what = references_of(of.table, options);
  const MovingAxis moving{of.table.axis, of.table.sides};
  of.table.u_forward = table_uncertainty(moving, of.points, of.grid, Approach::forward, what);
  of.table.u_reverse = table_uncertainty(moving, of.points, of.grid, Approach::reverse, what);
  return std::move(of.table);
}

Status join_approaches(const std::vector<Run>& runs, const TableOptions& options,
                       CompensationTable& table) {
  MDOF_TRY(const MeanTable of, mean_table(runs, options));
  for (std::size_t k = 0; k < kErrorCount; ++k)
    for (std::size_t i = 0; i < table.position_m.size(); ++i) {
      double &f = table.forward[k][i], &r = table.reverse[k][i];
      f = !std::isfinite(r) ? f : std::isfinite(f) ? (f + r) / 2 : r;
      r = table.u_reverse[k][i] = kNaN;
    }
  table.u_forward = table_uncertainty({of.table.axis, of.table.sides}, of.points, of.grid,
                                      Approach::both, references_of(of.table, options));
  return {};
}

Result<Notices> uneven_visit_notices(const std::vector<Run>& runs) {
  if (runs.empty()) return Notices();
  const RunHeader& header = runs.front().header;
  const auto first = target_means({header.axis, header.sides}, runs.front().points, Approach::both);
  MDOF_TRY(const auto points, on_one_grid(runs, positions(first)));
  Notices found;
  for (Notice& each : uneven_visits(points))
    found.push_back(
        inherited("all runs together (the repetitions of all runs are numbered in one sequence)",
                  std::move(each)));
  return found;
}

namespace {

// The columns of one approach.
struct Side {
  const std::array<std::vector<double>, 5>&values, &u, &curvature;
};

// The nearest positions with a value below and above a position. `below` and `above` are equal if
// the position itself has a value, or if there is a value on one side only.
struct Neighbours {
  std::size_t below = 0, above = 0;
};

Neighbours neighbours(const std::vector<double>& x, const std::vector<double>& y, double at,
                      const Place& place) {
  std::size_t below = place.below, above = std::min(place.below + 1, y.size() - 1);
  if (place.share == 0.0 && std::isfinite(y[below])) return {below, below};
  if (place.share == 1.0 && std::isfinite(y[above])) return {above, above};
  while (below > 0 && !(std::isfinite(y[below]) && x[below] <= at)) --below;
  while (above + 1 < y.size() && !(std::isfinite(y[above]) && x[above] >= at)) ++above;
  if (!std::isfinite(y[below]) || x[below] > at) below = above;
  if (!std::isfinite(y[above]) || x[above] < at) above = below;
  return {below, above};
}

// One error of one approach; NaN: no value.
struct SideValue {
  double error = kNaN, u = kNaN, u_interpolation = kNaN;
};

// Returns u_beyond_end() of algo/compensation/between_targets.h; `end` is the first or last
// position with a value.
double u_held(const std::vector<double>& x, const std::vector<double>& y, std::size_t end,
              double at, double curvature) {
  const bool is_first = at < x[end];
  std::size_t next = is_first ? end + 1 : end - 1;  // wraps below 0
  while (next < x.size() && !std::isfinite(y[next])) is_first ? ++next : --next;
  if (next >= x.size()) return 0;
  return u_beyond_end(std::abs(at - x[end]), std::abs(x[next] - x[end]), y[next] - y[end],
                      curvature);
}

SideValue value_of(const CompensationTable& table, const Side& side, std::size_t k, double at,
                   const Place& place) {
  const auto& x = table.position_m;
  const auto& y = side.values[k];
  const Neighbours near = neighbours(x, y, at, place);
  if (!std::isfinite(y[near.below])) return {};
  SideValue value{interpolate(x, y, at, place), 0, 0};
  const double curvature = at == x[near.below] || x.size() == 1 ? 0
                           : side.curvature[k].empty() ? curvatures(x, y, side.u[k])[place.below]
                                                       : side.curvature[k][place.below];
  const double u_below = side.u[k][near.below], u_above = side.u[k][near.above];
  value.u = near.below == near.above ? u_below
                                     : u_below + (u_above - u_below) * (at - x[near.below]) /
                                                     (x[near.above] - x[near.below]);
  value.u_interpolation = near.below == near.above
                              ? u_held(x, y, near.below, at, curvature)
                              : 0.5 * (at - x[near.below]) * (x[near.above] - at) * curvature;
  return value;
}

// The part of the variance of the mean of both approaches that is not in (u_f² + u_r²)/4: the
// angles of both approaches have the same reference, the mean at the first target. The variance of
// this reference is that of half the difference of the approaches, which is the value at the first
// target. There the mean is exactly 0.
double shared_reference(const CompensationTable& table, std::size_t k, const Place& place) {
  if (!error_names(table.axis)[k].angle) return 0;
  const double f = table.u_forward[k].front(), r = table.u_reverse[k].front();
  if (!std::isfinite(f) || !std::isfinite(r)) return 0;
  return (place.below == 0 ? place.share - 0.5 : 0.5) * (f * f + r * r) / 2;
}

}  // namespace

TableValue table_at(const CompensationTable& table, double position_m, TableSide side) {
  TableValue value;
  const auto& x = table.position_m;
  value.inside = measured_there(table, position_m, side);
  const Place place = place_on(x, position_m);
  const auto declared = [&](std::size_t k) {
    if (!table.has_declared()) return 0.0;
    const auto& u = table.u_declared[k];
    if (place.share == 0.0) return u[place.below];
    const double above = u[std::min(place.below + 1, u.size() - 1)];
    return place.share == 1.0 ? above : u[place.below] + (above - u[place.below]) * place.share;
  };
  const Side forward{table.forward, table.u_forward, table.curvature_forward};
  const Side reverse{table.reverse, table.u_reverse, table.curvature_reverse};
  for (std::size_t k = 0; k < 5; ++k) {
    const auto f =
        side == TableSide::reverse ? SideValue{} : value_of(table, forward, k, position_m, place);
    const auto r =
        side == TableSide::forward ? SideValue{} : value_of(table, reverse, k, position_m, place);
    double u_random = 0;
    if (std::isfinite(f.error) && std::isfinite(r.error)) {
      value.error[k] = 0.5 * (f.error + r.error);
      value.u_interpolation[k] = 0.5 * (f.u_interpolation + r.u_interpolation);
      u_random = std::sqrt(
          std::max(0.0, 0.25 * (f.u * f.u + r.u * r.u) + shared_reference(table, k, place)));
    } else {
      const SideValue& one = std::isfinite(f.error) ? f : r;
      value.error[k] = one.error;
      value.u_interpolation[k] = one.u_interpolation;
      u_random = one.u;
    }
    value.u[k] = std::hypot(u_random, declared(k), value.u_interpolation[k]);
  }
  return value;
}

}  // namespace mdof::algo
