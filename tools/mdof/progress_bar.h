// Shows the progress of long work on a terminal.
#pragma once

#include <chrono>
#include <string>

#include "schema/base/progress.h"

namespace mdof::tools {

// Shows a bar with the rate and the remaining time on the standard error. The bar appears after one
// second and only on a terminal; the destructor erases it. Thread-bound.
class ProgressBar {
 public:
  // `done_before`: the part of the work that was done earlier; it does not count for the rate.
  explicit ProgressBar(std::string what, double done_before = 0);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  // Draws nothing without a total. Cheap, because it draws at most ten times a second.
  void show(const Progress& progress);
  // Shows the elapsed seconds, for work without known progress.
  void show_elapsed();

 private:
  using Clock = std::chrono::steady_clock;
  std::string what_;
  double done_before_;
  bool wanted_, drawn_ = false;
  Clock::time_point begin_, next_;
};

}  // namespace mdof::tools
