// Correlated quantities: a Gaussian copula. Independent normal scores are mixed by the Cholesky
// factor of the correlation matrix; each quantity then takes the quantile of its own distribution
// at its score. Normal quantities are jointly normal with exactly this correlation (JCGM 101
// §6.4.8); others have it between their scores.
#pragma once

#include <span>
#include <vector>

#include "schema/base/result.h"
#include "schema/study/plan.h"

namespace mdof::algo {

// Lower triangular L, row-major, L Lᵀ = matrix. Refuses one that is not positive definite, with its
// smallest eigenvalue.
Result<std::vector<double>> cholesky_factor(const PlannedCorrelation& group);

}  // namespace mdof::algo
