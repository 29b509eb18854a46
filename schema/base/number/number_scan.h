// The innermost loop of every CSV reader. It reads a plain decimal number [-]ddd.ddd from a field
// whose ends are known, sixteen digits at a time and without branches that depend on the data.
// Other fields (with an exponent or more digits) must be read by parse_double().
#pragma once

#include <fast_float/fast_float.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace mdof {

// Number of bytes before and after a field that must be readable; their values have no effect.
inline constexpr int kScanMargin = 32;

inline constexpr std::uint64_t kPowersOfTen[] = {1,
                                                 10,
                                                 100,
                                                 1'000,
                                                 10'000,
                                                 100'000,
                                                 1'000'000,
                                                 10'000'000,
                                                 100'000'000,
                                                 1'000'000'000,
                                                 10'000'000'000,
                                                 100'000'000'000,
                                                 1'000'000'000'000,
                                                 10'000'000'000'000,
                                                 100'000'000'000'000,
                                                 1'000'000'000'000'000,
                                                 10'000'000'000'000'000,
                                                 100'000'000'000'000'000,
                                                 1'000'000'000'000'000'000};
// The same powers of ten as doubles, and all larger powers that a double represents exactly.
inline constexpr int kLargestExactPower = 22;
inline constexpr double kExactPowers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                          1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                          1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

// value = ±mantissa / 10^fraction_digits, at most 18 fraction digits
struct ScannedNumber {
  std::uint64_t mantissa = 0;
  unsigned fraction_digits = 0;
  unsigned negative = 0;  // 0 or 1
};

#ifdef __SSE2__
namespace detail {

inline __m128i load16(const void* p) {
  return _mm_loadu_si128(static_cast<const __m128i*>(p));
}

// Bit i of the result: byte i of the vector is c. (This is also the fast way to compare a single
// byte: for *p == c the compiler uses setcc, which writes only a part of a register and must wait
// for the previous result in that register.)
inline unsigned equal(__m128i text, char c) {
  return static_cast<unsigned>(_mm_movemask_epi8(_mm_cmpeq_epi8(text, _mm_set1_epi8(c))));
}

// Returns a mask of the last n bytes of a vector, 0 <= n <= 16.
inline __m128i last(std::size_t n) {
  alignas(32) static constexpr signed char kMask[32] = {0,  0,  0,  0,  0,  0,  0,  0,  //
                                                        0,  0,  0,  0,  0,  0,  0,  0,  //
                                                        -1, -1, -1, -1, -1, -1, -1, -1,
                                                        -1, -1, -1, -1, -1, -1, -1, -1};
  return load16(kMask + n);
}

// Converts sixteen characters to four numbers of four digits. Only the last n characters are used;
// the others count as '0'. If one of the n characters is not a digit, the top bit of a byte in
// `wrong` is set.
inline __m128i four_digits_each(__m128i text, std::size_t n, __m128i& wrong) {
  const __m128i d = _mm_and_si128(_mm_sub_epi8(text, _mm_set1_epi8('0')), last(n));
  wrong = _mm_adds_epu8(d, _mm_set1_epi8(127 - 9));
  // in each 16 bits (a + 256 b) (256·10 + 1) = 256 (10 a + b) + a; the part above 2^16 is lost
  const __m128i twos = _mm_srli_epi16(_mm_mullo_epi16(d, _mm_set1_epi16(2561)), 8);
  return _mm_madd_epi16(twos, _mm_set1_epi32(1 << 16 | 100));
}

// Converts two vectors of four numbers with four digits to one vector of four numbers with eight
// digits.
inline __m128i eight_digits_each(__m128i first, __m128i second) {
  return _mm_madd_epi16(_mm_packs_epi32(first, second), _mm_set1_epi32(1 << 16 | 10000));
}

inline std::uint64_t join(std::uint64_t two_eights) {
  return (two_eights & 0xffffffff) * 100'000'000 + (two_eights >> 32);
}

inline bool sixteen_digits(__m128i text, std::size_t n, std::uint64_t& value) {
  __m128i wrong;
  const __m128i fours = four_digits_each(text, n, wrong);
  value = join(static_cast<std::uint64_t>(_mm_cvtsi128_si64(eight_digits_each(fours, fours))));
  return _mm_movemask_epi8(wrong) == 0;
}

// Reads up to 16 characters. The digits before the decimal point are moved by one byte, so that all
// digits are contiguous.
inline bool scan_short(const char* p, const char* end, std::size_t point, ScannedNumber& number) {
  const std::size_t size = static_cast<std::size_t>(end - p);
  const __m128i text = load16(end - 16);
  if (point == size) {
    number.fraction_digits = 0;
    return size != number.negative && sixteen_digits(text, size - number.negative, number.mantissa);
  }
  const std::size_t fraction = size - point - 1, n = size - number.negative - 1;
  const __m128i behind = last(fraction);
  const __m128i in_a_row =
      _mm_or_si128(_mm_and_si128(behind, text), _mm_andnot_si128(behind, load16(end - 17)));
  number.fraction_digits = static_cast<unsigned>(fraction);
  return n != 0 && sixteen_digits(in_a_row, n, number.mantissa);
}

// Reads up to 8 digits before the decimal point and 16 digits after it at once, then up to two more
// digits one by one. The number may have 19 digits in all.
inline bool scan_long(const char* p, const char* end, std::size_t point, ScannedNumber& number) {
  const std::size_t whole = point - number.negative;
  const std::size_t fraction = static_cast<std::size_t>(end - p) - point - 1;
  if (whole - 1 > 7 || fraction > 18 || whole + fraction > 19) return false;
  const std::size_t at_once = fraction < 16 ? fraction : 16;
  __m128i wrong_before, wrong_behind;
  const __m128i before = four_digits_each(load16(p + point - 16), whole, wrong_before);
  const __m128i behind = four_digits_each(load16(end - 16), at_once, wrong_behind);
  if (_mm_movemask_epi8(_mm_or_si128(wrong_before, wrong_behind))) return false;
  const __m128i eights = eight_digits_each(before, behind);
  std::uint64_t head = static_cast<std::uint64_t>(_mm_cvtsi128_si64(eights)) >> 32;
  const char* q = p + point + 1;
  for (std::size_t left = fraction - at_once; left > 0; --left, ++q) {
    const unsigned digit = static_cast<unsigned char>(*q - '0');
    if (digit > 9) return false;
    head = head * 10 + digit;
  }
  const __m128i tail = _mm_unpackhi_epi64(eights, eights);
  number.mantissa =
      head * kPowersOfTen[at_once] + join(static_cast<std::uint64_t>(_mm_cvtsi128_si64(tail)));
  number.fraction_digits = static_cast<unsigned>(fraction);
  return true;
}

}  // namespace detail

