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

std::string covers_text(const Covers& covers) {
  std::string text;
  for (const Covered each : covers) text += kCoveredWords[static_cast<std::size_t>(each)];
  return text;
}

}  // namespace mdof
