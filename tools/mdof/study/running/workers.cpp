#include "tools/mdof/study/running/workers.h"

#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace mdof::tools {
namespace {

constexpr std::chrono::milliseconds kTick{100};

// The data that all threads of one call use.
struct Shared {
  Shared(std::size_t pieces, const std::function<void(unsigned, std::size_t)>& what,
         unsigned threads)
      : count(pieces), work(what), running(threads) {}
  const std::size_t count;
  const std::function<void(unsigned, std::size_t)>& work;
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> stop = false;
  std::mutex mutex;
  std::condition_variable ended;
  unsigned running;            // protected by `mutex`
  std::exception_ptr failure;  // protected by `mutex`
};

void run_pieces(Shared& shared, unsigned worker) {
  pthread_setname_np(pthread_self(), ("study " + std::to_string(worker + 1)).c_str());
  std::exception_ptr failure;
  try {
    while (!shared.stop) {
      const std::size_t i = shared.next++;
      if (i >= shared.count) break;
      shared.work(worker, i);
    }
  } catch (...) {
    failure = std::current_exception();
    shared.stop = true;
  }
  const std::lock_guard lock(shared.mutex);
  if (failure) shared.failure = failure;
  if (--shared.running == 0) shared.ended.notify_one();
}

}  // namespace

std::size_t in_parallel(unsigned threads, std::size_t count,
                        const std::function<void(unsigned worker, std::size_t i)>& work,
                        const std::function<bool()>& tick) {
  const auto workers = static_cast<unsigned>(std::min<std::size_t>(std::max(1u, threads), count));
  if (workers == 0) return 0;
  Shared shared(count, work, workers);
  std::vector<std::jthread> pool;
  for (unsigned w = 0; w < workers; ++w) pool.emplace_back([&shared, w] { run_pieces(shared, w); });
  {
    std::unique_lock lock(shared.mutex);
    while (!shared.ended.wait_for(lock, kTick, [&shared] { return shared.running == 0; })) {
      lock.unlock();
      if (!tick()) shared.stop = true;
      lock.lock();
    }
  }
  pool.clear();  // joins the threads
  if (shared.failure) std::rethrow_exception(shared.failure);
  return std::min<std::size_t>(shared.next, count);
}

unsigned default_threads() {
  cpu_set_t mine;
  if (sched_getaffinity(0, sizeof mine, &mine) != 0)
    return std::max(1u, std::thread::hardware_concurrency());
  return static_cast<unsigned>(std::max(1, CPU_COUNT(&mine)));
}

}  // namespace mdof::tools
