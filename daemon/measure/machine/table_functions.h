// Columns of a compensation table as the functions of a machine's description.
#pragma once

#include <vector>

#include "schema/machine/machine.h"

namespace mdof::daemon {

// At the positions where one approach at least has a value; the other has the same there.
ErrorFunction function_of(const std::vector<double>& position, const std::vector<double>& forward,
                          const std::vector<double>& reverse, const std::vector<double>& u,
                          const std::vector<double>& u_noise);
// u of both approaches: the larger, so that it holds for the value of either and of their mean.
std::vector<double> larger(const std::vector<double>& forward, const std::vector<double>& reverse);
std::vector<double> scaled(std::vector<double> values, double by);

}  // namespace mdof::daemon
