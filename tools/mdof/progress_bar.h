// Shows the progress of long work on a terminal.
#pragma once

#include <chrono>
#include <string>

#include "schema/base/progress.h"

namespace mdof::tools {

// Writes a bar with the rate and the remaining time to the standard error, if this is a terminal.
// The bar appears after one second. The destructor erases it. Thread-bound.
class ProgressBar {
 public:
  // `done_before`: the part of the work that an earlier program did; the rate does not include it.
  explicit ProgressBar(std::string what, double done_before = 0);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  // Draws nothing if the total is unknown. May be called very often, because it draws at most ten
  // times a second.
  void show(const Progress& progress);
  // Shows the elapsed seconds, for work whose progress is unknown.
  void show_elapsed();

 private:
  using Clock = std::chrono::steady_clock;
  std::string what_;
  double done_before_;
  bool wanted_, drawn_ = false;
  Clock::time_point begin_, next_;
};

}  // namespace mdof::tools
