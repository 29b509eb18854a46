#include "schema/separation/separation.h"

#include <algorithm>

namespace mdof {

double DeterminedSeries::zone_m() const {
  if (seen_m.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto [least, most] = std::minmax_element(seen_m.begin(), seen_m.end());
  return *most - *least;
}

}  // namespace mdof
