#include "schema/rig/correction.h"

namespace mdof {
namespace {

int sign_of_error(const ChainAxis& measured) {
  return measured.carries_work ? -1 : 1;
}

}  // namespace

int sign_of_command(const ChainAxis& axis) {
  const int travel = axis.against_command ? -1 : 1;
  return axis.carries_work ? -travel : travel;
}

char corrected_by(const ErrorName& name) {
  return name.name[1];
}

CorrectionSigns correction_signs(const Chain& chain, Axis axis, Reference reference) {
  CorrectionSigns signs;
  const ChainAxis* measured = chain.find(letter(axis));
  for (std::size_t k = 0; k < signs.factor.size(); ++k) {
    const char by = corrected_by(error_names(axis)[k]);
    const ChainAxis* correcting = chain.find(by);
    if (!chain.known()) {
      signs.gap[k] =
          "the kinematic chain of the machine is unknown, so the sign is unknown; add [machine] "
          "chain, such as \"w-Y-X-b-Z-t\", to the rig or to mdofd.toml, then build the table again";
    } else if (!measured || !correcting) {
      signs.gap[k] = "the chain " + chain.text + " has no axis " + (measured ? by : letter(axis));
    } else if (reference == Reference::carriage && !error_names(axis)[k].angle) {
      signs.gap[k] =
          "straightness at the carriage holds for a point that travels with the axis, not for the "
          "tool; build a table with the reference \"fixture\" or \"tool\"";
    } else {
      signs.factor[k] = -sign_of_error(*measured) * sign_of_command(*correcting);
    }
  }
  return signs;
}

}  // namespace mdof
