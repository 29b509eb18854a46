// How far a long piece of work is, for somebody who watches.
#pragma once

#include <chrono>
#include <string>

namespace mdof::tools {

// A bar with rate and time left on the standard error, from one second on and only on a terminal;
// the destructor wipes it away. Thread-bound.
class Progress {
 public:
  // `unit` of the work, such as "B" or "trials"; `done` of it is there from before.
  Progress(std::string what, std::string unit, double done = 0);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // `share` of `total` units is done; total 0: not known, nothing is drawn. Cheap: draws at most
  // ten times a second.
  void show(double share, double total);

 private:
  using Clock = std::chrono::steady_clock;
  std::string what_, unit_;
  double done_;
  bool wanted_, drawn_ = false;
  Clock::time_point begin_, next_;
};

}  // namespace mdof::tools
