// What may be said of a figure that has a tolerance: ISO 14253-1:2017.
#pragma once

#include <string>

#include "schema/base/json_writer.h"

namespace mdof {

enum class Conformity { conform, not_conform, undecided };
const char* to_string(Conformity conformity);  // "conform", "not conform", "undecided"

struct Decision {
  Conformity conformity = Conformity::undecided;
  double limit = 0;         // most that the figure may be in size; m, rad
  double guard_band = 0;    // g, by which the limit is drawn in to prove conformity
  double guard_factor = 0;  // g / u
  std::string rule;         // by which standard, with which probability
  std::string reason;       // of undecided, a sentence without a full stop; else empty
};

// "tolerance", "conformity" and "decision": {"conformity", "rule", "guard_band",
// "guard_band_factor", "reason"} of an open object, in the unit of the figure's name.
void write_decision(JsonWriter& json, const Decision& decision);

}  // namespace mdof
