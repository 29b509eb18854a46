#include "algo/uncertainty/statistics/common_quantities.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace mdof::algo {
namespace {

constexpr std::array<std::string_view, 6> kOfProbes = {"u_sensitivity_ppm", "u_linearity_um",
                                                       "u_tilt_factor",     "tilt_factor",
                                                       "linearity",         "polynomial_um"};

}  // namespace

void name_what_goes_with_probes(const Rig& rig, std::vector<Contributor>& list) {
  for (Contributor& contributor : list) {
    if (std::find(kOfProbes.begin(), kOfProbes.end(), contributor.key) == kOfProbes.end()) continue;
    for (const Probe& probe : rig.probes)
      if (contributor.name.starts_with("probe " + probe.id + ": "))
        contributor.common_as = contributor.name + " " + probe.calibration.certificate + " " +
                                std::to_string(contributor.declared.u * contributor.to_unit);
  }
}

}  // namespace mdof::algo
