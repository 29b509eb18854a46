// Kinematics of a co-planar machine with tilt drives (Wang et al., "co-planar multi-DOF micro
// machine tool"): screws A, B and C move the platform along X and Z and turn it about Y; screw D
// moves the spindle seat along Y. README.md has the equations and the corrections of the paper's
// misprints. m, rad.
#pragma once

#include <array>
#include <cstddef>

#include "schema/base/result.h"

namespace mdof::algo {

struct CoPlanarDrive {
  double tilt_rad = 0;  // angle between a screw and its sliding rod, between 0 and π/2
  double arm_m = 0;     // from the platform's centre to the rods that turn it
};

// Position (m or rad) and its first and second time derivatives.
struct Motion {
  double position = 0, velocity = 0, acceleration = 0;
};
enum PlatformAxis : std::size_t { kPlatformX, kPlatformY, kPlatformZ, kPlatformB };
enum Screw : std::size_t { kScrewA, kScrewB, kScrewC, kScrewD };
using PlatformMotion = std::array<Motion, 4>;  // X, Y, Z (m), B (rad)
using ScrewMotion = std::array<Motion, 4>;     // A, B, C, D (m)

// Error: an angle of ±90° or more, which the arms cannot reach.
Result<ScrewMotion> screws_for(const CoPlanarDrive& drive, const PlatformMotion& platform);
// Error: screws A and C so far apart that sin B would reach 1.
Result<PlatformMotion> platform_for(const CoPlanarDrive& drive, const ScrewMotion& screws);

// Motion of the platform (X and Z) or of the spindle seat (Y), divided by the motion of the screw.
double platform_ratio(const CoPlanarDrive& drive);
double spindle_ratio(const CoPlanarDrive& drive);

// The rotation of the platform, from `angle_rad` in the + direction, by one step of the screws (Eq.
// 5 and 6 of the paper). Error: the arm cannot turn by the whole step.
Result<double> rotation_step(const CoPlanarDrive& drive, double angle_rad, double screw_step_m);

// Change of the position of the platform (X) or of the spindle seat (Y) by an error δθ of the tilt
// angle θ, while the screw does not move. `travel_m` is X or Y:
//   platform: -X tan θ δθ
//   spindle seat: Y δθ / (sin θ cos θ)
double platform_tilt_effect(const CoPlanarDrive& drive, double travel_m, double tilt_error_rad);
double spindle_tilt_effect(const CoPlanarDrive& drive, double travel_m, double tilt_error_rad);

}  // namespace mdof::algo
