// Units in the D-SI format (PTB, SI_Format.xsd): \micro\metre, \volt\per\micro\metre,
// \volt\metre\tothe{-1}. A \per applies only to the next unit.
#pragma once

#include <optional>
#include <string_view>

namespace mdof {

// A unit m^metre V^volt times a factor: value in SI units = value in the DCC * factor.
struct SiUnit {
  double factor = 1;
  int metre = 0, volt = 0;

  bool is(int of_metre, int of_volt) const { return metre == of_metre && volt == of_volt; }
};

// Returns nothing if the unit has neither length nor voltage, or cannot be read.
std::optional<SiUnit> si_unit(std::string_view text);

}  // namespace mdof
