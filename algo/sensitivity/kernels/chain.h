// Data of a chain of frames with errors, for chain_kernel.h. The steps are in the order from the
// tool to the work. algo/machine/README.md has the equations; algo/machine/budget/ creates the
// data. The types have no functions, because translation units with different instruction sets
// include this header. SI.
#pragma once

#include <cstddef>

namespace mdof::algo {

// The value (number - centre) * factor for each random number of one column.
struct ChainTerm {
  std::size_t column = 0;
  double centre = 0, factor = 0;
};

// constant + the sum of the terms with index first ... last - 1.
struct ChainSum {
  double constant = 0;
  std::size_t first = 0, last = 0;
};

enum class ChainMotion { none, linear, rotary };

struct ChainStep {
  bool inverse = false;  // true: the body moves the work
  ChainSum error[6];     // errors of the body: three translations, three rotations
  double point[3] = {};  // point at which these errors apply
  ChainMotion motion = ChainMotion::none;
  std::size_t direction = 0;  // of a linear motion: 0 X, 1 Y, 2 Z
  double travel = 0;          // of a linear motion
  ChainSum line[6];           // errors of the axis line
  double centre[3] = {};      // of a rotary motion
  double turn[9] = {};        // of a rotary motion: rotation matrix, row by row
};

struct ChainProgram {
  const ChainStep* steps = nullptr;
  std::size_t count = 0;  // number of steps
  const ChainTerm* terms = nullptr;
  double tool[3] = {}, nominal[3] = {};  // tool point in the coordinates of the tool; tool point
                                         // without errors in the coordinates of the work
};

}  // namespace mdof::algo
