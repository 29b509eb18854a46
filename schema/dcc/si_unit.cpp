#include "schema/dcc/si_unit.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "schema/base/trimmed.h"

namespace mdof {
namespace {

constexpr int kMostPower = 9;

constexpr std::array<std::pair<std::string_view, double>, 9> kPrefixes = {{{"nano", 1e-9},
                                                                           {"micro", 1e-6},
                                                                           {"milli", 1e-3},
                                                                           {"centi", 1e-2},
                                                                           {"deci", 1e-1},
                                                                           {"kilo", 1e3},
                                                                           {"mega", 1e6},
                                                                           {"pico", 1e-12},
                                                                           {"giga", 1e9}}};

// Removes the next \word from the text and returns it; empty if the text does not begin with \.
std::string_view take_word(std::string_view& text) {
  if (text.empty() || text.front() != '\\') return {};
  const std::size_t end = std::min(std::min(text.find('\\', 1), text.find('{', 1)), text.size());
  const std::string_view word = text.substr(1, end - 1);
  text.remove_prefix(end);
  return word;
}

// Removes {n} after \tothe from the text and returns n.
std::optional<int> take_power(std::string_view& text) {
  const std::size_t end = text.find('}');
  if (text.empty() || text.front() != '{' || end == text.npos) return std::nullopt;
  int power = 0;
  const auto [after, error] = std::from_chars(text.data() + 1, text.data() + end, power);
  if (error != std::errc() || after != text.data() + end || std::abs(power) > kMostPower)
    return std::nullopt;
  text.remove_prefix(end + 1);
  return power;
}

// Removes one unit with its prefix and power from the text. Returns false if the unit is neither a
// length nor a voltage.
bool take_unit(std::string_view& text, SiUnit& unit) {
  std::string_view word = take_word(text);
  const bool per = word == "per";
  if (per) word = take_word(text);
  double factor = 1;
  for (const auto& [name, of] : kPrefixes)
    if (word == name) {
      factor = of;
      word = take_word(text);
      break;
    }
  int power = per ? -1 : 1;
  if (text.starts_with("\\tothe")) {
    take_word(text);
    const auto n = take_power(text);
    if (!n) return false;
    power *= *n;
  }
  if (word == "metre")
    unit.metre += power;
  else if (word == "volt")
    unit.volt += power;
  else
    return false;
  for (int i = 0; i < std::abs(power); ++i)
    power > 0 ? unit.factor *= factor : unit.factor /= factor;
  return true;
}

}  // namespace

std::optional<SiUnit> si_unit(std::string_view text) {
  SiUnit unit;
  text = trimmed(text);
  if (text.empty()) return std::nullopt;
  while (!text.empty())
    if (!take_unit(text, unit)) return std::nullopt;
  return unit;
}

}  // namespace mdof
