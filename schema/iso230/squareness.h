// Squareness of two axes. It is calculated from one run of each axis with the same square target
// (Fig. 6 of the paper in algo/README.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "schema/axis.h"

namespace mdof {

// Two axes in the order X, Y, Z.
struct AxisPair {
  Axis a = Axis::x, b = Axis::y;
  bool operator==(const AxisPair&) const = default;
};

// Returns "EC0Y", "EB0Z" or "EA0Z" (ISO 230-1). The squareness error is the rotation of the axis b
// from the perpendicular to the axis a, with the sign of the right-hand rule.
const char* squareness_name(AxisPair axes);
// Returns +1 if the angle from +a to +b is 90° + the error (EC0Y, EA0Z), and -1 if it is 90° - the
// error (EB0Z).
int squareness_sign(AxisPair axes);
// Returns for example "the angle from +X to +Y is 90 deg + EC0Y". `degrees` is " deg" or "°".
std::string squareness_sense(AxisPair axes, const std::string& degrees);
// Returns the index in error_names(of) of the straightness error of the axis `of` in the direction
// of the axis `along`. For X in the direction of Y it is the index of EYX.
std::size_t straightness_along(Axis of, Axis along);

// The square artefact. The angle between its two measured faces, inside the material, is 90° +
// angle_error_rad.
struct SquareArtefact {
  double angle_error_rad = 0;
  std::optional<double> u_rad;  // standard uncertainty; absent: not declared
  // Position of the corner at which the two faces meet. +1: at +a +b or at -a -b; -1: at -a +b or
  // at +a -b; 0: unknown.
  int corner = 0;
  bool operator==(const SquareArtefact&) const = default;
};

// Calculates the squareness from the slopes of the straightness of each axis in the direction of
// the other axis; the reference point is the origin of the fixture:
//   EC0Y = -slope(EXY over y) - slope(EYX over x) + corner * artefact angle error
//   EA0Z = -slope(EYZ over z) - slope(EZY over y) + corner * artefact angle error
//   EB0Z =  slope(EXZ over z) + slope(EZX over x) - corner * artefact angle error
// This is the squareness if the square is parallel to the axes; otherwise see
// Squareness::tilt_rad().
double squareness_of(AxisPair axes, double slope_a_rad, double slope_b_rad,
                     const SquareArtefact& artefact);

struct Squareness {
  std::int64_t id = 0;  // 0 until stored
  AxisPair axes;
  std::int64_t run_a = 0, run_b = 0;
  double error_rad = 0;  // EC0Y, EB0Z or EA0Z
  // Combined standard uncertainties, the same as in the budgets. algo::squareness() includes only
  // noise, repeatability and the artefact.
  double u_error_rad = 0;
  // Effect of the straightness deviations of both axes: √(s_a² + s_b²), where s is the standard
  // deviation of a fitted slope, calculated from the residuals of the line. It states how well one
  // angle describes the axes. It is not the uncertainty of this angle.
  double form_rad = 0;
  // Slopes of the straightness of each axis in the direction of the other axis, over the travel of
  // the moving body in the + direction of M.
  double slope_a_rad = 0, u_slope_a_rad = 0;
  double slope_b_rad = 0, u_slope_b_rad = 0;
  SquareArtefact artefact;
  bool simulated = false;
  std::string created_utc;
  bool operator==(const Squareness&) const = default;

  // Part of error_rad that squareness_of() does not contain: the effect of second order of a tilted
  // square (algo/iso230/square_tilt.h).
  double tilt_rad() const {
    return error_rad - squareness_of(axes, slope_a_rad, slope_b_rad, artefact);
  }
  // Names of the two straightness errors, for example "EYX" and "EXY".
  const char* straightness_a() const {
    return error_names(axes.a)[straightness_along(axes.a, axes.b)].name;
  }
  const char* straightness_b() const {
    return error_names(axes.b)[straightness_along(axes.b, axes.a)].name;
  }
};

}  // namespace mdof
