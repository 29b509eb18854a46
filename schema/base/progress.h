// Progress of a long operation.
#pragma once

#include <functional>

namespace mdof {

struct Progress {
  double done = 0, total = 0;  // total 0: unknown
  const char* unit = "";       // of both, for example "B" or "trials"
};

// Called repeatedly on the working thread; false: cancel the operation.
using ProgressCallback = std::function<bool(const Progress&)>;

}  // namespace mdof
