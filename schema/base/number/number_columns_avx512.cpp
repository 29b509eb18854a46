#include "schema/base/number/number_columns_avx512.h"

#include <array>

#include "schema/base/avx512.h"
#include "schema/base/number/number_scan.h"

#if defined(__x86_64__)
namespace mdof::avx512 {
namespace {

// Characters of a field are looked at as bits: element j belongs to field j, and its highest bit to
// the field's last character.
struct Seen {
  __m256i stop, point, minus, digit;
};

struct Layout {
  __m256i digits;    // the characters that are digits of the field
  __m256i fraction;  // the characters behind the point; all where there is none
  __m256i behind;    // how many digits those are; 0 where there is no point
  __mmask8 negative;
  __mmask8 odd;  // not [-]ddd.ddd, or longer than was looked at
};

// The highest n bits of 32, 0 <= n <= 32.
MDOF_AVX512 inline __m256i top(__m256i n) {
  return _mm256_sllv_epi32(_mm256_set1_epi32(-1), _mm256_sub_epi32(_mm256_set1_epi32(32), n));
}

MDOF_AVX512 inline Layout find_layout(const Seen& seen) {
  const __m256i zero = _mm256_setzero_si256(), all = _mm256_set1_epi32(32);
  const __m256i size = _mm256_lzcnt_epi32(seen.stop);
  const __m256i field = top(size);
  const __m256i first = _mm256_and_si256(field, _mm256_sub_epi32(zero, field));
  const __m256i points = _mm256_and_si256(seen.point, field);
  const __m256i signs = _mm256_and_si256(seen.minus, field);
  const __m256i after = _mm256_lzcnt_epi32(points);
  Layout layout;
  layout.digits = _mm256_and_si256(seen.digit, field);
  layout.fraction = top(after);
  layout.behind = _mm256_and_si256(after, _mm256_set1_epi32(31));
  layout.negative = _mm256_test_epi32_mask(signs, signs);
  const __m256i known = _mm256_or_si256(layout.digits, _mm256_or_si256(points, signs));
  const __m256i second_point =
      _mm256_and_si256(points, _mm256_sub_epi32(points, _mm256_set1_epi32(1)));
  const __m256i late_sign = _mm256_andnot_si256(first, signs);
  const __m256i odd =
      _mm256_or_si256(_mm256_xor_si256(known, field), _mm256_or_si256(second_point, late_sign));
  layout.odd = static_cast<__mmask8>(_mm256_test_epi32_mask(odd, odd) |
                                     _mm256_cmpeq_epi32_mask(layout.digits, zero) |
                                     _mm256_cmpeq_epi32_mask(size, all));
  return layout;
}

MDOF_AVX512 inline std::uint64_t stops_in(__m512i text) {
  return _mm512_cmplt_epi8_mask(text, _mm512_set1_epi8('-'));
}
MDOF_AVX512 inline std::uint64_t found(__m512i text, char c) {
  return _mm512_cmpeq_epi8_mask(text, _mm512_set1_epi8(c));
}
MDOF_AVX512 inline std::uint64_t digits_in(__m512i text) {
  return _mm512_cmplt_epu8_mask(_mm512_sub_epi8(text, _mm512_set1_epi8('0')), _mm512_set1_epi8(10));
}

// Digits in a row, as numbers of four: those behind the point from where they are, those before it
// from one place earlier.
MDOF_AVX512 inline __m512i fours(__m512i text, std::uint64_t behind_point, __m512i earlier,
                                 std::uint64_t before_point) {
  const __m512i zero = _mm512_set1_epi8('0');
  const __m512i behind = _mm512_maskz_sub_epi8(behind_point, text, zero);
  const __m512i digits = _mm512_mask_sub_epi8(behind, before_point, earlier, zero);
  const __m512i twos = _mm512_maddubs_epi16(digits, _mm512_set1_epi16(1 << 8 | 10));
  return _mm512_madd_epi16(twos, _mm512_set1_epi32(1 << 16 | 100));
}

// Two times numbers of four digits as numbers of eight, 128 bits of each in turns.
MDOF_AVX512 inline __m512i eights(__m512i first, __m512i second) {
  return _mm512_madd_epi16(_mm512_packus_epi32(first, second), _mm512_set1_epi32(1 << 16 | 10000));
}

// Per 64 bits two numbers of eight digits, the first in the lower half, as one.
MDOF_AVX512 inline __m512i sixteens(__m512i eights) {
  return _mm512_add_epi64(_mm512_mul_epu32(eights, _mm512_set1_epi64(100'000'000)),
                          _mm512_srli_epi64(eights, 32));
}

// Eight fields as far as their bits go.
struct Plain {
  __m512i mantissa;
  __m512i behind;  // digits behind the point
  __mmask8 negative, odd;
};

// Fields of up to 15 characters: the last 16 of each, four fields to a register.
class Narrow {
 public:
  MDOF_AVX512 static inline Plain read(const ColumnText& column) {
    const __m512i text[2] = {four(column, 0), four(column, 4)};
    const Layout layout = find_layout({of_fields(stops_in(text[0]), stops_in(text[1])),
                                       of_fields(found(text[0], '.'), found(text[1], '.')),
                                       of_fields(found(text[0], '-'), found(text[1], '-')),
                                       of_fields(digits_in(text[0]), digits_in(text[1]))});
    const __m128i behind = of_text(_mm256_and_si256(layout.digits, layout.fraction));
    const __m128i before =
        of_text(_mm256_andnot_si256(layout.fraction, _mm256_slli_epi32(layout.digits, 1)));
    const __m512i in_turns =
        eights(fours(text[0], half(behind, 0), _mm512_bslli_epi128(text[0], 1), half(before, 0)),
               fours(text[1], half(behind, 1), _mm512_bslli_epi128(text[1], 1), half(before, 1)));
    const __m512i order = _mm512_setr_epi64(0, 2, 4, 6, 1, 3, 5, 7);
    return {_mm512_permutexvar_epi64(order, sixteens(in_turns)),
            _mm512_cvtepu32_epi64(layout.behind), layout.negative, layout.odd};
  }

