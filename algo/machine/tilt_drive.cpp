#include "algo/machine/tilt_drive.h"

#include <cmath>

namespace mdof::algo {
namespace {

Motion operator+(const Motion& a, const Motion& b) {
  return {a.position + b.position, a.velocity + b.velocity, a.acceleration + b.acceleration};
}
Motion operator*(double factor, const Motion& a) {
  return {factor * a.position, factor * a.velocity, factor * a.acceleration};
}

// Motion of the end of the arm: arm sin B and its time derivatives.
Motion arm_end(double arm_m, const Motion& b) {
  const double s = std::sin(b.position), c = std::cos(b.position);
  return {arm_m * s, arm_m * c * b.velocity,
          arm_m * (c * b.acceleration - s * b.velocity * b.velocity)};
}

// Solves arm sin B = end for the angle B and its time derivatives.
Result<Motion> arm_angle(double arm_m, const Motion& end) {
  const double s = end.position / arm_m;
  if (!(std::abs(s) < 1))
    return bad_input("screws A and C: sin B would be " + std::to_string(s) +
                     " (limit 1); the difference between the screws A and C, times cos(tilt), must "
                     "be less than twice the length of the arm");
  const double b = std::asin(s), c = std::cos(b), speed = end.velocity / (arm_m * c);
  return Motion{b, speed, (end.acceleration / arm_m + speed * speed * s) / c};
}

}  // namespace

double platform_ratio(const CoPlanarDrive& drive) {
  return std::cos(drive.tilt_rad);
}
double spindle_ratio(const CoPlanarDrive& drive) {
  return std::tan(drive.tilt_rad);
}

Result<ScrewMotion> screws_for(const CoPlanarDrive& drive, const PlatformMotion& platform) {
  const double quarter_turn = std::acos(0.0);
  if (!(std::abs(platform[kPlatformB].position) < quarter_turn))
    return bad_input("B: must be between -90 and 90 degrees, the range of the arms");
  const Motion end = arm_end(drive.arm_m, platform[kPlatformB]);
  const double per_screw = 1 / platform_ratio(drive);
  ScrewMotion screws;
  screws[kScrewA] = per_screw * (platform[kPlatformZ] + end);
  screws[kScrewB] = per_screw * (platform[kPlatformX] + end);
  screws[kScrewC] = per_screw * (platform[kPlatformZ] + -1.0 * end);
  screws[kScrewD] = (1 / spindle_ratio(drive)) * platform[kPlatformY];
  return screws;
}

Result<PlatformMotion> platform_for(const CoPlanarDrive& drive, const ScrewMotion& screws) {
  const double ratio = platform_ratio(drive);
  const Motion end = (ratio / 2) * (screws[kScrewA] + -1.0 * screws[kScrewC]);
  PlatformMotion platform;
  MDOF_TRY(platform[kPlatformB], arm_angle(drive.arm_m, end));
  platform[kPlatformX] = ratio * screws[kScrewB] + -1.0 * end;
  platform[kPlatformZ] = (ratio / 2) * (screws[kScrewA] + screws[kScrewC]);
  platform[kPlatformY] = spindle_ratio(drive) * screws[kScrewD];
  return platform;
}

Result<double> rotation_step(const CoPlanarDrive& drive, double angle_rad, double screw_step_m) {
  const double step = screw_step_m * platform_ratio(drive) / drive.arm_m;
  const double end = std::sin(angle_rad) + step;
  if (!(std::abs(end) <= 1))
    return bad_input(
        "at " + std::to_string(angle_rad * 90 / std::acos(0.0)) +
        " degrees, one more step of the screws would turn the arm beyond the limit of 90 degrees");
  return std::asin(end) - angle_rad;
}

double platform_tilt_effect(const CoPlanarDrive& drive, double travel_m, double tilt_error_rad) {
  return -travel_m * std::tan(drive.tilt_rad) * tilt_error_rad;
}

double spindle_tilt_effect(const CoPlanarDrive& drive, double travel_m, double tilt_error_rad) {
  return travel_m * tilt_error_rad / (std::sin(drive.tilt_rad) * std::cos(drive.tilt_rad));
}

}  // namespace mdof::algo
