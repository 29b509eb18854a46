// Covariances of the quantities that were determined by the same calibration.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace mdof {

// Names of the quantities of a probe A:
// - "A.x": position along X, m
// - "A.zero": displacement that the probe reads at the nominal surface, m
// - "A.nx": component of the direction along X, rad
struct CalibrationCovariance {
  std::vector<std::string> of;
  // symmetric; one row and one column for each name, in the units above
  std::vector<std::vector<double>> m2;

  void erase(const std::string& quantity) {
    const auto at = std::find(of.begin(), of.end(), quantity);
    if (at == of.end()) return;
    const auto i = at - of.begin();
    of.erase(at);
    m2.erase(m2.begin() + i);
    for (auto& row : m2) row.erase(row.begin() + i);
  }
};
inline std::string place_name(const std::string& probe, std::size_t axis) {
  return probe + "." + std::string(1, "xyz"[axis]);
}
inline std::string direction_name(const std::string& probe, std::size_t axis) {
  return probe + ".n" + std::string(1, "xyz"[axis]);
}
inline std::string zero_name(const std::string& probe) {
  return probe + ".zero";
}

}  // namespace mdof
