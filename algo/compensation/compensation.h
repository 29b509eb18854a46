// Builds a compensation table of one axis from runs, and evaluates it at a position.
#pragma once

#include <optional>
#include <vector>

#include "algo/iso230/target_means.h"
#include "schema/base/result.h"
#include "schema/compensation_table.h"
#include "schema/notice/notice.h"
#include "schema/run.h"

namespace mdof::algo {

// The mean errors at each target over all given runs (one axis, the same targets), forward and
// reverse separately. Angles refer to the mean of both approaches at the first target. Straightness
// refers to its least-squares line (`remove_slope`: the slope belongs to squareness) or is as
// measured, and holds at `stated`. Targets of different runs are the same target if they agree
// within 2 % of the smallest step; otherwise it is an error. Further errors: those of
// check_usable().
struct TableOptions {
  bool remove_slope = true;
  bool take_partial = false;
  StatedAt stated;
  Chain machine;
  // Position at which the mean of both approaches of an angle is 0, by linear interpolation with
  // the end values held; empty: the first target.
  std::optional<double> angles_zero_m = std::nullopt;
};
Result<CompensationTable> build_table(const std::vector<Run>& runs, const TableOptions& options);
// A table without u, and the points and means that it is made of.
struct MeanTable {
  CompensationTable table;
  // Points of all runs; targets and repeats numbered through all runs.
  std::vector<MeasuredPoint> points;
  std::vector<TargetMean> grid;  // means of both approaches
};
Result<MeanTable> mean_table(const std::vector<Run>& runs, const TableOptions& options);
// The references of a table with these options, as shares of the means at its positions: for each
// named error and position the share of each position.
std::array<std::vector<std::vector<double>>, kErrorCount> references_of(
    const CompensationTable& table, const TableOptions& options);
// Notices of uneven_visits() for the points of all runs together, numbered through all runs. Error:
// the runs have different targets.
Result<Notices> uneven_visit_notices(const std::vector<Run>& runs);

// Evaluates the errors at a position: linear between grid points; outside, the end value is held
// and `inside` is false. u is linear between two targets, too: no correlation of the two values
// gives the interpolated value a larger u. u_interpolation is added for an axis whose errors have
// the same curvature between the targets as around them.
struct TableValue {
  Errors5 error{};  // named; NaN: the table has no value
  Errors5 u{};
  Errors5 u_interpolation{};  // part of u; 0 at the targets and where an end value is held
  // Whether the position is within the measured positions of this approach (of both approaches, for
  // the mean). false: the end value is held, or the value is from the other approach.
  bool inside = true;
};
enum class TableSide { forward, reverse, mean };
TableValue table_at(const CompensationTable& table, double position_m, TableSide side);

}  // namespace mdof::algo
