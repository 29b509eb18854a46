// Converts columns of a compensation table to the error functions of a machine description.
#pragma once

#include <string>
#include <vector>

#include "algo/compensation/error_covariance.h"
#include "schema/axis.h"
#include "schema/compensation_table.h"
#include "schema/machine/machine.h"
#include "schema/notice/notice.h"

namespace mdof::daemon {

// The function contains the positions at which at least one approach has a value. If only one
// approach has a value, both approaches get this value. An unknown u (NaN) is replaced by the
// largest known u. If no u is known, the function has no u. The curvature is the larger curvature
// of the two approaches.
ErrorFunction error_function(const std::vector<double>& position,
                             const std::vector<double>& forward, const std::vector<double>& reverse,
                             const std::vector<double>& u, const std::vector<double>& u_noise);
// Sets the curvature of a function that has u and at least three positions. The curvature increases
// u between the positions. The known noise of the values does not count as curvature.
void add_curvature(ErrorFunction& f);
void add_curvatures(Machine& machine);
// For each position, the larger value of the two approaches. A larger u is valid for each approach
// and for the mean of both approaches.
std::vector<double> larger(const std::vector<double>& forward, const std::vector<double>& reverse);
// Shifts the function so that the mean of both approaches is 0 at the position zero_m. If zero_m is
// beyond the last position, the last values are used. u does not change. Before the first position,
// nothing changes, because the angles of a table are 0 at its first position.
void set_angle_zero_at(ErrorFunction& f, double zero_m);
// After set_angle_zero_at(), replaces u of the shifted angle by an upper bound, which is valid for
// any covariance between the positions.
void bound_angle_u(ErrorFunction& f, double zero_m);
std::vector<double> scaled(std::vector<double> values, double by);

// Index among the six errors of a body (X, Y, Z, A, B, C). `named`: index among the five errors of
// the table.
std::size_t body_error_index(const CompensationTable& table, std::size_t named);
// Sets the covariance of the errors of the frame. Then calculates u of each error from the
// covariance, if the error has a u already. The rows of `covariances` are the rows of `table`. An
// error may have fewer positions than the table has rows.
void set_covariance(MachineFrame& frame, const CompensationTable& table,
                    const algo::ErrorCovariances& covariances);
// Adds a quantity that the probes of several axes share, and subtracts its part from the declared
// covariance. by_row: for each row of the table, the change of the five errors for one standard
// uncertainty of the quantity.
void add_shared(MachineFrame& frame, const CompensationTable& table, const std::string& name,
                const std::vector<Errors5>& by_row);
// Checks that the angles of a table can be 0 at the position that MACHINE.toml gives or, without
// the key, at 0. If the position is more than one interval outside the table, the angle there is
// unknown: an error if the key is given, otherwise a notice.
Status check_angles_zero(const MachineFrame& frame, const std::vector<double>& position_m,
                         Notices& doubtful);

}  // namespace mdof::daemon
