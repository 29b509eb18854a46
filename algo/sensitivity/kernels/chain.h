// A chain of frames with errors, in the layout of the kernel (chain_kernel.h): the path of the
// tool's point from frame to frame, from the tool to the work. algo/machine/README.md has the
// equations, algo/machine/budget/ creates the chain. Plain data without functions, because
// translation units with different instruction sets share it. SI.
#pragma once

#include <cstddef>

namespace mdof::algo {

// (column - centre) * factor, for one column of random numbers.
struct ChainTerm {
  std::size_t column = 0;
  double centre = 0, factor = 0;
};

// constant + the terms [first, last).
struct ChainSum {
  double constant = 0;
  std::size_t first = 0, last = 0;
};

enum class ChainMotion { none, linear, rotary };

struct ChainStep {
  bool inverse = false;  // the body carries the work
  ChainSum error[6];     // errors of the body
  double point[3] = {};  // point at which these errors apply
  ChainMotion motion = ChainMotion::none;
  std::size_t direction = 0;  // of a linear motion
  double travel = 0;          // of a linear motion
  ChainSum line[6];           // errors of the line of the motion
  double centre[3] = {};      // of a rotary motion
  double turn[9] = {};        // its rotation, row by row
};

struct ChainProgram {
  const ChainStep* steps = nullptr;
  std::size_t count = 0;  // number of steps
  const ChainTerm* terms = nullptr;
  double tool[3] = {}, nominal[3] = {};  // start of the point, and its end without errors
};

}  // namespace mdof::algo
