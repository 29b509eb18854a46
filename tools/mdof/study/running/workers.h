// Divides work among several threads.
#pragma once

#include <cstddef>
#include <functional>

namespace mdof::tools {

// Calls work(worker, i) once for each piece of work i = 0, 1, ... count - 1. Threads named "study
// 1" ... begin the pieces in this order. `worker` is the number of the thread, from 0. The calling
// thread calls tick() about ten times a second. After tick() has returned false, no further piece
// begins; the pieces in progress are finished. Returns the number n of finished pieces, which are
// the pieces 0 ... n - 1. If a thread throws an exception, this function throws it again.
std::size_t in_parallel(unsigned threads, std::size_t count,
                        const std::function<void(unsigned worker, std::size_t i)>& work,
                        const std::function<bool()>& tick);

unsigned default_threads();  // The number of processors that this process may use.

}  // namespace mdof::tools
