// Straight lines through measured points.
#pragma once

#include <cstddef>
#include <span>

namespace mdof::algo {

struct Line {
  double intercept = 0, slope = 0;
  double u_intercept = 0, u_slope = 0;  // standard uncertainties from the residuals
  double residual_sd = 0;
  double at(double x) const { return intercept + slope * x; }
};

// Fits a line by ordinary least squares. The sums are about the means and in the order of the
// points. The residuals have n - 2 degrees of freedom. x and y have the same length, and x has at
// least two different values (asserted; callers check this with can_fit()).
Line least_squares_line(std::span<const double> x, std::span<const double> y);
bool can_fit(std::span<const double> x);

// Returns the line through the first and the last point (ISO 230-1 end-point reference line).
Line end_point_line(std::span<const double> x, std::span<const double> y);

struct Deviations {
  double peak_to_valley = 0;
  std::size_t peak = 0, valley = 0;  // indices
};
Deviations deviations_from(const Line& line, std::span<const double> x, std::span<const double> y);

}  // namespace mdof::algo
