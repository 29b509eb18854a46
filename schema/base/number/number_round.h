// Finds 17 digits of a double: x = m·2^e becomes the integer D = round(x·10^q), 10^16 <= D < 10^17,
// by one multiplication with a 128-bit power of ten. The error of the product is less than one unit
// of its last bit. Therefore the rounding is certain, unless the fraction of x·10^q is within a few
// such units of 1/2; std::to_chars is then used. (The method is that of Grisu and Ryu printf, with
// the table of fast_float, valid for 1e-292 ... 1e308.)
#pragma once

#include <fast_float/fast_float.h>

#include <cstdint>

namespace mdof {

using PowerTable = fast_float::powers;
__extension__ using Uint128 = unsigned __int128;

// Range of exponents for which round_to_17() is used: 1e-98 < 2^-325 and 2^24 > 1e7.
inline constexpr int kDoubleBias = 1023, kLeastExponent = -325, kMostExponent = 23;
inline constexpr int kMostPlainExponent = 6;  // largest exponent printed without "e": ddddddd.ddd
inline constexpr std::uint64_t kMost17Digits = 99'999'999'999'999'999;

struct PowerOfTen {
  // 10^q = (high·2^64 + low) · 2^(floor_log2(q) - 127); the error of `low` is below 1
  std::uint64_t high, low;
};
inline PowerOfTen power_of_ten(int q) {
  const int i = 2 * (q - PowerTable::smallest_power_of_five);
  return {PowerTable::power_of_five_128[i], PowerTable::power_of_five_128[i + 1]};
}
inline int floor_log2_of_power_of_ten(int q) {
  return (q * 1741647) >> 19;
}  // valid for |q| <= 1200
inline int floor_log10_of_power_of_two(int e) {
  return (e * 315653) >> 20;
}  // valid for |e| <= 1650

// x = digits · 10^(exponent - 16)
struct Decimal17 {
  std::uint64_t digits = 0;  // 17 digits, or 10^17; 0: the rounding is not certain
  int exponent = 0;
};

// x = m · 2^(e - 63) with the top bit of m set.
inline Decimal17 round_to_17(std::uint64_t m, int e) {
  int k = floor_log10_of_power_of_two(e);  // floor(log10(x)), except next to a power of ten
  const PowerOfTen next = power_of_ten(k + 1);
  const bool same_binade = floor_log2_of_power_of_ten(k + 1) == e;
  k += same_binade & (m > next.high - (next.low == 0));
  const int q = 16 - k;
  const PowerOfTen power = power_of_ten(q);
  const Uint128 low = static_cast<Uint128>(m) * power.low;
  const Uint128 product =
      static_cast<Uint128>(m) * power.high + static_cast<std::uint64_t>(low >> 64);
  const std::uint64_t high = static_cast<std::uint64_t>(product >> 64);
  // x·10^q = product · 2^-(64 + shift), 7 <= shift <= 11
  const int shift = 62 - e - floor_log2_of_power_of_ten(q);
  const std::uint64_t fraction =
      high << (64 - shift) | static_cast<std::uint64_t>(product) >> shift;
  // The fraction is too near to one half, or is exactly one half.
  if (fraction - ((std::uint64_t{1} << 63) - 3) <= 6) return {};
  return {(high >> shift) + (fraction >> 63), k};
}

}  // namespace mdof
