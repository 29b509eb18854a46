// Whether u contains only noise and repeatability, for several values that are stated together.
#pragma once

#include <cstdint>
#include <string>

namespace mdof {

enum class NoiseOnly : std::uint8_t { none, some, all };

constexpr NoiseOnly noise_only_if(bool all) {
  return all ? NoiseOnly::all : NoiseOnly::none;
}
// Combines two groups of values.
constexpr NoiseOnly joined(NoiseOnly a, NoiseOnly b) {
  return a == b ? a : NoiseOnly::some;
}

// Contributions that u of a sum of machine errors includes, in English, without a full stop.
std::string error_covers_text(NoiseOnly noise_only, bool some_without_u);

}  // namespace mdof
