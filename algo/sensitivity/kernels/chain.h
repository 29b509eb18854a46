// A chain of frames with errors, laid out for the kernel (chain_kernel.h): where the tool's point
// goes, one frame after the other from the tool to the work. algo/machine/README.md has the
// equations, algo/machine/budget/ makes it. Plain data without functions, for units of translation
// with different instruction sets share it. SI.
#pragma once

#include <cstddef>

namespace mdof::algo {

// (column - centre) * factor, of one column of random numbers.
struct ChainTerm {
  std::size_t column = 0;
  double centre = 0, factor = 0;
};

// constant + the terms from `first` to before `last`.
struct ChainSum {
  double constant = 0;
  std::size_t first = 0, last = 0;
};

enum class ChainMotion { none, linear, rotary };

struct ChainStep {
  bool inverse = false;  // a body that carries the work
  ChainSum error[6];     // of the body
  double point[3] = {};  // at which they hold
  ChainMotion motion = ChainMotion::none;
  std::size_t direction = 0;  // of a linear motion
  double travel = 0;          // of a linear motion
  ChainSum line[6];           // errors of the line of the motion
  double centre[3] = {};      // of a rotary motion
  double turn[9] = {};        // its rotation, row by row
};

struct ChainProgram {
  const ChainStep* steps = nullptr;
  std::size_t count = 0;  // of steps
  const ChainTerm* terms = nullptr;
  double tool[3] = {}, nominal[3] = {};  // the point that starts, and where it ends without errors
};

}  // namespace mdof::algo
