// Work in numbered pieces, on several threads.
#pragma once

#include <cstddef>
#include <functional>

namespace mdof::tools {

// Calls work(worker, i) once for each piece i = 0, 1, ... count - 1. The pieces are handed out in
// this order to threads named "study 1" ...; `worker` is the number of the thread, from 0 on.
// Meanwhile the calling thread calls tick() about ten times a second. Once that returns false no
// more pieces are handed out, and those under way are finished. Returns n: the pieces 0 ... n - 1
// were done, no others. An exception of a worker is thrown here.
std::size_t in_parallel(unsigned threads, std::size_t count,
                        const std::function<void(unsigned worker, std::size_t i)>& work,
                        const std::function<bool()>& tick);

unsigned default_threads();  // one for each processor this process may use

}  // namespace mdof::tools
