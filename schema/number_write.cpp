// 17 digits of a double: x = m·2^e becomes the integer D = round(x·10^q), 10^16 <= D < 10^17, by
// one multiplication with a 128-bit power of ten. Its error is below one unit of the 128 bits, so
// the rounding is certain unless the fraction lies within that of a half; then std::to_chars
// decides. (The idea of Grisu and Ryu printf, with the table of fast_float, good for 1e-292 ...
// 1e308.)
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>

#include "schema/number.h"
#include "schema/number_scan.h"

namespace mdof {
namespace {

using std::uint64_t;
__extension__ using uint128_t = unsigned __int128;

char* write_slowly(char* out, double x) {
  return std::to_chars(out, out + kDouble17Size, x, std::chars_format::general, 17).ptr;
}

struct Power {
  uint64_t high, low;  // 10^q = (high·2^64 + low) · 2^(floor_log2(q) - 127), within 1 of low
};
Power power_of_ten(int q) {
  using Table = fast_float::powers;
  const int i = 2 * (q - Table::smallest_power_of_five);
  return {Table::power_of_five_128[i], Table::power_of_five_128[i + 1]};
}
int floor_log2_of_power_of_ten(int q) {
  return (q * 1741647) >> 19;
}  // |q| <= 1200
int floor_log10_of_power_of_two(int e) {
  return (e * 315653) >> 20;
}  // |e| <= 1650

// x = digits · 10^(exponent - 16)
struct Decimal {
  uint64_t digits = 0;  // 17 of them; 0: not decided
  int exponent = 0;
};

// x = m · 2^(e - 63) with the top bit of m set.
Decimal round_to_17(uint64_t m, int e) {
  int k = floor_log10_of_power_of_two(e);  // floor(log10(x)), but for the next power of ten
  const Power next = power_of_ten(k + 1);
  const bool same_binade = floor_log2_of_power_of_ten(k + 1) == e;
  k += same_binade & (m > next.high - (next.low == 0));
  const int q = 16 - k;
  const Power power = power_of_ten(q);
  const uint128_t low = static_cast<uint128_t>(m) * power.low;
  const uint128_t product =
      static_cast<uint128_t>(m) * power.high + static_cast<uint64_t>(low >> 64);
  const uint64_t high = static_cast<uint64_t>(product >> 64);
  // x·10^q = product · 2^-(64 + shift), 7 <= shift <= 11
  const int shift = 62 - e - floor_log2_of_power_of_ten(q);
  const uint64_t fraction = high << (64 - shift) | static_cast<uint64_t>(product) >> shift;
  if (fraction - ((uint64_t{1} << 63) - 3) <= 6) return {};  // too near to a half, or a tie
  return {(high >> shift) + (fraction >> 63), k};
}

constexpr uint64_t kZeros = 0x3030303030303030;  // "00000000"
void store8(char* out, uint64_t v) {
  std::memcpy(out, &v, 8);
}

#ifdef __SSE2__
// Sixteen digits of two numbers below 10^8 as bytes 0 ... 9, the first digit in the lowest byte:
// halves, quarters, eighths of the digits by multiplication with a reciprocal, all lanes at once.
struct Sixteen {
  __m128i bytes;
  Sixteen(uint64_t first, uint64_t second) {
    const __m128i v = _mm_set_epi64x(static_cast<long long>(second), static_cast<long long>(first));
    const __m128i upper4 = _mm_srli_epi64(_mm_mul_epu32(v, _mm_set1_epi64x(0xd1b71759)), 45);
    const __m128i lower4 = _mm_sub_epi64(v, _mm_mul_epu32(upper4, _mm_set1_epi64x(10000)));
    const __m128i fours = _mm_or_si128(upper4, _mm_slli_epi64(lower4, 32));
    const __m128i upper2 = _mm_srli_epi16(_mm_mulhi_epu16(fours, _mm_set1_epi32(5243)), 3);
    const __m128i lower2 = _mm_sub_epi16(fours, _mm_mullo_epi16(upper2, _mm_set1_epi32(100)));
    const __m128i twos = _mm_or_si128(upper2, _mm_slli_epi32(lower2, 16));
    const __m128i upper = _mm_mulhi_epu16(twos, _mm_set1_epi16(6554));
    const __m128i lower = _mm_sub_epi16(twos, _mm_mullo_epi16(upper, _mm_set1_epi16(10)));
    bytes = _mm_or_si128(upper, _mm_slli_epi16(lower, 8));
  }
  uint64_t first8() const { return static_cast<uint64_t>(_mm_cvtsi128_si64(bytes)); }
  void store(char* out) const {
    _mm_storeu_si128(reinterpret_cast<__m128i*>(out), _mm_or_si128(bytes, _mm_set1_epi8('0')));
  }
  int significant() const {  // up to the last that is not 0
    const int zeros = _mm_movemask_epi8(_mm_cmpeq_epi8(bytes, _mm_setzero_si128()));
    return std::bit_width(static_cast<unsigned>(zeros) ^ 0xffffu);
  }
};
#else
struct Sixteen {
  uint64_t bytes[2];
  Sixteen(uint64_t first, uint64_t second) : bytes{spread(first), spread(second)} {}
  static uint64_t spread(uint64_t v) {
    const uint64_t fours = v / 10000 | (v % 10000) << 32;
    const uint64_t upper2 = (fours * 10486 >> 20) & 0x0000007f0000007f;
    const uint64_t twos = upper2 | (fours - 100 * upper2) << 16;
    const uint64_t upper = (twos * 103 >> 10) & 0x000f000f000f000f;
    return upper | (twos - 10 * upper) << 8;
  }
  uint64_t first8() const { return bytes[0]; }
  void store(char* out) const {
    store8(out, bytes[0] | kZeros);
    store8(out + 8, bytes[1] | kZeros);
  }
  int significant() const {
    const int tail = std::countl_zero(bytes[1] ? bytes[1] : bytes[0]) / 8;
    return (bytes[1] ? 16 : 8) - tail;
  }
};
#endif

// The 17 digits of a Decimal.
struct Digits {
  uint64_t first;
  Sixteen rest;
  int significant() const { return 1 + rest.significant(); }
};

Digits split(uint64_t d) {
  const uint64_t upper = d / 100000000;
  const uint64_t first = d / 10000000000000000;
  return {first, Sixteen(upper - first * 100000000, d - upper * 100000000)};
}

// "0.00ddd": -5 < exponent < 0
char* write_below_one(char* out, const Digits& digits, int exponent) {
  std::memcpy(out, "0.000000", 8);
  char* const first = out + 1 - exponent;
  *first = static_cast<char>('0' + digits.first);
  digits.rest.store(first + 1);
  return first + digits.significant();
}

// "ddd.ddd" with `whole` digits before the point, 1 ... 7: the digits behind it move by one byte.
char* write_up_to_7_whole(char* out, const Digits& digits, int whole) {
  const uint64_t head = digits.first | digits.rest.first8() << 8 | kZeros;
  const uint64_t before = (uint64_t{1} << 8 * whole) - 1;
  digits.rest.store(out + 2);
  store8(out, (head & before) | uint64_t{'.'} << 8 * whole | (head & ~before) << 8);
  const int significant = digits.significant();
  return out + (significant > whole ? significant + 1 : whole);
}

// "d.ddde-05": -99 <= exponent < -4
char* write_scientific(char* out, const Digits& digits, int exponent) {
  out = write_up_to_7_whole(out, digits, 1);
  const int tens = -exponent / 10;
  std::memcpy(out, "e-", 2);
  out[2] = static_cast<char>('0' + tens);
  out[3] = static_cast<char>('0' - exponent - 10 * tens);
  return out + 4;
}

char* write_decimal(char* out, const Decimal& decimal) {
  const Digits digits = split(decimal.digits);
  if (decimal.exponent >= 0) return write_up_to_7_whole(out, digits, decimal.exponent + 1);
  if (decimal.exponent >= -4) return write_below_one(out, digits, decimal.exponent);
  return write_scientific(out, digits, decimal.exponent);
}

}  // namespace

char* write_double_17(char* out, double x) {
  const uint64_t bits = std::bit_cast<uint64_t>(x);
  const int biased = static_cast<int>(bits >> 52 & 0x7ff);
  constexpr int kBias = 1023, kLeast = -325, kMost = 23;  // 1e-98 < 2^-325, 2^24 > 1e7
  if (biased < kBias + kLeast || biased > kBias + kMost) return write_slowly(out, x);
  const Decimal decimal = round_to_17(bits << 11 | uint64_t{1} << 63, biased - kBias);
  const bool certain = decimal.digits - 1 < 99999999999999999;  // not 0, not rounded up to 10^17
  if (!certain || decimal.exponent >= 7) return write_slowly(out, x);
  *out = '-';
  return write_decimal(out + (bits >> 63), decimal);
}

}  // namespace mdof
