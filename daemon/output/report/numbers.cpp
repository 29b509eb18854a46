#include "daemon/output/report/numbers.h"

#include "daemon/output/charts/labels.h"

namespace mdof::report {

std::string value_with_u(double value, double u) {
  return value_text(value, u) + "\u00a0±\u00a0" + uncertainty_text(u);
}

std::string key_unit(const std::string& key) {
  return charts::split_key(key).unit;
}

}  // namespace mdof::report
