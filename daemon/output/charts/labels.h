// Texts and numbers in plots. They are UTF-8, do not depend on the locale, and contain a true minus
// sign.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace mdof::charts {

// 10^exponent as the nearest double. The result is 0 or infinite if a double cannot represent it.
double power_of_ten(int exponent);
// The e in |x| = m · 10^e with 1 <= m < 10; 0 for 0 and non-finite numbers.
int decimal_exponent(double x);

std::string fixed_text(double x, int decimals);     // "−0.50"
std::string number_text(double x, int digits = 4);  // "−0.5", "1.235×10⁶"; not finite: "–"
std::string power_text(int exponent);               // "10⁻⁶"
std::string count_text(std::uint64_t n);            // "1 000 000", without line breaks

// U and u have two significant digits. A value is rounded to the last digit of its uncertainty (GUM
// 7.2.6), or to four significant digits if the uncertainty is unknown. The numbers are in the unit
// of the key. Unknown values are "–".
std::string uncertainty_text(double u);
std::string value_text(double value, double u);

// The name and the unit in a key: "EAX_urad" has the name "EAX" and the unit "µrad". If a key has
// no known unit, `name` is the whole key.
struct Key {
  std::string name, unit;
};
Key split_key(std::string_view key);
// The title of an axis: "EAX / µrad". With exponent -6 it is "EAX / (10⁻⁶ µrad)".
std::string key_label(std::string_view key, int exponent = 0);

// Estimated width in px of a text in a sans-serif font. The estimate is usually too large.
double text_width(std::string_view text, double font_px);
// Shortens a text to at most this number of characters. A shortened text ends in "…".
std::string shortened(std::string_view text, std::size_t characters);

}  // namespace mdof::charts