 private:
  MDOF_AVX512 static inline __m128i one(const ColumnText& column, std::size_t row) {
    const char* const end = column.text + column.stop[row * column.stride + 1];
    return _mm_loadu_si128(reinterpret_cast<const __m128i*>(end - 16));
  }
  MDOF_AVX512 static inline __m512i four(const ColumnText& column, std::size_t row) {
    const __m256i low =
        _mm256_inserti128_si256(_mm256_castsi128_si256(one(column, row)), one(column, row + 1), 1);
    const __m256i high = _mm256_inserti128_si256(_mm256_castsi128_si256(one(column, row + 2)),
                                                 one(column, row + 3), 1);
    return _mm512_inserti64x4(_mm512_castsi256_si512(low), high, 1);
  }
  // Sixteen bits a field to the upper half of its element, and back.
  MDOF_AVX512 static inline __m256i of_fields(std::uint64_t low, std::uint64_t high) {
    const __m128i bits = _mm_set_epi64x(static_cast<long long>(high), static_cast<long long>(low));
    return _mm256_slli_epi32(_mm256_cvtepu16_epi32(bits), 16);
  }
  MDOF_AVX512 static inline __m128i of_text(__m256i bits) {
    return _mm256_cvtepi32_epi16(_mm256_srli_epi32(bits, 16));
  }
  MDOF_AVX512 static inline std::uint64_t half(__m128i bits, int i) {
    return static_cast<std::uint64_t>(i == 0 ? _mm_cvtsi128_si64(bits)
                                             : _mm_extract_epi64(bits, 1));
  }
};

// Fields of up to 31 characters and 19 digits from the first that is not 0: the last 32 characters
// of each, two fields to a register.
class Wide {
 public:
  MDOF_AVX512 static inline Plain read(const ColumnText& column) {
    __m512i text[4], earlier[4];
    std::uint64_t stop[4], point[4], minus[4], digit[4];
    for (std::size_t k = 0; k < 4; ++k) {
      text[k] = two(column, 2 * k, 32);
      earlier[k] = two(column, 2 * k, 33);
      stop[k] = stops_in(text[k]);
      point[k] = found(text[k], '.');
      minus[k] = found(text[k], '-');
      digit[k] = digits_in(text[k]);
    }
    const Layout layout = find_layout({bits(stop), bits(point), bits(minus), bits(digit)});
    alignas(32) std::uint64_t behind[4], before[4];
    keep(_mm256_and_si256(layout.digits, layout.fraction), behind);
    keep(_mm256_andnot_si256(layout.fraction, _mm256_slli_epi32(layout.digits, 1)), before);
    __m512i four[4];
    for (int k = 0; k < 4; ++k) four[k] = fours(text[k], behind[k], earlier[k], before[k]);
    Plain plain = join(eights(four[0], four[1]), eights(four[2], four[3]));
    plain.behind = _mm512_cvtepu32_epi64(layout.behind);
    plain.negative = layout.negative;
    plain.odd = static_cast<__mmask8>(plain.odd | layout.odd);
    return plain;
  }

