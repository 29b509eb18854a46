#include "algo/iso230/line_fit.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace mdof::algo {

bool can_fit(std::span<const double> x) {
  return std::any_of(x.begin(), x.end(), [&](double v) { return v != x.front(); });
}

Line least_squares_line(std::span<const double> x, std::span<const double> y) {
  assert(x.size() == y.size() && can_fit(x));
  const auto n = static_cast<double>(x.size());
  double x_mean = 0, y_mean = 0;
  for (const double v : x) x_mean += v;
  for (const double v : y) y_mean += v;
  x_mean /= n;
  y_mean /= n;
  double sxx = 0, sxy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sxx += (x[i] - x_mean) * (x[i] - x_mean);
    sxy += (x[i] - x_mean) * (y[i] - y_mean);
  }
  Line line;
  line.slope = sxy / sxx;
  line.intercept = y_mean - line.slope * x_mean;
  if (x.size() > 2) {
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double left = (y[i] - y_mean) - line.slope * (x[i] - x_mean);
      sum += left * left;
    }
    line.residual_sd = std::sqrt(sum / (n - 2));
    line.u_slope = line.residual_sd / std::sqrt(sxx);
    line.u_intercept = line.residual_sd * std::sqrt(1 / n + x_mean * x_mean / sxx);
  }
  return line;
}

Line end_point_line(std::span<const double> x, std::span<const double> y) {
  assert(x.size() == y.size() && can_fit(x));
  Line line;
  line.slope = (y.back() - y.front()) / (x.back() - x.front());
  line.intercept = y.front() - line.slope * x.front();
  return line;
}

Deviations deviations_from(const Line& line, std::span<const double> x, std::span<const double> y) {
  Deviations d;
  double high = 0, low = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double left = y[i] - line.at(x[i]);
    if (i == 0 || left > high) {
      high = left;
      d.peak = i;
    }
    if (i == 0 || left < low) {
      low = left;
      d.valley = i;
    }
  }
  d.peak_to_valley = high - low;
  return d;
}

}  // namespace mdof::algo
