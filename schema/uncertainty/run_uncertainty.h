// What is not known of the five errors of each point of a run: GUM 5 and annex G.
#pragma once

#include <string>
#include <vector>

#include "schema/axis.h"
#include "schema/base/json_writer.h"
#include "schema/uncertainty/covers.h"

namespace mdof {

// In the order of error_names(); m, rad. NaN: not known, as of a point without errors.
struct ErrorsUncertainty {
  Errors5 u{};                // combined standard uncertainty
  Errors5 u_random{};         // of it: noise of its stop, or the repeatability of the run
  Errors5 freedom{};          // effective degrees of freedom, may be infinite
  Errors5 coverage_factor{};  // k for 95 %, Student's t
  Errors5 U{};                // k u
};

enum class VisitsCovered {
  repeated,  // u has what repeats of the targets show
  single,    // no target was visited again from the same side
  left_out   // u has the noise of each stop alone
};

struct RunUncertainty {
  std::vector<ErrorsUncertainty> points;  // one a point of the run
  // Nothing but noise is seen in any u: the rig declares nothing, or nothing that shows, or `why`
  // what it declares could not be calculated.
  bool noise_only = true;
  bool declares = false;
  VisitsCovered visits = VisitsCovered::single;
  std::string why;
  std::vector<std::string> not_declared;  // keys of the rig: u is too small by what they would add
};

// As of is_noise_only(Budget) of schema/uncertainty/budget.h, of all points.
bool is_noise_only(const RunUncertainty& uncertainty);

// "u_covers" and "not_declared" of an open object.
void write_covers(JsonWriter& json, const std::string& covers,
                  const std::vector<std::string>& not_declared);
void write_covers(JsonWriter& json, const RunUncertainty& uncertainty);
// Without `why`, which covers_text() gives after the first.
Covers covers(const RunUncertainty& uncertainty);
std::string covers_text(const RunUncertainty& uncertainty);

// The members "u", "u_random", "U", "k" and "nu_eff" of an open object, each with the five keys.
// What is not known is null, and so are infinitely many degrees of freedom.
void write_uncertainty(JsonWriter& json, Axis axis, const ErrorsUncertainty& uncertainty);

}  // namespace mdof
