// How far a long piece of work is, for somebody who watches.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace mdof::tools {

// A bar with rate and time left on the standard error, from one second on and only on a terminal;
// the destructor wipes it away. Thread-bound.
class Progress {
 public:
  Progress(std::string what, std::uint64_t total_bytes);  // total 0: not known
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(double share);  // 0 ... 1; cheap: draws at most ten times a second

 private:
  using Clock = std::chrono::steady_clock;
  std::string what_;
  double total_mb_;
  bool wanted_, drawn_ = false;
  Clock::time_point begin_, next_;
};

}  // namespace mdof::tools
