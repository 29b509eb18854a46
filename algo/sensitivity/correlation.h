// Correlated quantities by a Gaussian copula. The Cholesky factor of the correlation matrix mixes
// independent normal scores; each quantity then takes the quantile of its own distribution at its
// score. Normal quantities are jointly normal with exactly this correlation (JCGM 101 §6.4.8); for
// other distributions the scores have this correlation.
#pragma once

#include <span>
#include <vector>

#include "schema/base/result.h"
#include "schema/study/plan.h"

namespace mdof::algo {

// Lower triangular L, row-major, L Lᵀ = matrix. Error: a matrix that is not positive definite, with
// its smallest eigenvalue.
Result<std::vector<double>> cholesky_factor(const PlannedCorrelation& group);

}  // namespace mdof::algo
