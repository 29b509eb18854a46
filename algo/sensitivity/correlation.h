// Correlated quantities by a Gaussian copula. Independent normal scores are multiplied by the
// Cholesky factor of the correlation matrix. The value of a quantity is the quantile of its
// distribution at its score. Normal quantities have exactly this correlation (JCGM 101 §6.4.8). For
// other distributions, the scores have this correlation.
#pragma once

#include <span>
#include <vector>

#include "schema/base/result.h"
#include "schema/study/plan.h"

namespace mdof::algo {

// Lower triangular matrix L, row-major, with L Lᵀ = matrix. Error: the matrix is not positive
// definite; the message contains the smallest eigenvalue.
Result<std::vector<double>> cholesky_factor(const PlannedCorrelation& group);

}  // namespace mdof::algo
