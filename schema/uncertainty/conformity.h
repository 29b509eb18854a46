// Decides whether a figure conforms to its tolerance (ISO 14253-1:2017).
#pragma once

#include <string>

#include "schema/base/json_writer.h"

namespace mdof {

enum class Conformity { conform, not_conform, undecided };
const char* to_string(Conformity conformity);  // "conform", "not conform", "undecided"

struct Decision {
  Conformity conformity = Conformity::undecided;
  double limit = 0;  // largest permitted magnitude of the figure; m, rad
  // guard band g; conformity is proved if the magnitude of the figure is at most limit - g
  double guard_band = 0;
  double guard_factor = 0;  // g / u
  std::string rule;         // standard and probability on which the decision is based
  std::string reason;       // reason if undecided: a sentence without a full stop; otherwise empty
};

// Writes "tolerance", "conformity" and "decision": {"conformity", "rule", "guard_band",
// "guard_band_factor", "reason"} into an open object, in the unit at the end of the figure's name.
void write_decision(JsonWriter& json, const Decision& decision);

}  // namespace mdof
