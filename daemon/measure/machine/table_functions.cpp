#include "daemon/measure/machine/table_functions.h"

#include <cmath>
#include <string_view>

#include "schema/sample.h"

namespace mdof::daemon {

ErrorFunction function_of(const std::vector<double>& position, const std::vector<double>& forward,
                          const std::vector<double>& reverse, const std::vector<double>& u,
                          const std::vector<double>& u_noise) {
  ErrorFunction f;
  for (std::size_t i = 0; i < position.size(); ++i) {
    const bool has_forward = std::isfinite(forward[i]), has_reverse = std::isfinite(reverse[i]);
    if (!has_forward && !has_reverse) continue;
    f.position.push_back(position[i]);
    f.forward.push_back(has_forward ? forward[i] : reverse[i]);
    f.reverse.push_back(has_reverse ? reverse[i] : forward[i]);
    f.u.push_back(u[i]);
    f.u_independent.push_back(std::isfinite(u_noise[i]) ? u_noise[i] : 0);
  }
  double largest = kNaN;
  for (const double each : f.u) largest = std::fmax(largest, each);
  if (!std::isfinite(largest)) {
    f.u.clear();
    f.u_independent.clear();
  }
  for (double& each : f.u)
    if (!std::isfinite(each)) each = largest;
  return f;
}

void refer_angle(ErrorFunction& f, double zero_m) {
  if (f.position.empty() || zero_m <= f.position.front()) return;
  std::size_t above = 0;
  while (above + 1 < f.position.size() && f.position[above] < zero_m) ++above;
  const std::size_t below = above > 0 ? above - 1 : 0;
  const double step = f.position[above] - f.position[below];
  const double share = step > 0 ? std::fmin(1, (zero_m - f.position[below]) / step) : 1;
  const auto there = [&](const auto& value) {
    return value(below) + (value(above) - value(below)) * share;
  };
  const double mean = there([&](std::size_t i) { return (f.forward[i] + f.reverse[i]) / 2; });
  for (auto* values : {&f.forward, &f.reverse})
    for (double& x : *values) x -= mean;
  if (f.u.empty()) return;
  const double u = there([&](std::size_t i) { return f.u[i]; });
  for (double& x : f.u) x = std::hypot(x, u);
}

std::vector<double> larger(const std::vector<double>& forward, const std::vector<double>& reverse) {
  std::vector<double> u = forward;
  for (std::size_t i = 0; i < u.size(); ++i) u[i] = std::fmax(u[i], reverse[i]);
  return u;
}

std::vector<double> scaled(std::vector<double> values, double by) {
  for (double& x : values) x *= by;
  return values;
}

std::size_t body_error_of(const CompensationTable& table, std::size_t named) {
  return std::string_view("XYZABC").find(error_names(table.axis)[named].name[1]);
}

ErrorCorrelation correlation_of(const CompensationTable& table,
                                const std::vector<Covariance5>& by_row) {
  ErrorCorrelation correlation;
  correlation.position = table.position_m;
  for (const Covariance5& named : by_row) {
    auto& at = correlation.at.emplace_back();
    for (std::size_t k = 0; k < kBodyErrors; ++k) at[k][k] = 1;
    for (std::size_t k = 0; k < kErrorCount; ++k)
      for (std::size_t l = 0; l < kErrorCount; ++l)
        at[body_error_of(table, k)][body_error_of(table, l)] = named[k * kErrorCount + l];
  }
  return correlation;
}

bool is_beyond(const std::vector<double>& position_m, double at_m) {
  const std::size_t n = position_m.size();
  return n > 1 && (at_m < 2 * position_m[0] - position_m[1] ||
                   at_m > 2 * position_m[n - 1] - position_m[n - 2]);
}

}  // namespace mdof::daemon
