// Points at equal steps, as in Siemens' compensation tables.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "daemon/output/controllers/series.h"

namespace mdof::controllers {

constexpr std::size_t kSiemensPointLimit = 200;  // points of a table: 808D, 828D; others MD38000
constexpr std::size_t kResamplingPointLimit = 20'000;  // points of a series before resampling

struct EqualSteps {
  double first_m = 0, step_m = 0;
  std::vector<double> forward, reverse;  // E; m
  double loss_m = 0;                     // largest change at a point of the series, by resampling

  double last_m() const { return first_m + step_m * static_cast<double>(forward.size() - 1); }
};

// The number of steps follows from the smallest interval of the series. It is doubled while the
// series changes by more than 1 % of its largest error, up to most_points() - 1. Steps are whole
// nanometres, as in the file. The change becomes a note of `out`; its last `written` gets the
// number of points. Error (bad_input): fewer than two points.
Result<EqualSteps> equal_steps(const Series& s, const ExportOptions& options, Export& out);
// ExportOptions::siemens_points, or kSiemensPointLimit.
std::size_t most_points(const ExportOptions& options);

// Largest absolute error of both approaches.
double largest_error_m(const Series& s);

// Points at equal steps are not thinned; a note states this if a tolerance was given.
ExportOptions without_tolerance(const ExportOptions& options, Export& out);

// "AX1" for X.
std::string siemens_axis(char axis);
// The values of LEC and CEC are in the basic system of the control, independent of G70 and G71.
inline constexpr const char* kMetricOnly =
    "; The basic system of the control must be metric (MD10240 = 1): the values are in mm.\n";

}  // namespace mdof::controllers
