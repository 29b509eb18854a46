// Words and numbers in plots: UTF-8, independent of the locale, with a true minus sign.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace mdof::charts {

// A power of ten, rounded once; 0 or infinite outside the range of a double.
double power_of_ten(int exponent);
// The e in |x| = m · 10^e with 1 <= m < 10; 0 for 0 and non-finite numbers.
int decimal_exponent(double x);

std::string fixed_text(double x, int decimals);     // "−0.50"
std::string number_text(double x, int digits = 4);  // "−0.5", "1.235×10⁶"; not finite: "–"
std::string power_text(int exponent);               // "10⁻⁶"
std::string count_text(std::uint64_t n);            // "1 000 000", without line breaks

// A key, divided into name and unit: "EAX_urad" is EAX in µrad. A key without a known unit is all
// name.
struct Key {
  std::string name, unit;
};
Key split_key(std::string_view key);
// "EAX / µrad", or "EAX / (10⁻⁶ µrad)" if the labels are multiples of 10^exponent.
std::string key_label(std::string_view key, int exponent = 0);

// Approximate width in px of a sans-serif text, rather too large than too small.
double text_width(std::string_view text, double font_px);
// At most this number of characters; a longer text ends in "…".
std::string shortened(std::string_view text, std::size_t characters);

}  // namespace mdof::charts
