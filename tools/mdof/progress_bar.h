// Draws how far a long piece of work is, for somebody who watches.
#pragma once

#include <chrono>
#include <string>

#include "schema/base/progress.h"

namespace mdof::tools {

// A bar with rate and time left on the standard error, from one second on and only on a terminal;
// the destructor wipes it away. Thread-bound.
class ProgressBar {
 public:
  // `done_before` of the work is there already, and does not count in the rate.
  explicit ProgressBar(std::string what, double done_before = 0);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  // Without a total nothing is drawn. Cheap: draws at most ten times a second.
  void show(const Progress& progress);
  // The seconds since the beginning, of work that does not say how far it is.
  void show_elapsed();

 private:
  using Clock = std::chrono::steady_clock;
  std::string what_;
  double done_before_;
  bool wanted_, drawn_ = false;
  Clock::time_point begin_, next_;
};

}  // namespace mdof::tools
