// How far a long piece of work is, from whoever does it to whoever waits for it.
#pragma once

#include <functional>

namespace mdof {

struct Progress {
  double done = 0, total = 0;  // total 0: not known
  const char* unit = "";       // of both, such as "B" or "trials"
};

// Called now and then on the thread that works; false: the work is given up.
using ProgressCallback = std::function<bool(const Progress&)>;

}  // namespace mdof
