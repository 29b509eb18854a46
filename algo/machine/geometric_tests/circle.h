// The circular test (ISO 230-4): prediction from the errors of the machine, and evaluation.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "algo/machine/tool_error.h"

namespace mdof::algo {

// Radial deviations (actual radius - nominal radius, m) by the angle of the commands about the
// centre. The angle, and the counter-clockwise path, go from the first axis of the plane towards
// the second.
struct CircularPath {
  std::vector<double> angle_rad;
  std::vector<double> ccw_m, cw_m;  // one of them may be empty: not measured
};

// Figures of ISO 230-4:2005, about least-squares circles; NaN where a path is missing.
//   G    circular deviation: range of the radial deviations about the circle of that path alone
//   Gb   bi-directional circular deviation: range of both paths about their common circle
//   H    circular hysteresis: largest distance of the two paths at an angle
//   D    mean bi-directional radial deviation: radius of the common circle - nominal radius
//   F    radial deviations, largest and smallest of a path, about the centre of the circle of all
//        measured paths
struct CircularFigures {
  double G_ccw_m = 0, G_cw_m = 0, Gb_m = 0, H_m = 0, D_m = 0;
  std::array<double, 2> F_ccw_m{}, F_cw_m{};  // largest, smallest
  // Centre of the circle of F, along the two axes: an offset of the set-up.
  std::array<double, 2> centre_m{};
};

// The circle is the fit of r + a cos + b sin, to first order in the deviations. If its centre is c
// beside the nominal one, the error is at most c² / (2 R): 6 nm for 50 µm at R = 200 mm, 63 nm at
// 20 mm. Errors: no path, fewer than 8 angles, a gap of more than a quarter of the circle,
// different lengths.
Result<CircularFigures> circular_figures(const CircularPath& path);
// The deviations relative to the centre of the figures.
CircularPath centred(const CircularPath& path, const CircularFigures& figures);

struct CircleRequest {
  std::size_t first = 0, second = 1;  // directions of the axes of the plane
  Command centre{};                   // centre of the circle, and commands of the other axes
  double radius_m = 0;
  std::size_t angles = 360;
};
struct PredictedCircle {
  CircularPath path;
  std::vector<std::string> not_measured, beyond;
};
// The deviations that a ball bar measures between the tool and a ball on the work; the ball is at
// the place of the tool at the centre. By the full product of the frames, with the errors of each
// axis for its direction of motion. Error: an axis that the chain does not have; a radius of 0 or
// less or above 10 m; fewer than 8 angles or more than 100,000.
Result<PredictedCircle> predicted_circle(const Machine& machine, const CircleRequest& request);

}  // namespace mdof::algo
