// Work in numbered pieces, on several threads.
#pragma once

#include <cstddef>
#include <functional>

namespace mdof::tools {

// Calls work(worker, i) for i = 0, 1, ... count - 1, handed out in this order, on threads named
// "study 1" ...; worker (0 ... threads - 1) tells them apart. Meanwhile tick() is called on the
// calling thread about ten times a second; once it says false no more pieces are handed out. Gives
// how many pieces were done: always the first ones. An exception of a worker is thrown here.
std::size_t in_parallel(unsigned threads, std::size_t count,
                        const std::function<void(unsigned worker, std::size_t i)>& work,
                        const std::function<bool()>& tick);

unsigned default_threads();  // one for each processor this process may use

}  // namespace mdof::tools
