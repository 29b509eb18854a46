#include "schema/rig/reference.h"

#include "schema/base/number/number_text.h"
#include "schema/rig/rig.h"
#include "schema/units.h"

namespace mdof {

const char* to_string(Reference reference) {
  switch (reference) {
    case Reference::carriage:
      return "carriage";
    case Reference::tool:
      return "tool";
    case Reference::fixture:
      break;
  }
  return "fixture";
}

bool reference_from(std::string_view name, Reference& reference) {
  for (const Reference r : {Reference::fixture, Reference::carriage, Reference::tool}) {
    if (name != to_string(r)) continue;
    reference = r;
    return true;
  }
  return false;
}

std::string reference_text(const StatedAt& at) {
  std::string text = to_string(at.reference);
  if (at.reference != Reference::tool) return text;
  for (std::size_t k = 0; k < at.point_m.size(); ++k)
    text += (k ? ", " : " ") + plain_number(to_mm(at.point_m[k]), 6);
  return text + " mm";
}

Result<StatedAt> stated_at(const Rig& rig, Reference reference) {
  if (reference != Reference::tool) return StatedAt{reference, {}};
  if (rig.tool_point_m) return StatedAt{reference, *rig.tool_point_m};
  return fail(ErrorCode::usage,
              rig.source +
                  ": has no tool_point_mm, so errors cannot be stated at the tool; add "
                  "tool_point_mm = [x, y, z], the point of the tool in the metrology frame");
}

StatedAt default_reference(const Rig& rig) {
  return rig.tool_point_m ? StatedAt{Reference::tool, *rig.tool_point_m} : kAtFixture;
}

}  // namespace mdof
