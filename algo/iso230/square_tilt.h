// Effect of a tilted square on the squareness.
#pragma once

#include "schema/iso230/squareness.h"
#include "schema/run.h"

namespace mdof::algo {

// The squareness error minus the sum of the slopes in squareness_of(), rad; 0 if the square is
// parallel to the axes. The slopes are components of the directions of both axes. The angle between
// the axes is the angle of the directions v_a and v_b in the frame of the square,
//   v_a · v_b = slope_a + slope_b + v_a,c v_b,c + second-order terms of the rigid rotation,
// where c is the third axis. If the square is tilted by α and β about the axes a and b, the sum of
// the slopes is wrong by about α β: 1 µrad for 1 mrad and 1 mrad.
double square_tilt_rad(const Run& run_a, const Run& run_b, AxisPair axes);

}  // namespace mdof::algo
