// Columns of a compensation table as the functions of a machine's description.
#pragma once

#include <string>
#include <vector>

#include "algo/compensation/error_covariance.h"
#include "schema/axis.h"
#include "schema/compensation_table.h"
#include "schema/machine/machine.h"

namespace mdof::daemon {

// At the positions where one approach at least has a value; the other has the same there. An
// unknown u (NaN) counts as the largest of the others; where none is known, the function has none.
// Its curvature is the larger of both approaches.
ErrorFunction function_of(const std::vector<double>& position, const std::vector<double>& forward,
                          const std::vector<double>& reverse, const std::vector<double>& u,
                          const std::vector<double>& u_noise);
// What u adds between the positions: of a function with u and at least three positions. Noise of
// the values is subtracted where it is known.
void add_curvature(ErrorFunction& f);
void add_curvatures(Machine& machine);
// u of both approaches: the larger, so that it holds for the value of either and of their mean.
std::vector<double> larger(const std::vector<double>& forward, const std::vector<double>& reverse);
// Makes the mean of both approaches 0 at the position, the ends held; u stays.
void refer_angle(ErrorFunction& f, double zero_m);
// u of such an angle at the most, where no covariance of its positions is known.
void bound_angle_u(ErrorFunction& f, double zero_m);
std::vector<double> scaled(std::vector<double> values, double by);

// Which of the six errors of a body the named error of the table is.
std::size_t body_error_of(const CompensationTable& table, std::size_t named);
// Gives the frame the covariance of its errors, and each of them its u by it: of those that have a
// u. `table`: the rows of the covariances, which are those of the errors.
void set_covariance(MachineFrame& frame, const CompensationTable& table,
                    const algo::ErrorCovariances& covariances);
// Adds what is shared and takes it out of the rest.
void add_shared(MachineFrame& frame, const CompensationTable& table, const std::string& name,
                const std::vector<Errors5>& by_row);
// Beyond the positions by more than a target interval.
bool is_beyond(const std::vector<double>& position_m, double at_m);

}  // namespace mdof::daemon
