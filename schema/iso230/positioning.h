// Parameters of ISO 230-2 by its own names: of positioning, and in the same way of straightness and
// angles. Values are in m or rad, as the deviations they are made of.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace mdof {

struct PositioningReading {
  double target_m = 0;
  int direction = 0;  // +1: the target approached in the + sense (forward), -1: reverse
  int run = 0;
  double deviation = 0;  // actual - nominal
};

inline constexpr double kNoFigure = std::numeric_limits<double>::quiet_NaN();

// One approach of a target; without readings: NaN.
struct TargetApproach {
  std::size_t n = 0;
  double mean = kNoFigure;
  double s = kNoFigure;  // with n - 1
  double R = kNoFigure;  // 4 s
};

struct PositioningTarget {
  double target_m = 0;
  TargetApproach forward, reverse;
  double mean = kNoFigure;  // of both approaches' means
  double B = kNoFigure;     // forward - reverse
  double R = kNoFigure;     // the greatest of 2 s forward + 2 s reverse + |B|, R forward, R reverse
};

// What needs the other approach is NaN where all targets were approached from one side only.
struct Positioning {
  std::vector<PositioningTarget> targets;  // ascending
  double B = kNoFigure, B_mean = kNoFigure;
  double R_forward = kNoFigure, R_reverse = kNoFigure, R = kNoFigure;
  double E_forward = kNoFigure, E_reverse = kNoFigure, E = kNoFigure, M = kNoFigure;
  double A_forward = kNoFigure, A_reverse = kNoFigure, A = kNoFigure;
};

// Expanded uncertainties (k = 2) of these parameters, m.
struct PositioningUncertainty {
  double device = 0;  // of the measuring device, from its limits of error
  double drift = 0;   // of the environment's variation during the test
  double E_M_A = 0;   // of E, M and A: both
  double B = 0;       // the device errs alike on either side of a target: drift alone
};

// Expanded uncertainties for 95 % of the parameters of an error of a run, m or rad, propagated from
// what its rig declares and from what the run shows (GUM 5, JCGM 101). NaN: no such parameter.
struct RunPositioningUncertainty {
  // B, E, M as values of the axis: the scatter of the visits is in U.
  double B = kNoFigure, B_mean = kNoFigure;
  double E_forward = kNoFigure, E_reverse = kNoFigure, E = kNoFigure, M = kNoFigure;
  // R of these visits: how well so few know the R of the axis is not in U.
  double R_forward = kNoFigure, R_reverse = kNoFigure, R = kNoFigure;
  bool noise_only = false;
  std::string covers;  // a sentence for people: what U is made of
  std::vector<std::string> not_declared;
};

}  // namespace mdof
