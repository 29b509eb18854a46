// Writes numbers as text with 17 significant digits. schema/base/number/number_round.h finds the
// digits of one number, number_digits.h the digits of eight numbers at a time. This file writes
// them as text.
#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>

#include "schema/base/number/number.h"
#include "schema/base/number/number_digits.h"
#include "schema/base/number/number_round.h"
#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace mdof {
namespace {

using std::uint64_t;

[[gnu::noinline, gnu::cold]] char* write_slowly(char* out, double x) {
  return std::to_chars(out, out + kDouble17Size, x, std::chars_format::general, 17).ptr;
}

constexpr uint64_t kZeros = 0x3030303030303030;  // "00000000"
void store8(char* out, uint64_t v) {
  std::memcpy(out, &v, 8);
}

// The 17 digits of a number in groups of one, eight and eight. A group of eight consists of bytes 0
// ... 9; the first digit is in the lowest byte.
struct Digits {
  uint64_t first, upper, lower;

  // Number of digits up to the last digit that is not 0.
  int significant() const { return (lower ? 17 : 9) - std::countl_zero(lower ? lower : upper) / 8; }
  void store_rest(char* out) const {
    store8(out, upper | kZeros);
    store8(out + 8, lower | kZeros);
  }
};

struct Sixteen {
  uint64_t upper, lower;
};

#ifdef __SSE2__
// Converts two numbers below 10^8 to digits. The eight digits of a number are split into groups of
// four, two and one digits by multiplication with a reciprocal, in all lanes at once.
Sixteen sixteen_digits(uint64_t first, uint64_t second) {
  const __m128i v = _mm_set_epi64x(static_cast<long long>(second), static_cast<long long>(first));
  const __m128i upper4 = _mm_srli_epi64(_mm_mul_epu32(v, _mm_set1_epi64x(0xd1b71759)), 45);
  const __m128i lower4 = _mm_sub_epi64(v, _mm_mul_epu32(upper4, _mm_set1_epi64x(10000)));
  const __m128i fours = _mm_or_si128(upper4, _mm_slli_epi64(lower4, 32));
  const __m128i upper2 = _mm_srli_epi16(_mm_mulhi_epu16(fours, _mm_set1_epi32(5243)), 3);
  const __m128i lower2 = _mm_sub_epi16(fours, _mm_mullo_epi16(upper2, _mm_set1_epi32(100)));
  const __m128i twos = _mm_or_si128(upper2, _mm_slli_epi32(lower2, 16));
  const __m128i upper = _mm_mulhi_epu16(twos, _mm_set1_epi16(6554));
  const __m128i lower = _mm_sub_epi16(twos, _mm_mullo_epi16(upper, _mm_set1_epi16(10)));
  const __m128i bytes = _mm_or_si128(upper, _mm_slli_epi16(lower, 8));
  return {static_cast<uint64_t>(_mm_cvtsi128_si64(bytes)),
          static_cast<uint64_t>(_mm_cvtsi128_si64(_mm_unpackhi_epi64(bytes, bytes)))};
}
#else
uint64_t eight_digits(uint64_t v) {
  const uint64_t fours = v / 10000 | (v % 10000) << 32;
  const uint64_t upper2 = (fours * 10486 >> 20) & 0x0000007f0000007f;
  const uint64_t twos = upper2 | (fours - 100 * upper2) << 16;
  const uint64_t upper = (twos * 103 >> 10) & 0x000f000f000f000f;
  return upper | (twos - 10 * upper) << 8;
}
Sixteen sixteen_digits(uint64_t first, uint64_t second) {
  return {eight_digits(first), eight_digits(second)};
}
#endif

Digits split(uint64_t d) {
  const uint64_t nine = d / 100'000'000;
  const uint64_t first = d / 10'000'000'000'000'000;
  const Sixteen rest = sixteen_digits(nine - first * 100'000'000, d - nine * 100'000'000);
  return {first, rest.upper, rest.lower};
}

// "0.00ddd": -5 < exponent < 0
char* write_below_one(char* out, const Digits& digits, int exponent) {
  std::memcpy(out, "0.000000", 8);
  char* const first = out + 1 - exponent;
  *first = static_cast<char>('0' + digits.first);
  digits.store_rest(first + 1);
  return first + digits.significant();
}

// "ddd.ddd" with `whole` digits before the point, 1 ... 7: the digits after the point are shifted
// by one byte.
char* write_up_to_7_whole(char* out, const Digits& digits, int whole) {
  const uint64_t head = digits.first | digits.upper << 8 | kZeros;
  const uint64_t before = (uint64_t{1} << 8 * whole) - 1;
  digits.store_rest(out + 2);
  store8(out, (head & before) | uint64_t{'.'} << 8 * whole | (head & ~before) << 8);
  return out + (digits.significant() > whole ? digits.significant() + 1 : whole);
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

char* write_digits(char* out, bool negative, const Digits& digits, int exponent) {
  *out = '-';
  out += negative;
  if (exponent >= 0) return write_up_to_7_whole(out, digits, exponent + 1);
  if (exponent >= -4) return write_below_one(out, digits, exponent);
  return write_scientific(out, digits, exponent);
}

void write_eight(FindDigits find, const double* x, DoubleText* out) {
  EightDigits digits;
  const unsigned slow = find(x, digits);
  for (std::size_t i = 0; i < 8; ++i) {
    const bool negative = std::bit_cast<uint64_t>(x[i]) >> 63;
    const Digits of_one{digits.first[i], digits.upper[i], digits.lower[i]};
    const char* const end = slow >> i & 1 ? write_slowly(out[i].text, x[i])
                                          : write_digits(out[i].text, negative, of_one,
                                                         static_cast<int>(digits.exponent[i]));
    out[i].size = static_cast<int>(end - out[i].text);
  }
}

}  // namespace

char* write_double_17(char* out, double x) {
  const uint64_t bits = std::bit_cast<uint64_t>(x);
  const int exponent = static_cast<int>(bits >> 52 & 0x7ff) - kDoubleBias;
  if (exponent < kLeastExponent || exponent > kMostExponent) return write_slowly(out, x);
  const Decimal17 decimal = round_to_17(bits << 11 | uint64_t{1} << 63, exponent);
  const bool certain = decimal.digits - 1 < kMost17Digits;  // not 0, not rounded up to 10^17
  if (!certain || decimal.exponent > kMostPlainExponent) return write_slowly(out, x);
  return write_digits(out, bits >> 63, split(decimal.digits), decimal.exponent);
}

void write_doubles_17(const double* x, std::size_t n, DoubleText* out, InstructionSet set) {
  const FindDigits find = find_digits(set);
  std::size_t i = 0;
  for (; find && i + 8 <= n; i += 8) write_eight(find, x + i, out + i);
  for (; i < n; ++i)
    out[i].size = static_cast<int>(write_double_17(out[i].text, x[i]) - out[i].text);
}

}  // namespace mdof
