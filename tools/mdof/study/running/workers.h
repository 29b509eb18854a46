// Runs numbered pieces of work on several threads.
#pragma once

#include <cstddef>
#include <functional>

namespace mdof::tools {

// Calls work(worker, i) once for each piece i = 0, 1, ... count - 1. Threads named "study 1" ...
// take the pieces in this order; `worker` is the number of the thread, from 0. The calling thread
// calls tick() about ten times a second. After tick() has returned false, no further piece begins,
// and the pieces in progress are finished. Returns n: exactly the pieces 0 ... n - 1 were done. An
// exception of a worker is thrown here.
std::size_t in_parallel(unsigned threads, std::size_t count,
                        const std::function<void(unsigned worker, std::size_t i)>& work,
                        const std::function<bool()>& tick);

unsigned default_threads();  // One for each processor that this process may use.

}  // namespace mdof::tools