 private:
  MDOF_AVX512 static inline __m256i one(const ColumnText& column, std::size_t row, int back) {
    const char* const end = column.text + column.stop[row * column.stride + 1];
    return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(end - back));
  }
  MDOF_AVX512 static inline __m512i two(const ColumnText& column, std::size_t row, int back) {
    return _mm512_inserti64x4(_mm512_castsi256_si512(one(column, row, back)),
                              one(column, row + 1, back), 1);
  }
  // (Not through memory: a load of what several stores wrote waits for all of them.)
  MDOF_AVX512 static inline __m256i bits(const std::uint64_t (&of_text)[4]) {
    return _mm256_set_epi64x(static_cast<long long>(of_text[3]), static_cast<long long>(of_text[2]),
                             static_cast<long long>(of_text[1]),
                             static_cast<long long>(of_text[0]));
  }
  MDOF_AVX512 static inline void keep(__m256i bits, std::uint64_t (&of_text)[4]) {
    _mm256_store_si256(reinterpret_cast<__m256i*>(of_text), bits);
  }
  // A field has four numbers of eight digits. `a` has, 64 bits each, the first two of the fields
  // 0 and 2, the last two of them, the first two of 1 and 3, the last two; `b` those of 4 ... 7.
  MDOF_AVX512 static inline Plain join(__m512i a, __m512i b) {
    const __m512i first_two = _mm512_setr_epi64(0, 4, 1, 5, 8, 12, 9, 13);
    const __m512i last_two = _mm512_setr_epi64(2, 6, 3, 7, 10, 14, 11, 15);
    const __m512i upper = _mm512_permutex2var_epi64(a, first_two, b);
    const __m512i tail = sixteens(_mm512_permutex2var_epi64(a, last_two, b));
    const __m512i head = _mm512_srli_epi64(upper, 32);
    const __m512i ten16 = _mm512_set1_epi64(10'000'000'000'000'000);
    const int too_long = _mm512_test_epi64_mask(upper, _mm512_set1_epi64(0xffffffff)) |
                         _mm512_cmpge_epu64_mask(head, _mm512_set1_epi64(1000));
    Plain plain;
    plain.mantissa = _mm512_add_epi64(_mm512_mullo_epi64(head, ten16), tail);
    plain.odd = static_cast<__mmask8>(too_long);
    return plain;
  }
};

// m / 10^k to the nearest double. With m = high + low (both doubles, exact) and the quotient q of
// high, the rest r = high - q 10^k is exact; q + (r + low) / 10^k is then known to 2^-50 of its
// small second part, and the sum is rounded right unless the bounds of that part round apart.
MDOF_AVX512 inline __m512d divide(__m512i m, __m512d power, __m512d one_by_power,
                                  __mmask8& undecided) {
  constexpr int kNearest = _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC;
  const __m512d high = _mm512_cvtepu64_pd(m);
  const __m512i back = _mm512_cvt_roundpd_epu64(high, kNearest);
  const __m512d low = _mm512_cvtepi64_pd(_mm512_sub_epi64(m, back));
  const __m512d q = _mm512_div_pd(high, power);
  const __m512d rest = _mm512_add_pd(_mm512_fnmadd_pd(q, power, high), low);
  const __m512d c = _mm512_mul_pd(rest, one_by_power);
  const __m512d slack = _mm512_mul_pd(c, _mm512_set1_pd(0x1p-50));
  const __m512d one = _mm512_add_pd(q, _mm512_add_pd(c, slack));
  const __m512d other = _mm512_add_pd(q, _mm512_sub_pd(c, slack));
  undecided = _mm512_cmp_pd_mask(one, other, _CMP_NEQ_UQ);
  return one;
}

constexpr auto kInversePowers = [] {
  std::array<double, kLargestExactPower + 1> inverse{};
  for (std::size_t k = 0; k < inverse.size(); ++k) inverse[k] = 1 / kExactPowers[k];
  return inverse;
}();

// A function of k up to kLargestExactPower, as a table in registers.
class Table {
 public:
  MDOF_AVX512 explicit Table(const double* of_k)
      : low_(_mm512_loadu_pd(of_k)),
        middle_(_mm512_loadu_pd(of_k + 8)),
        high_(_mm512_maskz_loadu_pd(0x7f, of_k + 16)) {}
  MDOF_AVX512 __m512d operator()(__m512i k) const {
    const __mmask8 beyond = _mm512_cmpgt_epu64_mask(k, _mm512_set1_epi64(15));
    return _mm512_mask_permutexvar_pd(_mm512_permutex2var_pd(low_, k, middle_), beyond, k, high_);
  }

