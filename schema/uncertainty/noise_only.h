// States for several values whether the u of all, some or none of them contains only noise and
// repeatability.
#pragma once

#include <cstdint>
#include <string>

namespace mdof {

enum class NoiseOnly : std::uint8_t { none, some, all };

constexpr NoiseOnly noise_only_if(bool all) {
  return all ? NoiseOnly::all : NoiseOnly::none;
}
// Combines the statements for two groups of values.
constexpr NoiseOnly joined(NoiseOnly a, NoiseOnly b) {
  return a == b ? a : NoiseOnly::some;
}

// English text without a full stop: the contributions that u of a sum of machine errors includes.
std::string error_covers_text(NoiseOnly noise_only, bool some_without_u);

}  // namespace mdof
