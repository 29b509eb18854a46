// The study of Hwang, Song and Park (An evaluation method for two-dimensional position errors and
// assembly errors of a rotational table on a 4 axis machine tool) as a whole, on a simulated
// machine of that kind. Each instrument reads the machine with noise of its own; what the study
// then says is made of these readings alone, as in a workshop.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "algo/machine/geometric_tests/diagonal.h"
#include "algo/machine/geometric_tests/perpendicularity.h"
#include "schema/base/result.h"
#include "schema/volumetric/volumetric_table.h"

namespace mdof::algo {

// Standard deviation of the noise of one reading.
struct GroovingInstruments {
  double position_m = 50e-9;   // laser interferometer along an axis, straightness optics
  double square_rad = 0.3e-6;  // optical square, put up anew
  double line_m = 100e-9;      // along a line or a diagonal, mirrors put up anew
  double height_m = 20e-9;     // indicator over the table
  double tilt_rad = 0.1e-6;    // level on the table
  std::size_t repeats = 5;     // of each reading
};

// C and Y carry the work, X the tool; 400 mm x 400 mm. The sizes of its errors, the yaw of Y among
// them, are chosen so that the plane and the diagonals are near the paper's figures. Positions,
// straightness in both directions, angles, squareness of all.
Machine grooving_machine();

// Largest less smallest over the plane, m.
struct PlaneRange {
  double x_m = 0, y_m = 0;
};
struct DiagonalRange {
  std::string name;         // "X+Y+"
  double predicted_m = 0;   // Eq. 1 along it
  double measured_m = 0;    // ISO 230-6: E of the mean of the repeats
  double difference_m = 0;  // the largest of measured - predicted
};
struct GroovingState {
  Machine found;  // positions, straightness and squareness as they were read
  double angle_error_rad = 0, u_angle_rad = 0;  // of the axes, by straightness and a square
  SquarenessOfDiagonals square;                 // by Eq. 2, with both diagonals
  double angle_of_one_diagonal_rad = 0;         // by Eq. 2 as the paper uses it
  PlaneRange estimated;                         // by Eq. 1
  PlaneRange actual;  // of the simulated machine itself, its angles included
  std::vector<DiagonalRange> diagonals;
};

// Fig. 9: the readings over one turn.
struct GroovingTable {
  double EA0C_rad = 0, EB0C_rad = 0;  // of the simulated machine
  double radius_m = 0;
  Perpendicularity raw, without_tilt, without_both;
  double range_m = 0, range_without_tilt_m = 0;  // of the readings
  double range_left_m = 0;  // without tilt and perpendicularity: the errors of X and Y
};

struct GroovingStudy {
  std::uint64_t seed = 0;
  GroovingInstruments instruments;
  GroovingState before, after;  // without and with the corrections
  VolumetricTable
      corrections;  // on a grid of 20 mm: the re-shaped commands, as a controller's table
  GroovingTable table;
};
Result<GroovingStudy> grooving_study(std::uint64_t seed, const GroovingInstruments& instruments);

}  // namespace mdof::algo
