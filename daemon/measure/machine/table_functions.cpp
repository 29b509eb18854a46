#include "daemon/measure/machine/table_functions.h"

#include <cmath>

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
    f.u.push_back(std::isfinite(u[i]) ? u[i] : 0);
    f.u_independent.push_back(std::isfinite(u_noise[i]) ? u_noise[i] : 0);
  }
  return f;
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

}  // namespace mdof::daemon
