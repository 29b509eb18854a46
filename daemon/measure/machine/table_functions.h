// Converts columns of a compensation table to the error functions of a machine description.
#pragma once

#include <string>
#include <vector>

#include "algo/compensation/error_covariance.h"
#include "schema/axis.h"
#include "schema/compensation_table.h"
#include "schema/machine/machine.h"

namespace mdof::daemon {

// The function has the positions where at least one approach has a value; the other approach gets
// the same value there. An unknown u (NaN) becomes the largest of the others; if all are unknown,
// the function has no u. The curvature is the larger one of both approaches.
ErrorFunction function_of(const std::vector<double>& position, const std::vector<double>& forward,
                          const std::vector<double>& reverse, const std::vector<double>& u,
                          const std::vector<double>& u_noise);
// Sets the curvature, which adds to u between the positions, for a function with u and at least
// three positions. Known noise of the values is subtracted.
void add_curvature(ErrorFunction& f);
void add_curvatures(Machine& machine);
// The larger u of both approaches, so that it holds for each approach and for their mean.
std::vector<double> larger(const std::vector<double>& forward, const std::vector<double>& reverse);
// Shifts the function so that the mean of both approaches is 0 at the position. Beyond the ends the
// end values hold. u does not change.
void set_angle_zero_at(ErrorFunction& f, double zero_m);
// Upper bound of u of such an angle, for unknown covariance between its positions.
void bound_angle_u(ErrorFunction& f, double zero_m);
std::vector<double> scaled(std::vector<double> values, double by);

// Index of the table's named error among the six errors of a body.
std::size_t body_error_index(const CompensationTable& table, std::size_t named);
// Sets the covariance of the frame's errors and, from it, u of each error that already has a u. The
// rows of `covariances` are those of `table`; an error may lack some of them.
void set_covariance(MachineFrame& frame, const CompensationTable& table,
                    const algo::ErrorCovariances& covariances);
// Adds a shared quantity and subtracts it from the declared covariance.
void add_shared(MachineFrame& frame, const CompensationTable& table, const std::string& name,
                const std::vector<Errors5>& by_row);
// Whether at_m is more than one target interval beyond the positions.
bool is_beyond(const std::vector<double>& position_m, double at_m);

}  // namespace mdof::daemon
