// The circular test (ISO 230-4): evaluation of measured paths, and prediction of the paths from the
// errors of the machine.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "algo/machine/tool_error.h"

namespace mdof::algo {

// Radial deviations (actual radius - nominal radius) for each angle of the commands about the
// centre. Angles and the counter-clockwise path go from the first axis of the plane towards the
// second axis.
struct CircularPath {
  std::vector<double> angle_rad;
  std::vector<double> ccw_m, cw_m;  // counter-clockwise and clockwise; empty if this path was not
                                    // measured
};

// Figures of ISO 230-4:2005, about least-squares circles. NaN if a necessary path is missing.
//   G    circular deviation: range of the radial deviations of one path about its own circle
//   Gb   bi-directional circular deviation: range of the radial deviations of both paths about
//     their common circle
//   H    circular hysteresis: largest distance between the two paths at the same angle
//   D    mean bi-directional radial deviation: radius of the common circle - nominal radius
//   F    largest and smallest radial deviation of a path about the centre of the circle of all
//        measured paths
struct CircularFigures {
  double G_ccw_m = 0, G_cw_m = 0, Gb_m = 0, H_m = 0, D_m = 0;
  std::array<double, 2> F_ccw_m{}, F_cw_m{};  // largest, smallest
  // Centre to which F refers, along the two axes. It is an offset of the set-up.
  std::array<double, 2> centre_m{};
};

// Fits each circle as r + a cos(angle) + b sin(angle) to the deviations. This linear fit neglects
// at most c² / (2 R), where c is the distance of the fitted centre from the nominal centre and R
// the radius. For c = 50 µm this is 6 nm at R = 200 mm, and 63 nm at R = 20 mm. Errors: no path;
// fewer than 8 angles; a gap of more than a quarter of the circle; different numbers of angles and
// deviations.
Result<CircularFigures> circular_figures(const CircularPath& path);
// The radial deviations about the centre figures.centre_m.
CircularPath centred(const CircularPath& path, const CircularFigures& figures);

struct CircleRequest {
  std::size_t first = 0, second = 1;  // the axes of the plane: 0 X, 1 Y, 2 Z
  Command centre{};                   // centre of the circle, and commands of the other axes
  double radius_m = 0;
  std::size_t angles = 360;
};
struct PredictedCircle {
  CircularPath path;
  std::vector<std::string> not_measured, beyond;
};
// Predicts the deviations that a ball bar measures between the tool and a ball on the work. The
// place of the ball is the place of the tool at the centre of the circle. Uses the full product of
// the frames. Each axis has the errors of the approach in its direction of motion. Errors: an axis
// that the chain does not have; a radius of 0 or less, or above 10 m; fewer than 8 angles, or more
// than 100,000; a rotary axis that makes an ellipse from the circle.
Result<PredictedCircle> predicted_circle(const Machine& machine, const CircleRequest& request);

}  // namespace mdof::algo
