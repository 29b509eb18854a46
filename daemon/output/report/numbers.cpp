#include "daemon/output/report/numbers.h"

#include <algorithm>
#include <cmath>

#include "daemon/output/charts/labels.h"

namespace mdof::report {
namespace {

int decimals_of(double u) {
  return std::clamp(1 - charts::decimal_exponent(u), 0, 9);
}

}  // namespace

std::string uncertainty_text(double u) {
  if (u == 0) return "0";
  return u > 0 && std::isfinite(u) ? charts::fixed_text(u, decimals_of(u)) : "–";
}

std::string value_text(double value, double u) {
  return u > 0 && std::isfinite(u) ? charts::fixed_text(value, decimals_of(u))
                                   : charts::number_text(value);
}

std::string value_with_u(double value, double u) {
  return value_text(value, u) + "\u00a0±\u00a0" + uncertainty_text(u);
}

std::string key_unit(const std::string& key) {
  return charts::split_key(key).unit;
}

}  // namespace mdof::report
