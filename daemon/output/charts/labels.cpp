#include "daemon/output/charts/labels.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "schema/base/number/number.h"
#include "schema/base/number/uncertainty_digits.h"

namespace mdof::charts {
namespace {

struct Unit {
  const char* suffix;
  const char* sign;
};
constexpr std::array<Unit, 19> kUnits = {{{"um", "µm"},
                                          {"nm", "nm"},
                                          {"mm", "mm"},
                                          {"m", "m"},
                                          {"urad", "µrad"},
                                          {"nrad", "nrad"},
                                          {"mrad", "mrad"},
                                          {"rad", "rad"},
                                          {"deg", "°"},
                                          {"percent", "%"},
                                          {"ppm", "ppm"},
                                          {"K", "K"},
                                          {"C", "°C"},
                                          {"ns", "ns"},
                                          {"ms", "ms"},
                                          {"s", "s"},
                                          {"hz", "Hz"},
                                          {"mV", "mV"},
                                          {"V", "V"}}};

constexpr const char* kMinus = "−";

// Replaces the hyphen in a text of std::to_chars by a true minus sign.
std::string with_minus(std::string_view digits) {
  return digits.starts_with('-') ? kMinus + std::string(digits.substr(1)) : std::string(digits);
}

bool begins_character(char c) {
  return (c & 0xC0) != 0x80;  // only continuation bytes of UTF-8 begin with 10
}

// x, rounded to the second significant digit of u.
std::string rounded_text(double x, double u) {
  const int decimals = uncertainty_decimals(u);
  return fixed_text(rounded_to_tens(x, decimals), std::max(0, decimals));
}

}  // namespace

double power_of_ten(int exponent) {
  const std::string text = "1e" + std::to_string(exponent);
  double power = 0;
  parse_double(text.data(), text.data() + text.size(), power);
  return power;
}

int decimal_exponent(double x) {
  if (x == 0 || !std::isfinite(x)) return 0;
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, x, std::chars_format::scientific);
  const std::string_view text(buffer, static_cast<std::size_t>(end.ptr - buffer));
  const bool negative = text[text.find('e') + 1] == '-';
  int exponent = 0;
  std::from_chars(text.data() + text.find('e') + 2, end.ptr, exponent);
  return negative ? -exponent : exponent;
}

std::string fixed_text(double x, int decimals) {
  if (!std::isfinite(x)) return "–";
  char buffer[700];  // 309 digits before the decimal point and at most 340 digits after the point
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, x, std::chars_format::fixed,
                                 std::clamp(decimals, 0, 340));
  const std::string_view text(buffer, static_cast<std::size_t>(end.ptr - buffer));
  const bool zero = text.find_first_of("123456789") == std::string_view::npos;
  return with_minus(zero && text.starts_with('-') ? text.substr(1) : text);
}

std::string number_text(double x, int digits) {
  if (!std::isfinite(x)) return "–";
  if (x == 0) return "0";
  char buffer[64];
  const auto end =
      std::to_chars(buffer, buffer + sizeof buffer, x, std::chars_format::general, digits);
  const std::string_view text(buffer, static_cast<std::size_t>(end.ptr - buffer));
  const std::size_t e = text.find('e');
  if (e == std::string_view::npos) return with_minus(text);
  int exponent = 0;
  std::from_chars(text.data() + e + (text[e + 1] == '+' ? 2 : 1), end.ptr, exponent);
  return with_minus(text.substr(0, e)) + "×" + power_text(exponent);
}

std::string uncertainty_text(double u) {
  if (u == 0) return "0";
  return u > 0 && std::isfinite(u) ? rounded_text(u, u) : "–";
}

std::string value_text(double value, double u) {
  return u > 0 && std::isfinite(u) ? rounded_text(value, u) : number_text(value);
}

std::string power_text(int exponent) {
  constexpr std::array<const char*, 10> kSuperscript = {"⁰", "¹", "²", "³", "⁴",
                                                        "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "10⁻" : "10";
  for (const char digit : std::to_string(std::abs(exponent)))
    text += kSuperscript[static_cast<std::size_t>(digit - '0')];
  return text;
}

std::string count_text(std::uint64_t n) {
  const std::string digits = std::to_string(n);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += "\u00a0";
    text += digits[i];
  }
  return text;
}

Key split_key(std::string_view key) {
  const std::size_t at = key.rfind('_');
  if (at == std::string_view::npos || at == 0) return {std::string(key), ""};
  const auto unit = std::find_if(kUnits.begin(), kUnits.end(),
                                 [&](const Unit& u) { return u.suffix == key.substr(at + 1); });
  if (unit == kUnits.end()) return {std::string(key), ""};
  return {std::string(key.substr(0, at)), unit->sign};
}

std::string key_label(std::string_view key, int exponent) {
  const auto [name, unit] = split_key(key);
  const std::string label = shortened(name, 48);
  if (exponent == 0) return unit.empty() ? label : label + " / " + unit;
  return label + " / " +
         (unit.empty() ? power_text(exponent) : "(" + power_text(exponent) + " " + unit + ")");
}

double text_width(std::string_view text, double font_px) {
  double ems = 0;
  for (const char c : text) {
    if (!begins_character(c)) continue;
    if (std::string_view("fijlrtI.,:;|!'()[]/ ").find(c) != std::string_view::npos)
      ems += 0.4;
    else
      ems += std::string_view("mwMW@%").find(c) != std::string_view::npos ? 0.96 : 0.65;
  }
  return ems * font_px;
}

std::string shortened(std::string_view text, std::size_t characters) {
  std::size_t n = 0, cut = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!begins_character(text[i])) continue;
    if (n + 1 == characters) cut = i;
    if (++n > characters) return std::string(text.substr(0, cut)) + "…";
  }
  return std::string(text);
}

}  // namespace mdof::charts
