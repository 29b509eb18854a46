#include "schema/base/number/number_digits_avx512.h"

#include "schema/base/avx512.h"
#include "schema/base/number/number_round.h"

#if defined(__x86_64__)

namespace mdof::avx512 {
namespace {

// The upper halves of 64 by 64 bits.
MDOF_AVX512 inline __m512i multiply_high(__m512i a, __m512i b) {
  const __m512i low = _mm512_set1_epi64(0xffffffff);
  const __m512i a_high = _mm512_srli_epi64(a, 32), b_high = _mm512_srli_epi64(b, 32);
  const __m512i ll = _mm512_mul_epu32(a, b), lh = _mm512_mul_epu32(a, b_high);
  const __m512i hl = _mm512_mul_epu32(a_high, b), hh = _mm512_mul_epu32(a_high, b_high);
  const __m512i middle =
      _mm512_add_epi64(_mm512_add_epi64(_mm512_srli_epi64(ll, 32), _mm512_and_si512(lh, low)),
                       _mm512_and_si512(hl, low));
  return _mm512_add_epi64(_mm512_add_epi64(hh, _mm512_srli_epi64(middle, 32)),
                          _mm512_add_epi64(_mm512_srli_epi64(lh, 32), _mm512_srli_epi64(hl, 32)));
}

struct Powers {
  __m512i high, low;
};
MDOF_AVX512 inline Powers powers_of_ten(__m256i q) {
  const __m256i i = _mm256_slli_epi32(
      _mm256_sub_epi32(q, _mm256_set1_epi32(PowerTable::smallest_power_of_five)), 1);
  const std::uint64_t* const table = PowerTable::power_of_five_128;
  return {_mm512_i32gather_epi64(i, table, 8), _mm512_i32gather_epi64(i, table + 1, 8)};
}
MDOF_AVX512 inline __m256i floor_log2_of_power_of_ten(__m256i q) {
  return _mm256_srai_epi32(_mm256_mullo_epi32(q, _mm256_set1_epi32(1741647)), 19);
}

// round_to_17() of schema/base/number/number_round.h, step by step.
struct Rounded {
  __m512i digits;
  __m256i exponent;
  __mmask8 undecided;
};
MDOF_AVX512 inline Rounded round_to_17(__m512i m, __m256i e) {
  const __m256i one = _mm256_set1_epi32(1);
  __m256i k = _mm256_srai_epi32(_mm256_mullo_epi32(e, _mm256_set1_epi32(315653)), 20);
  const __m256i above = _mm256_add_epi32(k, one);
  const Powers next = powers_of_ten(above);
  const __mmask8 no_tail = _mm512_cmpeq_epi64_mask(next.low, _mm512_setzero_si512());
  const __m512i bound = _mm512_mask_sub_epi64(next.high, no_tail, next.high, _mm512_set1_epi64(1));
  const __mmask8 same_binade = _mm256_cmpeq_epi32_mask(floor_log2_of_power_of_ten(above), e);
  k = _mm256_mask_add_epi32(
      k, static_cast<__mmask8>(same_binade & _mm512_cmpgt_epu64_mask(m, bound)), k, one);
  const __m256i q = _mm256_sub_epi32(_mm256_set1_epi32(16), k);
  const Powers power = powers_of_ten(q);
  const __m512i product_low = _mm512_mullo_epi64(m, power.high);
  const __m512i low = _mm512_add_epi64(product_low, multiply_high(m, power.low));
  const __m512i product_high = multiply_high(m, power.high);
  const __m512i high = _mm512_mask_add_epi64(
      product_high, _mm512_cmplt_epu64_mask(low, product_low), product_high, _mm512_set1_epi64(1));
  const __m512i shift = _mm512_cvtepi32_epi64(
      _mm256_sub_epi32(_mm256_sub_epi32(_mm256_set1_epi32(62), e), floor_log2_of_power_of_ten(q)));
  const __m512i fraction =
      _mm512_or_si512(_mm512_sllv_epi64(high, _mm512_sub_epi64(_mm512_set1_epi64(64), shift)),
                      _mm512_srlv_epi64(low, shift));
  const __m512i near_half =
      _mm512_sub_epi64(fraction, _mm512_set1_epi64(static_cast<long long>((1ull << 63) - 3)));
  return {_mm512_add_epi64(_mm512_srlv_epi64(high, shift), _mm512_srli_epi64(fraction, 63)), k,
          _mm512_cmple_epu64_mask(near_half, _mm512_set1_epi64(6))};
}

// Numbers below 10^8 as eight bytes 0 ... 9, the first digit lowest: halves, quarters, eighths by
// multiplication with a reciprocal.
MDOF_AVX512 inline __m512i digits_of(__m512i v) {
  const __m512i upper4 = _mm512_srli_epi64(_mm512_mul_epu32(v, _mm512_set1_epi64(0xd1b71759)), 45);
  const __m512i lower4 = _mm512_sub_epi64(v, _mm512_mul_epu32(upper4, _mm512_set1_epi64(10000)));
  const __m512i fours = _mm512_or_si512(upper4, _mm512_slli_epi64(lower4, 32));
  const __m512i upper2 = _mm512_srli_epi16(_mm512_mulhi_epu16(fours, _mm512_set1_epi32(5243)), 3);
  const __m512i lower2 =
      _mm512_sub_epi16(fours, _mm512_mullo_epi16(upper2, _mm512_set1_epi32(100)));
  const __m512i twos = _mm512_or_si512(upper2, _mm512_slli_epi32(lower2, 16));
  const __m512i upper = _mm512_mulhi_epu16(twos, _mm512_set1_epi16(6554));
  const __m512i lower = _mm512_sub_epi16(twos, _mm512_mullo_epi16(upper, _mm512_set1_epi16(10)));
  return _mm512_or_si512(upper, _mm512_slli_epi16(lower, 8));
}

// 17 digits to 1 + 8 + 8.
MDOF_AVX512 inline void split(__m512i digits, EightDigits& out) {
  const __m512i ten8 = _mm512_set1_epi64(100'000'000);
  const __m512i nine = _mm512_srli_epi64(  // digits / 10^8
      multiply_high(digits, _mm512_set1_epi64(static_cast<long long>(0xabcc77118461cefd))), 26);
  const __m512i first =  // nine / 10^8
      _mm512_srli_epi64(_mm512_mul_epu32(nine, _mm512_set1_epi64(0x55e63b89)), 57);
  const __m512i upper = digits_of(_mm512_sub_epi64(nine, _mm512_mul_epu32(first, ten8)));
  const __m512i lower = digits_of(_mm512_sub_epi64(digits, _mm512_mul_epu32(nine, ten8)));
  const __mmask8 short_one = _mm512_cmpeq_epi64_mask(lower, _mm512_setzero_si512());
  const __m512i zeros =
      _mm512_srli_epi64(_mm512_lzcnt_epi64(_mm512_mask_blend_epi64(short_one, lower, upper)), 3);
  const __m512i most =
      _mm512_mask_blend_epi64(short_one, _mm512_set1_epi64(17), _mm512_set1_epi64(9));
  _mm512_storeu_si512(out.first, first);
  _mm512_storeu_si512(out.upper, upper);
  _mm512_storeu_si512(out.lower, lower);
  _mm512_storeu_si512(out.significant, _mm512_sub_epi64(most, zeros));
}

}  // namespace

MDOF_AVX512 unsigned find_digits(const double* x, EightDigits& digits) {
  const __m512i bits = _mm512_loadu_si512(x);
  const __m512i biased = _mm512_and_si512(_mm512_srli_epi64(bits, 52), _mm512_set1_epi64(0x7ff));
  const __mmask8 out_of_range = _mm512_cmpgt_epu64_mask(
      _mm512_sub_epi64(biased, _mm512_set1_epi64(kDoubleBias + kLeastExponent)),
      _mm512_set1_epi64(kMostExponent - kLeastExponent));
  const __m256i e =
      _mm256_maskz_sub_epi32(static_cast<__mmask8>(~out_of_range), _mm512_cvtepi64_epi32(biased),
                             _mm256_set1_epi32(kDoubleBias));
  const __m512i m = _mm512_or_si512(_mm512_slli_epi64(bits, 11),
                                    _mm512_set1_epi64(static_cast<long long>(1ull << 63)));
  const Rounded rounded = round_to_17(m, e);
  split(rounded.digits, digits);
  _mm512_storeu_si512(digits.exponent, _mm512_cvtepi32_epi64(rounded.exponent));
  const __mmask8 too_many = _mm512_cmpgt_epu64_mask(
      rounded.digits, _mm512_set1_epi64(static_cast<long long>(kMost17Digits)));
  const __mmask8 too_large =
      _mm256_cmpgt_epi32_mask(rounded.exponent, _mm256_set1_epi32(kMostPlainExponent));
  return out_of_range | rounded.undecided | too_many | too_large;
}

}  // namespace mdof::avx512

#else

namespace mdof::avx512 {
unsigned find_digits(const double*, EightDigits&) {
  return 0xff;
}
}  // namespace mdof::avx512

#endif
