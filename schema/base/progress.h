// Progress of a long operation.
#pragma once

#include <functional>

namespace mdof {

struct Progress {
  double done = 0, total = 0;  // total 0: unknown
  const char* unit = "";       // unit of done and total, for example "B" or "trials"
};

// The working thread calls this function repeatedly. If it returns false, the operation is
// cancelled.
using ProgressCallback = std::function<bool(const Progress&)>;

}  // namespace mdof
