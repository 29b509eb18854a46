// Diagonals of the machine: as the chain predicts them (ISO 230-6), and squareness from measured
// ones.
#pragma once

#include <span>

#include "algo/machine/plane_map.h"

namespace mdof::algo {

// Of a plane from one corner to the other, in equal steps; the deviation is the error of the tool
// along the diagonal, less that at its first point.
struct Diagonal {
  std::string name;                // "X+Y+": the ways that the commands go
  std::vector<double> position_m;  // along it, from its first corner
  std::vector<double> deviation_m;
  double range_m = 0;  // E_D of ISO 230-6 for one approach: largest less smallest
  std::vector<std::string> not_measured, beyond;
};
// Both of the plane of two axes. Errors as of plane_map().
Result<std::vector<Diagonal>> plane_diagonals(const Machine& machine, std::size_t first,
                                              std::size_t second, std::size_t steps,
                                              MachineApproach approach);

// Repeated measurements of one line: lengths over which the machine moved, m.
struct MeasuredLine {
  std::vector<double> length_m;
};
struct SquarenessOfDiagonals {
  double angle_error_rad = 0;  // angle between the axes - 90°: EC0Y of X and Y
  double u_rad = 0, U_rad = 0, k = 0, freedom = 0;
  double u_repeat_rad = 0;     // of it by repetition
  bool two_diagonals = false;  // then the lengths of the axes hardly count
};
// The angle between the axes by the law of cosines: Eq. 2 of Hwang, Song and Park of one diagonal
// from (0, 0) to (Px, Py), the mean of both where the other, from (Px, 0) to (0, Py), is there too:
//   cos θ12 = (Pd² - Px² - Py²) / (2 Px Py),   cos θ12 = (Pd² - Pe²) / (4 Px Py)
// Uncertainty: of each line by repetition, where a line was read once by that of all lines
// together, and the declared u_line of its length; degrees of freedom by Welch-Satterthwaite. An
// error of the scale that all lines have in common turns nothing. Errors: a line without a reading,
// lengths that no triangle has, no uncertainty at all.
struct DiagonalLines {
  MeasuredLine first, second, diagonal, other;  // other may be empty
  double u_line_m = 0;                          // of each line on its own, declared
};
Result<SquarenessOfDiagonals> squareness_of_diagonals(const DiagonalLines& lines);

}  // namespace mdof::algo
