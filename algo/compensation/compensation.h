// Runs -> one-axis compensation table, and the table's value at a position.
#pragma once

#include <optional>
#include <vector>

#include "algo/iso230/target_means.h"
#include "schema/base/result.h"
#include "schema/compensation_table.h"
#include "schema/notice/notice.h"
#include "schema/run.h"

namespace mdof::algo {

// Mean errors at each target over all runs given (one axis, the same targets), forward and reverse
// apart; angles referred to the mean of both approaches at the first target, straightness to its
// least-squares line (`remove_slope`: the slope belongs to squareness) or as measured. Targets of
// different runs are one where they lie within 2 % of the smallest step, else it is an error.
// Straightness holds at `stated`. Errors as of check_usable(), too.
struct TableOptions {
  bool remove_slope = true;
  bool take_partial = false;
  StatedAt stated;
  Chain machine;
  // Where the mean of both approaches of an angle is 0, on the straight line between two targets,
  // the ends held; none: at the first target.
  std::optional<double> angles_zero_m = std::nullopt;
};
Result<CompensationTable> build_table(const std::vector<Run>& runs, const TableOptions& options);
// The same without u, and what it is made of.
struct TableOfMeans {
  CompensationTable table;
  std::vector<MeasuredPoint> points;  // of all runs, targets and repeats numbered on
  std::vector<TargetMean> grid;       // of both approaches
};
Result<TableOfMeans> table_of_means(const std::vector<Run>& runs, const TableOptions& options);
// What the values of a table of these options refer to, as shares of the means at its positions: of
// each named error and position the share of each position.
std::array<std::vector<std::vector<double>>, kErrorCount> references_of(
    const CompensationTable& table, const TableOptions& options);
// What their table makes up for, as uneven_visits(), of all runs together, counted on from one to
// the next. Errors: other targets.
Result<Notices> uneven_visits_of(const std::vector<Run>& runs);

// The errors at a position: linear between grid points, the end value held outside and said so. u
// between two targets is linear, too: no correlation of the two values makes the interpolated one
// less certain. What interpolation does is added, of an axis that bends between them as it does
// about them.
struct TableValue {
  Errors5 error{};  // named; NaN where the table has no value
  Errors5 u{};
  Errors5 u_interpolation{};  // of it; 0 at the targets and where an end value is held
  // Within what was measured of this approach (of both, for the mean). false: the end value is
  // held, or the other approach's value is given.
  bool inside = true;
};
enum class TableSide { forward, reverse, mean };
TableValue table_at(const CompensationTable& table, double position_m, TableSide side);

}  // namespace mdof::algo
