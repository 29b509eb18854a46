// Units as the D-SI format writes them (PTB, SI_Format.xsd): \micro\metre, \volt\per\micro\metre,
// \volt\metre\tothe{-1}. A \per belongs to the one unit behind it.
#pragma once

#include <optional>
#include <string_view>

namespace mdof {

// value of the document * factor = value in m^metre V^volt.
struct SiUnit {
  double factor = 1;
  int metre = 0, volt = 0;

  bool is(int of_metre, int of_volt) const { return metre == of_metre && volt == of_volt; }
};

// Nothing: a unit that has to do with neither length nor voltage, or one that cannot be read.
std::optional<SiUnit> si_unit(std::string_view text);

}  // namespace mdof
