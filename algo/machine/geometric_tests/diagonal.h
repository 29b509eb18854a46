// Diagonals of the machine (ISO 230-6): prediction by the chain, and squareness from measured
// diagonals.
#pragma once

#include <span>

#include "algo/machine/plane_map.h"

namespace mdof::algo {

// One diagonal of a plane, from corner to corner in equal steps. The deviation is the error of the
// tool along the diagonal, minus the error at its first point.
struct Diagonal {
  std::string name;                // "X+Y+": the directions of the commands
  std::vector<double> position_m;  // along the diagonal, from its first corner
  std::vector<double> deviation_m;
  double range_m = 0;  // E_D of ISO 230-6 for one approach: largest minus smallest deviation
  std::vector<std::string> not_measured, beyond;
};
// Both diagonals of the plane of two axes. Errors: as plane_map().
Result<std::vector<Diagonal>> plane_diagonals(const Machine& machine, std::size_t first,
                                              std::size_t second, std::size_t steps,
                                              MachineApproach approach);

// Repeated measurements of the length of one line, m.
struct MeasuredLine {
  std::vector<double> length_m;
};
struct DiagonalSquareness {
  double angle_error_rad = 0;  // angle between the axes - 90° (EC0Y for X and Y)
  double u_rad = 0, U_rad = 0, k = 0, freedom = 0;
  double u_repeat_rad = 0;     // contribution of the repeatability to u_rad
  bool two_diagonals = false;  // true: Pe was given; errors of Px and Py have hardly any effect
};
// The angle θ12 between the axes by the law of cosines. Px and Py are the lengths along the axes.
// Pd is the length of the diagonal from (0, 0) to (Px, Py), Pe that from (Px, 0) to (0, Py). Eq. 2
// of Hwang, Song and Park for Pd only, and the mean of both diagonals if Pe is also given:
//   cos θ12 = (Pd² - Px² - Py²) / (2 Px Py),   cos θ12 = (Pd² - Pe²) / (4 Px Py)
// The uncertainty includes the repeatability and the declared u_line_m of each line. If a line was
// measured only once, the repeatability is estimated from all lines together. Degrees of freedom by
// Welch-Satterthwaite. A scale error that all lines have in common does not change the angle.
// Errors: a line without a length; lengths that do not fit nearly square axes; no uncertainty.
struct DiagonalLines {
  MeasuredLine first, second, diagonal, other;  // `other` (Pe) may be empty
  double u_line_m = 0;                          // declared u of each line, independent
};
Result<DiagonalSquareness> squareness_from_diagonals(const DiagonalLines& lines);

}  // namespace mdof::algo
