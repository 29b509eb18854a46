#include "schema/rig/correction.h"

#include <algorithm>

namespace mdof {
namespace {

int sign_of_error(const ChainAxis& measured) {
  return measured.carries_work ? -1 : 1;
}

// Returns the reason why straightness with this reference point does not apply to the tool; empty:
// it applies.
std::string reference_point_gap(const ChainAxis& measured, Axis axis, Sides sides,
                                Reference reference) {
  const bool at_carriage = reference == Reference::carriage;
  if (fixture_is_with_tool(measured, sides)) {
    if (!at_carriage) return "";
    return "the straightness is stated at the carriage, a point that moves with the axis, not at "
           "the tool; build a table with the reference \"fixture\" or \"tool\"";
  }
  if (at_carriage) return "";
  return std::string("straightness at the ") + to_string(reference) +
         " is valid for a point of the work, not for the tool, because the fixture is on the side "
         "of the work (the rig states that the " +
         sides.moves() + " moves, and the chain states that axis " + letter(axis) +
         " carries the " + (measured.carries_work ? "work" : "tool") +
         "); if the fixture is in the spindle, correct the key \"moves\" of the rig; if not, build "
         "a table with the reference \"carriage\"";
}

// Returns the reason why there is no correction: a rotary axis between the two axes changes the
// direction of the correction. Empty: no axis changes this direction.
std::string rotary_axis_gap(const Chain& chain, const ChainAxis& measured,
                            const ChainAxis& correcting) {
  const auto [first, last] = std::minmax({&measured, &correcting});
  for (const ChainAxis* between = first + 1; between < last; ++between) {
    const bool is_rotary = between->letter < 'D';
    const char direction =
        correcting.letter < 'D' ? correcting.letter - 'A' + 'X' : correcting.letter;
    if (!is_rotary || between->letter - 'A' + 'X' == direction) continue;
    const std::string rotary(1, between->letter);
    return "the rotary axis " + rotary + " lies between axis " + measured.letter + " and axis " +
           correcting.letter + " in the chain " + chain.text +
           ", so the direction of the correction depends on the position of " + rotary +
           "; build a volumetric table for a fixed position of " + rotary;
  }
  return "";
}

}  // namespace

bool fixture_is_with_tool(const ChainAxis& measured, Sides sides) {
  return sides.fixture_moves != measured.carries_work;
}

int sign_of_command(const ChainAxis& axis) {
  const int travel = axis.against_command ? -1 : 1;
  return axis.carries_work ? -travel : travel;
}

char corrected_by(const ErrorName& name) {
  return name.name[1];
}

CorrectionSigns correction_signs(const Chain& chain, Axis axis, Sides sides, Reference reference) {
  CorrectionSigns signs;
  const ChainAxis* measured = chain.find(letter(axis));
  for (std::size_t k = 0; k < signs.factor.size(); ++k) {
    const char by = corrected_by(error_names(axis)[k]);
    const ChainAxis* correcting = chain.find(by);
    if (!chain.known()) {
      signs.gap[k] =
          "the kinematic chain of the machine is unknown, so the sign of the correction is "
          "unknown; add [machine] chain, such as \"w-Y-X-b-Z-t\", to the rig or to mdofd.toml, "
          "then build the table again";
    } else if (!measured || !correcting) {
      signs.gap[k] = "the chain " + chain.text + " has no axis " + (measured ? by : letter(axis));
    } else {
      signs.gap[k] = rotary_axis_gap(chain, *measured, *correcting);
      if (signs.gap[k].empty() && !error_names(axis)[k].angle)
        signs.gap[k] = reference_point_gap(*measured, axis, sides, reference);
      if (signs.gap[k].empty())
        signs.factor[k] = -sign_of_error(*measured) * sign_of_command(*correcting);
    }
  }
  return signs;
}

}  // namespace mdof
