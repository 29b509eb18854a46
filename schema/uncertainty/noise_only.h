// Whether u contains noise and repeatability alone, where several values are stated together.
#pragma once

#include <cstdint>
#include <string>

namespace mdof {

enum class NoiseOnly : std::uint8_t { none, some, all };

constexpr NoiseOnly noise_only_if(bool all) {
  return all ? NoiseOnly::all : NoiseOnly::none;
}
// Of both.
constexpr NoiseOnly joined(NoiseOnly a, NoiseOnly b) {
  return a == b ? a : NoiseOnly::some;
}

// What u of a sum of errors of a machine contains, in English, without a full stop.
std::string covers_of_errors(NoiseOnly noise_only, bool some_without_u);

}  // namespace mdof
