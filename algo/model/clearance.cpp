#include "algo/model/clearance.h"

#include <algorithm>
#include <cmath>

#include "algo/model/fixture.h"
#include "schema/base/number/number_text.h"
#include "schema/rig/effects/physics.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

// A smaller motion along the probe, divided by the travel, counts as 0 (100 um in one metre).
constexpr double kParallelShare = 1e-4;

// Returns the motion of the surface along the measuring line of the probe, divided by the travel of
// the target in the + direction of a machine axis.
double approach_of(const FixtureProbe& probe, const Vec3& along) {
  const Eigen::Vector3d v(along[0], along[1], along[2]);
  return probe.n_C.dot(v) / probe.n_C.dot(probe.u_M);
}

ApproachedProbe probe_clearance(const Rig& rig, std::size_t k, double approach) {
  const Probe& probe = rig.probes[k];
  const auto [low_um, high_um] = readings_of_range(probe);  // 0 at the nominal surface
  const double range_m = from_um(std::max(0.0, std::min(-low_um, high_um)));
  ApproachedProbe out{probe.id, range_m / std::abs(approach), {}, 0};
  if (probe.standoff_m > 0) out.contact_m = probe.standoff_m / std::abs(approach);
  // If the standoff is known or the probe reads a gap, the direction of the probe points from the
  // surface to the probe.
  if (probe.standoff_m > 0 || probe.calibration.reads_gap) out.towards = approach > 0 ? 1 : -1;
  return out;
}

std::string um(double m) {
  return plain_number(to_um(m)) + " um";
}

}  // namespace

Result<std::array<MotionClearance, 3>> motion_clearances(const Rig& rig) {
  MDOF_TRY(const Fixture fixture, make_fixture(rig));
  std::array<MotionClearance, 3> all;
  for (std::size_t a = 0; a < 3; ++a) {
    all[a].axis = static_cast<Axis>(a);
    Vec3 along{};
    along[a] = 1;
    along = to_local(rig.axis, along);
    for (std::size_t k = 0; k < fixture.probes.size(); ++k) {
      const double approach = approach_of(fixture.probes[k], along);
      if (std::abs(approach) > kParallelShare)
        all[a].probes.push_back(probe_clearance(rig, k, approach));
    }
  }
  return all;
}

std::string clearance_text(const MotionClearance& motion) {
  const std::string axis(1, letter(motion.axis));
  if (motion.probes.empty())
    return axis +
           " does not move the target towards any probe. But if the target is tilted, the motion "
           "changes the gaps: by 1 um for each mm of travel if the tilt is 1 mrad";
  std::string ids, senses, contact;
  double least_m = motion.probes.front().range_m;
  for (const ApproachedProbe& probe : motion.probes) {
    ids += (ids.empty() ? "" : ", ") + probe.id;
    least_m = std::min(least_m, probe.range_m);
    senses += (senses.empty() ? "" : ", ") + probe.id +
              (probe.towards == 0  ? " in both directions"
               : probe.towards > 0 ? " along +" + axis
                                   : " along -" + axis);
    if (probe.contact_m)
      contact += (contact.empty() ? "; contact with " : ", ") + probe.id + " after " +
                 um(*probe.contact_m);
  }
  return "HAZARD: " + axis + " drives the target's face into the probes " + ids + " (" + senses +
         "): the measuring range ends after " + um(least_m) + contact +
         "; stop the axis, and remove these probes before you move the axis further";
}

}  // namespace mdof::algo
