// Builds a compensation table of one axis from runs, and evaluates a table at a position.
#pragma once

#include <optional>
#include <vector>

#include "algo/iso230/target_means.h"
#include "schema/base/result.h"
#include "schema/compensation_table.h"
#include "schema/notice/notice.h"
#include "schema/run.h"

namespace mdof::algo {

// Options of build_table(), which calculates the mean errors at each target over all given runs,
// separately for the forward and the reverse approach.
// - Each angle refers to its mean of both approaches at `angles_zero_m`.
// - With `remove_slope`, straightness refers to its least-squares line, because the slope belongs
//   to squareness. Otherwise straightness is as measured.
// - `stated` is the reference point of straightness.
// - Targets of different runs are the same target if their positions agree within 2 % of the
//   smallest step.
//
// Errors: runs of different axes; runs with different targets; the errors of check_usable().
struct TableOptions {
  bool remove_slope = true;
  bool take_partial = false;  // true: partial runs are accepted, too
  StatedAt stated;
  Chain machine;
  // Position at which each angle (mean of both approaches) is 0. The angle is interpolated
  // linearly; outside the targets the end value is held. Empty: the first target.
  std::optional<double> angles_zero_m = std::nullopt;
};
Result<CompensationTable> build_table(const std::vector<Run>& runs, const TableOptions& options);
// Replaces the values of both approaches by their means, with the u of the means. The means become
// the values of the approach forward; the approach reverse has no values. `table`: the result of
// build_table() for these runs and options.
Status join_approaches(const std::vector<Run>& runs, const TableOptions& options,
                       CompensationTable& table);
// A table without u, and the points and means from which it was calculated.
struct MeanTable {
  CompensationTable table;
  // Points of all runs. A target has the same number in all runs; the repeat numbers continue from
  // one run to the next.
  std::vector<MeasuredPoint> points;
  std::vector<TargetMean> grid;  // means of both approaches
};
Result<MeanTable> mean_table(const std::vector<Run>& runs, const TableOptions& options);
// The reference of a value is the weighted sum of means that is subtracted from the mean at its
// position. Returns the weights for a table with these options, as [named error][position][j]: the
// weight of the mean at position j.
std::array<std::vector<std::vector<double>>, kErrorCount> references_of(
    const CompensationTable& table, const TableOptions& options);
// Returns the notices of uneven_visits() for the points of all runs together. Error: the runs have
// different targets.
Result<Notices> uneven_visit_notices(const std::vector<Run>& runs);

// The errors at a position. Between two targets, the errors and their u are interpolated linearly;
// outside the targets the end value is held and `inside` is false. The linear u is the u for fully
// correlated values. It is an upper limit, because a smaller correlation reduces u. u_interpolation
// is added to u. u_interpolation assumes that the curvature of the errors between two targets is
// the same as around these targets.
struct TableValue {
  Errors5 error{};  // named errors; NaN: the table has no value
  Errors5 u{};
  // Part of u; 0 at the targets. Where an end value is held, it contains the slope of the errors.
  Errors5 u_interpolation{};
  // true: the position is within the measured positions of this approach. For the mean, it is
  // within the measured positions of both approaches. false: the end value is held, or the value is
  // from the other approach.
  bool inside = true;
};
enum class TableSide { forward, reverse, mean };
TableValue table_at(const CompensationTable& table, double position_m, TableSide side);

}  // namespace mdof::algo
