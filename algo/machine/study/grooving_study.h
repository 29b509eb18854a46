// The study of Hwang, Song and Park (An evaluation method for two-dimensional position errors and
// assembly errors of a rotational table on a 4 axis machine tool), repeated on a simulated 4-axis
// machine. Simulated instruments measure the machine with noise. The study uses only the readings
// of these instruments.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "algo/machine/geometric_tests/diagonal.h"
#include "algo/machine/geometric_tests/perpendicularity.h"
#include "schema/base/result.h"
#include "schema/volumetric/volumetric_table.h"

namespace mdof::algo {

// Standard deviation of the noise of one reading of each instrument.
struct GroovingInstruments {
  double position_m = 50e-9;   // position error along an axis by a laser interferometer;
                               // straightness optics
  double square_rad = 0.3e-6;  // optical square, including its set-up
  double line_m = 100e-9;    // length of a line or a diagonal, including the set-up of the mirrors
  double height_m = 20e-9;   // indicator over the table
  double tilt_rad = 0.1e-6;  // level on the table
  std::size_t repeats = 5;   // number of repeats of each reading
};

// The simulated machine, 400 mm x 400 mm. C and Y move the work, X moves the tool. Its errors are
// position errors, straightness in both directions, angles and all squareness errors. Their sizes
// are chosen so that the results for the plane and the diagonals are near the results of the paper.
Machine grooving_machine();

// Largest minus smallest error over the plane.
struct PlaneRange {
  double x_m = 0, y_m = 0;
};
struct DiagonalRange {
  std::string name;         // "X+Y+"
  double predicted_m = 0;   // range along the diagonal by Eq. 1
  double measured_m = 0;    // range of the mean of the repeats (ISO 230-6)
  double difference_m = 0;  // largest |measured - predicted|
};
struct GroovingState {
  Machine found;  // machine with the measured position errors, straightness and squareness
  double angle_error_rad = 0, u_angle_rad = 0;  // angle between the axes - 90°, from straightness
                                                // and an optical square
  DiagonalSquareness square;                    // angle by Eq. 2 with both diagonals
  double one_diagonal_angle_rad = 0;            // angle by Eq. 2 with one diagonal, as in the paper
  PlaneRange estimated;                         // error range from the readings by Eq. 1
  PlaneRange actual;  // error range of the simulated machine, including its angle errors
  std::vector<DiagonalRange> diagonals;
};

// Readings on the rotary table over one turn (Fig. 9).
struct GroovingTable {
  double EA0C_rad = 0, EB0C_rad = 0;  // true values of the simulated machine
  double radius_m = 0;
  Perpendicularity raw, without_tilt, without_both;
  double range_m = 0, range_without_tilt_m = 0;  // ranges of the height readings
  // Range after subtraction of tilt and perpendicularity; the errors of X and Y cause it.
  double range_left_m = 0;
};

struct GroovingStudy {
  std::uint64_t seed = 0;
  GroovingInstruments instruments;
  GroovingState before, after;  // without and with the corrections
  VolumetricTable corrections;  // correction table of the controller, on a grid of 20 mm
  GroovingTable table;
};
Result<GroovingStudy> grooving_study(std::uint64_t seed, const GroovingInstruments& instruments);

}  // namespace mdof::algo
