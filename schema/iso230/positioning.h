// Parameters of ISO 230-2 with their names in the standard, for positioning and in the same way for
// straightness and angles. Values are in m or rad, like the deviations.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace mdof {

struct PositioningReading {
  double target_m = 0;
  int direction = 0;  // +1: target approached in the + sense (forward), -1: reverse
  int run = 0;
  double deviation = 0;  // actual - nominal
};

inline constexpr double kNoFigure = std::numeric_limits<double>::quiet_NaN();

// One approach of a target; NaN: no readings.
struct TargetApproach {
  std::size_t n = 0;
  double mean = kNoFigure;
  double s = kNoFigure;  // n - 1 degrees of freedom
  double R = kNoFigure;  // 4 s
};

struct PositioningTarget {
  double target_m = 0;
  TargetApproach forward, reverse;
  double mean = kNoFigure;  // mean of the means of both approaches
  double B = kNoFigure;     // forward - reverse
  // The largest of 2 s forward + 2 s reverse + |B|, R forward and R reverse.
  double R = kNoFigure;
};

// Values that need the other approach are NaN if all targets were approached from one side only.
struct Positioning {
  std::vector<PositioningTarget> targets;  // ascending
  double B = kNoFigure, B_mean = kNoFigure;
  double R_forward = kNoFigure, R_reverse = kNoFigure, R = kNoFigure;
  double E_forward = kNoFigure, E_reverse = kNoFigure, E = kNoFigure, M = kNoFigure;
  double A_forward = kNoFigure, A_reverse = kNoFigure, A = kNoFigure;
};

// Expanded uncertainties (k = 2) of these parameters, m.
struct PositioningUncertainty {
  double device = 0;  // due to the measuring device, from its limits of error
  double drift = 0;   // due to environmental variation during the test
  double E_M_A = 0;   // U of E, M and A: device and drift
  // Drift only, because the device has the same error on either side of a target.
  double B = 0;
};

// Expanded uncertainties (95 %) of the parameters of one error of a run, m or rad, propagated from
// the declarations of its rig and from the run itself (GUM 5, JCGM 101). NaN: no such parameter.
struct RunPositioningUncertainty {
  // B, E, M as values of the axis: U contains the scatter of the visits.
  double B = kNoFigure, B_mean = kNoFigure;
  double E_forward = kNoFigure, E_reverse = kNoFigure, E = kNoFigure, M = kNoFigure;
  // R of these visits: U does not contain how well a few visits determine the R of the axis.
  double R_forward = kNoFigure, R_reverse = kNoFigure, R = kNoFigure;
  bool noise_only = false;
  std::string covers;  // sentence about the contributors of U
  std::vector<std::string> not_declared;
};

}  // namespace mdof