 private:
  __m512d low_, middle_, high_;
};

// Turns mantissas into doubles.
class ToDouble {
 public:
  using Out = double;
  // Up to 15 digits: mantissa and power are exact, the one rounding is that of the division.
  MDOF_AVX512 inline bool narrow(const Plain& plain, double* out) const {
    const __m512d m = _mm512_cvtepi64_pd(plain.mantissa);
    store(_mm512_div_pd(m, power_(plain.behind)), plain.negative, out);
    return true;
  }
  MDOF_AVX512 inline bool wide(const Plain& plain, double* out) const {
    __mmask8 undecided;
    const __m512d x =
        divide(plain.mantissa, power_(plain.behind), inverse_(plain.behind), undecided);
    const __mmask8 too_deep =
        _mm512_cmpgt_epu64_mask(plain.behind, _mm512_set1_epi64(kLargestExactPower));
    if (undecided | too_deep) return false;
    store(x, plain.negative, out);
    return true;
  }

 private:
  MDOF_AVX512 static inline void store(__m512d x, __mmask8 negative, double* out) {
    const __m512i sign = _mm512_maskz_set1_epi64(negative, static_cast<long long>(1ull << 63));
    _mm512_storeu_pd(out, _mm512_or_pd(x, _mm512_castsi512_pd(sign)));
  }

  Table power_{kExactPowers};
  Table inverse_{kInversePowers.data()};
};

// Turns mantissas of seconds into nanoseconds.
class ToNanoseconds {
 public:
  using Out = std::int64_t;
  MDOF_AVX512 ToNanoseconds()
      : limit_0_(_mm512_loadu_si512(kPowersOfTen + 9)),
        limit_8_(_mm512_maskz_loadu_epi64(3, kPowersOfTen + 17)),
        scale_0_(_mm512_loadu_si512(kPowersOfTen)),
        scale_8_(_mm512_maskz_loadu_epi64(3, kPowersOfTen + 8)) {}
  MDOF_AVX512 inline bool narrow(const Plain& plain, std::int64_t* out) const {
    return wide(plain, out);
  }
  MDOF_AVX512 inline bool wide(const Plain& plain, std::int64_t* out) const {
    const __m512i nine = _mm512_set1_epi64(9);
    const __m512i limit = _mm512_permutex2var_epi64(limit_0_, plain.behind, limit_8_);
    if (_mm512_cmpgt_epu64_mask(plain.behind, nine) |
        _mm512_cmpge_epu64_mask(plain.mantissa, limit))
      return false;
    const __m512i missing = _mm512_sub_epi64(nine, plain.behind);
    const __m512i scale = _mm512_permutex2var_epi64(scale_0_, missing, scale_8_);
    const __m512i ns = _mm512_mullo_epi64(plain.mantissa, scale);
    const __m512i zero = _mm512_setzero_si512();
    _mm512_storeu_si512(out, _mm512_mask_sub_epi64(ns, plain.negative, zero, ns));
    return true;
  }

 private:
  // for k digits behind the point, k <= 9: below 10^(9+k), times 10^(9-k)
  __m512i limit_0_, limit_8_, scale_0_, scale_8_;
};

// Fields of one column are mostly of one kind: once some were wide, the others are taken for it.
template <class Convert>
MDOF_AVX512 inline std::size_t read_eights(const ColumnText& column, std::size_t n,
                                           typename Convert::Out* out) {
  const Convert convert;
  std::size_t j = 0;
  ColumnText at = column;
  for (; j + 8 <= n; j += 8, at.stop += 8 * at.stride) {
    const Plain plain = Narrow::read(at);
    if (plain.odd || !convert.narrow(plain, out + j)) break;
  }
  for (; j + 8 <= n; j += 8, at.stop += 8 * at.stride) {
    const Plain plain = Wide::read(at);
    if (plain.odd || !convert.wide(plain, out + j)) break;
  }
  return j;
}

}  // namespace

MDOF_AVX512 std::size_t read_plain(const ColumnText& column, std::size_t n, double* out) {
  return read_eights<ToDouble>(column, n, out);
}
MDOF_AVX512 std::size_t read_plain(const ColumnText& column, std::size_t n, std::int64_t* time_ns) {
  return read_eights<ToNanoseconds>(column, n, time_ns);
}

}  // namespace mdof::avx512

#else

namespace mdof::avx512 {
std::size_t read_plain(const ColumnText&, std::size_t, double*) {
  return 0;
}
std::size_t read_plain(const ColumnText&, std::size_t, std::int64_t*) {
  return 0;
}
}  // namespace mdof::avx512

#endif
