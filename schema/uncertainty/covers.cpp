#include "schema/uncertainty/covers.h"

#include <array>
#include <cstddef>

namespace mdof {
namespace {

constexpr std::array kCoveredWords = {
#define COVERED(code, english, german) english,
#include "schema/uncertainty/covers.inc"
#undef COVERED
};

}  // namespace

Covers covers(const CoverFacts& of) {
  Covers found;
  if (of.noise_only)
    found = {of.repeated ? Covered::noise_repeatability_only : Covered::noise_only,
             of.declares ? Covered::declared_below_1_percent : Covered::nothing_declared};
  else
    found = {of.repeated ? Covered::noise_repeatability_declared : Covered::noise_declared};
  if (!of.repeated) found.push_back(Covered::no_second_visit);
  return found;
}

std::string covers_text(const Covers& covers) {
  std::string text;
  for (const Covered each : covers) text += kCoveredWords[static_cast<std::size_t>(each)];
  return text;
}

}  // namespace mdof
