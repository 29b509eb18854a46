// Points at equal steps, as in Siemens' compensation tables.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "daemon/output/controllers/series.h"

namespace mdof::controllers {

// Largest number of points in a table of an 808D or 828D; MD38000 states the limit of other
// controls.
constexpr std::size_t kSiemensPointLimit = 200;
// Largest number of points in a series before resampling.
constexpr std::size_t kResamplingPointLimit = 20'000;

struct EqualSteps {
  double first_m = 0, step_m = 0;
  std::vector<double> forward, reverse;  // E in m
  double loss_m = 0;  // largest change by resampling at a point of the original series

  double last_m() const { return first_m + step_m * static_cast<double>(forward.size() - 1); }
};

// Resamples a series to equal steps. The first number of steps is the range divided by the smallest
// interval of the series. While resampling changes a value by more than 1 % of the largest error,
// the number of steps is doubled, up to most_points() - 1. A step is a whole number of nanometres,
// as in the file. Adds a note with the change to `out`, and sets the number of points in the last
// element of out.written. Error (bad_input): fewer than two points.
Result<EqualSteps> equal_steps(const Series& s, const ExportOptions& options, Export& out);
// Largest number of points in a table: ExportOptions::siemens_points, or kSiemensPointLimit if
// siemens_points is 0.
std::size_t most_points(const ExportOptions& options);

// The largest absolute value of the errors in both approaches.
double largest_error_m(const Series& s);

// Returns the options with the tolerance 0, because no points can be omitted from equal steps. Adds
// a note if the user stated a tolerance.
ExportOptions without_tolerance(const ExportOptions& options, Export& out);

// The name of an axis in Siemens' files: "AX1" for X.
std::string siemens_axis(char axis);
// The control reads the values of LEC and CEC in the units of its basic system; G70 and G71 have no
// effect on them.
inline constexpr const char* kMetricOnly =
    "; The basic system of the control must be metric (MD10240 = 1): the values are in mm.\n";

}  // namespace mdof::controllers