// Reads the field [p, end) as a plain number. Reads up to kScanMargin bytes before p and after p.
inline bool scan_number(const char* p, const char* end, ScannedNumber& number) {
  const std::size_t size = static_cast<std::size_t>(end - p);
  if (size - 1 > 20) return false;
  const __m128i text = detail::load16(p);
  const unsigned points = detail::equal(text, '.');
  number.negative = detail::equal(text, '-') & 1;
  const unsigned at = static_cast<unsigned>(std::countr_zero(points | 1u << size));
  if (size <= 16) return detail::scan_short(p, end, at, number);
  return at < 16 && detail::scan_long(p, end, at, number);
}
#else
inline bool scan_number(const char*, const char*, ScannedNumber&) {
  return false;
}
#endif

// Returns the double that is nearest to a scanned number.
inline double to_double(const ScannedNumber& number) {
  const std::uint64_t sign = static_cast<std::uint64_t>(number.negative) << 63;
  if (number.mantissa < 1'000'000'000'000'000) {
    // mantissa and power are exact, so only the division rounds
    const double magnitude = static_cast<double>(static_cast<std::int64_t>(number.mantissa)) /
                             kExactPowers[number.fraction_digits];
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(magnitude) | sign);
  }
  // for powers 10^-18 ... 10^0 compute_float() never fails, so that am.power2 >= 0
  const fast_float::adjusted_mantissa am =
      fast_float::compute_float<fast_float::binary_format<double>>(
          -static_cast<int>(number.fraction_digits), number.mantissa);
  return std::bit_cast<double>(am.mantissa | static_cast<std::uint64_t>(am.power2) << 52 | sign);
}

}  // namespace mdof
