#include "algo/uncertainty/statistics/common_quantities.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

namespace mdof::algo {
namespace {

constexpr std::array<std::string_view, 6> kOfProbes = {"u_sensitivity_ppm", "u_linearity_um",
                                                       "u_tilt_factor",     "tilt_factor",
                                                       "linearity",         "polynomial_um"};

// Converts footprints to the axes of the machine. Runs along different axes then have the same
// frame.
PlaneFootprints in_machine_axes(const PlaneFootprints& local, Axis axis) {
  const auto axes = local_axes(axis);
  const auto turned = [&](const Eigen::Vector3d& v) {
    Eigen::Vector3d out = Eigen::Vector3d::Zero();
    for (std::size_t m = 0; m < 3; ++m)
      for (std::size_t l = 0; l < 3; ++l)
        out(static_cast<Eigen::Index>(m)) += axes[m][l] * v(static_cast<Eigen::Index>(l));
    return out;
  };
  PlaneFootprints out = local;
  for (Footprint& footprint : out.footprints)
    footprint = {turned(footprint.place), turned(footprint.zero)};
  return out;
}

}  // namespace

ContributorName flatness_name(const Rig& rig, const TargetPlane& plane) {
  const auto place = static_cast<std::size_t>(&plane - rig.planes.data());
  return {ContributorKind::plane_flatness, plane.id.empty() ? std::to_string(place + 1) : plane.id};
}

void name_common_surfaces(const Rig& rig, std::vector<Contributor>& list) {
  for (Contributor& contributor : list)
    for (const TargetPlane& plane : rig.planes) {
      if (!contributor.surface || contributor.name != flatness_name(rig, plane)) continue;
      contributor.surface_as = contributor_text(contributor.name);
      for (const double x : plane.normal) contributor.surface_as += " " + std::to_string(x);
      for (const double x :
           {contributor.declared.u * contributor.to_unit, contributor.surface->length_m})
        contributor.surface_as += " " + std::to_string(x);
    }
}

void name_probe_correlations(const Rig& rig, std::vector<Contributor>& list) {
  for (Contributor& contributor : list) {
    if (std::find(kOfProbes.begin(), kOfProbes.end(), contributor.key) == kOfProbes.end()) continue;
    for (const Probe& probe : rig.probes)
      if (contributor.name.subject == probe.id)
        contributor.common_as =
            contributor_text(contributor.name) + " " + probe.calibration.certificate;
  }
}

TwoRunParts parts_of_both_runs(std::vector<Contributor>& of_a, Axis along_a,
                               std::vector<Contributor>& of_b, Axis along_b) {
  TwoRunParts parts;
  parts.a.resize(of_a.size());
  parts.b.resize(of_b.size());
  for (std::size_t i = 0; i < of_a.size(); ++i)
    for (std::size_t k = 0; k < of_b.size(); ++k) {
      if (!of_a[i].surface || !of_b[k].surface || of_a[i].surface_as != of_b[k].surface_as)
        continue;
      const PlaneFootprints a = in_machine_axes(*of_a[i].surface, along_a);
      const PlaneFootprints b = in_machine_axes(*of_b[k].surface, along_b);
      auto both = flatness_parts({&a, &b});
      of_a[i].common_as = of_b[k].common_as = of_a[i].surface_as;
      parts.a[i] = std::move(both[0]);
      parts.b[k] = std::move(both[1]);
    }
  for (std::size_t i = 0; i < of_a.size(); ++i)
    if (parts.a[i].empty()) parts.a[i] = of_a[i].parts();
  for (std::size_t k = 0; k < of_b.size(); ++k)
    if (parts.b[k].empty()) parts.b[k] = of_b[k].parts();
  return parts;
}

}  // namespace mdof::algo
