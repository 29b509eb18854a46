// The complete study of Hwang, Song and Park (An evaluation method for two-dimensional position
// errors and assembly errors of a rotational table on a 4 axis machine tool), on a simulated
// machine of that kind. Each instrument measures the machine with its own noise; as in a workshop,
// the study uses only these readings.
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
  double square_rad = 0.3e-6;  // optical square, set up again each time
  double line_m = 100e-9;      // along a line or a diagonal, mirrors set up again each time
  double height_m = 20e-9;     // indicator over the table
  double tilt_rad = 0.1e-6;    // level on the table
  std::size_t repeats = 5;     // repeats of each reading
};

// C and Y carry the work, X the tool; 400 mm x 400 mm. The sizes of the errors, including the yaw
// of Y, are chosen so that the plane and the diagonals are near the paper's figures. Contains
// positions, straightness in both directions, angles and all squareness errors.
Machine grooving_machine();

// Largest minus smallest over the plane, m.
struct PlaneRange {
  double x_m = 0, y_m = 0;
};
struct DiagonalRange {
  std::string name;         // "X+Y+"
  double predicted_m = 0;   // by Eq. 1 along the diagonal
  double measured_m = 0;    // ISO 230-6: E of the mean of the repeats
  double difference_m = 0;  // the largest of measured - predicted
};
struct GroovingState {
  Machine found;  // positions, straightness and squareness as measured
  double angle_error_rad = 0, u_angle_rad = 0;  // between the axes, by straightness and a square
  DiagonalSquareness square;                    // by Eq. 2, with both diagonals
  double one_diagonal_angle_rad = 0;            // by Eq. 2 as the paper uses it
  PlaneRange estimated;                         // by Eq. 1
  PlaneRange actual;  // by the simulated machine itself, including its angles
  std::vector<DiagonalRange> diagonals;
};

// Fig. 9: the readings over one turn.
struct GroovingTable {
  double EA0C_rad = 0, EB0C_rad = 0;  // true values of the simulated machine
  double radius_m = 0;
  Perpendicularity raw, without_tilt, without_both;
  double range_m = 0, range_without_tilt_m = 0;  // ranges of the readings
  double range_left_m = 0;  // without tilt and perpendicularity: the errors of X and Y
};

struct GroovingStudy {
  std::uint64_t seed = 0;
  GroovingInstruments instruments;
  GroovingState before, after;  // without and with the corrections
  VolumetricTable
      corrections;  // on a grid of 20 mm: the corrected commands, as a table of the controller
  GroovingTable table;
};
Result<GroovingStudy> grooving_study(std::uint64_t seed, const GroovingInstruments& instruments);

}  // namespace mdof::algo
