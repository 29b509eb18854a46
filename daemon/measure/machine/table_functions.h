// Columns of a compensation table as the functions of a machine's description.
#pragma once

#include <vector>

#include "schema/axis.h"
#include "schema/compensation_table.h"
#include "schema/machine/machine.h"

namespace mdof::daemon {

// At the positions where one approach at least has a value; the other has the same there. An
// unknown u (NaN) counts as the largest of the others; where none is known, the function has none.
ErrorFunction function_of(const std::vector<double>& position, const std::vector<double>& forward,
                          const std::vector<double>& reverse, const std::vector<double>& u,
                          const std::vector<double>& u_noise);
// u of both approaches: the larger, so that it holds for the value of either and of their mean.
std::vector<double> larger(const std::vector<double>& forward, const std::vector<double>& reverse);
// Makes the mean of both approaches 0 at the position, the ends held. u: with that of the value
// there; none is added where that is the first position, at which a table has its angles 0.
void refer_angle(ErrorFunction& f, double zero_m);
std::vector<double> scaled(std::vector<double> values, double by);

// Which of the six errors of a body the named error of the table is.
std::size_t body_error_of(const CompensationTable& table, std::size_t named);
ErrorCorrelation correlation_of(const CompensationTable& table,
                                const std::vector<Covariance5>& by_row);
// Beyond the positions by more than a target interval.
bool is_beyond(const std::vector<double>& position_m, double at_m);

}  // namespace mdof::daemon
