// Points at equal steps, as Siemens' compensation tables have them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "daemon/output/controllers/series.h"

namespace mdof::controllers {

constexpr std::size_t kMostOfSiemens = 200;       // points of a table: 808D, 828D; others MD38000
constexpr std::size_t kMostBeforeSteps = 20'000;  // of a series, before they are equal

struct EqualSteps {
  double first_m = 0, step_m = 0;
  std::vector<double> forward, reverse;  // E; m
  double loss_m = 0;                     // at a point of the series, by resampling

  double last_m() const { return first_m + step_m * static_cast<double>(forward.size() - 1); }
};

// As many steps as the smallest of the series asks for, and twice as many again and again while
// the series loses more than 1 % of its largest error; at most most_points() - 1; of whole
// nanometres, as they are written. What the series loses becomes a note of `out`, and its last
// `written` has the points. Error (bad_input): fewer than two points.
Result<EqualSteps> equal_steps(const Series& s, const ExportOptions& options, Export& out);
// ExportOptions::siemens_points, or kMostOfSiemens.
std::size_t most_points(const ExportOptions& options);

// Largest error of both approaches.
double largest_error_m(const Series& s);

// Points at equal steps are not left out; a note says so where a tolerance was given.
ExportOptions without_tolerance(const ExportOptions& options, Export& out);

// "AX1" of X.
std::string siemens_axis(char axis);
// The values of LEC and CEC are in the basic system of the control, whatever G70 or G71 say.
inline constexpr const char* kMetricOnly =
    "; The basic system of the control must be metric (MD10240 = 1): the values are in mm.\n";

}  // namespace mdof::controllers
