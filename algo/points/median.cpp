#include "algo/points/median.h"

#include <algorithm>

#include "schema/sample.h"

namespace mdof::algo {

double median_of(std::vector<double> values) {
  if (values.empty()) return kNaN;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace mdof::algo
