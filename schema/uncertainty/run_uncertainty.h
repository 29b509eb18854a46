// Uncertainties of the five errors at each point of a run (GUM 5 and annex G).
#pragma once

#include <string>
#include <vector>

#include "schema/axis.h"
#include "schema/base/json_writer.h"
#include "schema/uncertainty/covers.h"

namespace mdof {

// The errors are in the order of error_names(); m, rad. NaN: unknown, for example because the point
// has no errors.
struct ErrorsUncertainty {
  Errors5 u{};         // combined standard uncertainty
  Errors5 u_random{};  // part of u from the noise of the stop, or from the repeatability of the run
  Errors5 freedom{};   // effective degrees of freedom; may be infinite
  Errors5 coverage_factor{};  // k for 95 %, Student's t
  Errors5 U{};                // k u
};

enum class VisitsCovered {
  repeated,  // u includes the repeatability, which was found from repeated visits
  single,    // no target was visited twice from the same side
  left_out   // u includes only the noise of each stop, not the repeatability
};

struct RunUncertainty {
  std::vector<ErrorsUncertainty> points;  // one for each point of the run
  // True: every u contains only noise. Either the rig declares nothing, or the declared
  // contributions are negligible, or they could not be calculated; `why` then states the reason.
  bool noise_only = true;
  bool declares = false;
  VisitsCovered visits = VisitsCovered::single;
  std::string why;
  // Keys that the rig does not declare; u does not include their contributions.
  std::vector<std::string> not_declared;
};

// Whether u contains noise only: is_noise_only() of schema/uncertainty/budget.h for all points.
bool is_noise_only(const RunUncertainty& uncertainty);

// Writes "u_covers" and "not_declared" into an open object.
void write_covers(JsonWriter& json, const std::string& covers,
                  const std::vector<std::string>& not_declared);
void write_covers(JsonWriter& json, const RunUncertainty& uncertainty);
// The result of covers() does not include `why`; covers_text() adds `why` after the first
// contribution.
Covers covers(const RunUncertainty& uncertainty);
std::string covers_text(const RunUncertainty& uncertainty);

// Writes the members "u", "u_random", "U", "k" and "nu_eff" into an open object. Each member is an
// object with the five error keys. Unknown values and infinite degrees of freedom are null.
void write_uncertainty(JsonWriter& json, Axis axis, const ErrorsUncertainty& uncertainty);

}  // namespace mdof
