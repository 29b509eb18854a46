#include "schema/uncertainty/conformity.h"

#include "schema/axis.h"

namespace mdof {

const char* to_string(Conformity conformity) {
  return conformity == Conformity::conform       ? "conform"
         : conformity == Conformity::not_conform ? "not conform"
                                                 : "undecided";
}

void write_decision(JsonWriter& json, const Decision& decision) {
  json.field("tolerance", to_key_unit(decision.limit))
      .field("conformity", to_string(decision.conformity))
      .key("decision")
      .begin_object()
      .field("conformity", to_string(decision.conformity))
      .field("rule", decision.rule)
      .field("guard_band", to_key_unit(decision.guard_band))
      .field("guard_band_factor", decision.guard_factor)
      .key("reason");
  decision.reason.empty() ? json.null() : json.value(decision.reason);
  json.end_object();
}

}  // namespace mdof
