// Parameters of ISO 230-2 with their names in the standard. mdof calculates them for positioning,
// and in the same way for straightness and angles. Values are in m or rad.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace mdof {

struct PositioningReading {
  double target_m = 0;
  int direction = 0;  // direction of approach: +1 forward, -1 reverse
  int run = 0;
  double deviation = 0;  // actual - nominal
};

inline constexpr double kNoFigure = std::numeric_limits<double>::quiet_NaN();

// One approach of a target; NaN: no readings.
struct TargetApproach {
  std::size_t n = 0;
  double mean = kNoFigure;
  double s = kNoFigure;  // standard deviation, n - 1 degrees of freedom
  double R = kNoFigure;  // 4 s
};

struct PositioningTarget {
  double target_m = 0;
  TargetApproach forward, reverse;
  double mean = kNoFigure;  // mean of the means of both approaches
  double B = kNoFigure;     // mean of the forward readings - mean of the reverse readings
  // The largest of 2 s forward + 2 s reverse + |B|, R forward and R reverse.
  double R = kNoFigure;
};

// If all targets were approached from one side only, the parameters of the other approach, and the
// parameters that need both approaches, are NaN.
struct Positioning {
  std::vector<PositioningTarget> targets;  // ascending
#define PARAMETER(name, null, meaning) double name = kNoFigure;
#include "schema/iso230/positioning_parameters.inc"
};

// Expanded uncertainties (k = 2) of the parameters, m.
struct PositioningUncertainty {
  double device = 0;  // due to the measuring device, calculated from its error limits
  double drift = 0;   // due to environmental variation during the test
  double E_M_A = 0;   // U of E, M and A, due to device and drift
  // U of B, due to drift only, because the device has the same error for both approaches of a
  // target.
  double B = 0;
};

// Expanded uncertainties (95 %) of the parameters of one error of a run, m or rad. They are
// propagated from the declared uncertainties of the rig and from the scatter of the run (GUM 5,
// JCGM 101). NaN: the parameter does not exist, or U is unknown (kWhyNotOfA).
// - U of B, E and M contains the scatter of the visits, so it applies to the axis.
// - U of R applies to the visits of this run. It does not contain the uncertainty that R, as a
//   property of the axis, has because the number of visits is small.
struct RunPositioningUncertainty {
  static constexpr const char* kWhyNotOfA =
      "A is calculated from the values mean ± 2 s of each target, and so few approaches do not "
      "determine the uncertainty of the standard deviation s";
#define PARAMETER(name, null, meaning) double name = kNoFigure;
#include "schema/iso230/positioning_parameters.inc"
  bool noise_only = false;
  std::string covers;  // sentence about the contributors of U
  std::vector<std::string> not_declared;
};

struct PositioningParameter {
  const char* name;
  double Positioning::*value;
  double RunPositioningUncertainty::*U;
};
inline constexpr PositioningParameter kPositioningParameters[] = {
#define PARAMETER(name, null, meaning) \
  {#name, &Positioning::name, &RunPositioningUncertainty::name},
#include "schema/iso230/positioning_parameters.inc"
};

}  // namespace mdof
