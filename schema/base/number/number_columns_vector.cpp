#include "schema/base/number/number_columns_vector.h"

#include <array>
#include <bit>

#include "schema/base/compiled_for.h"
#include "schema/base/number/number_scan.h"

// F16C, PCLMUL and AES are disabled, because has_avx2() and has_avx512() do not check for them.
#define HWY_DISABLE_F16C
#define HWY_DISABLE_PCLMUL_AES
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "schema/base/number/number_columns_vector.cpp"
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4)  // not faster than one field at a time
#include <hwy/foreach_target.h>                      // includes this file once for each set
// must follow foreach_target.h
#include <hwy/highway.h>

#include "schema/base/number/plain_fields-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mdof::HWY_NAMESPACE {
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3

constexpr hn::ScalableTag<double> df;
using Doubles = hn::Vec<decltype(df)>;

// For each position i of the decimal point (place_of_point()), the bits of a number that depends on
// the number of digits after the point, 31 - i. Entry 0 is for fields without a point.
using PlaceTable = std::array<std::uint64_t, 32>;
template <class Function>
constexpr PlaceTable make_table(int most_digits, std::uint64_t beyond, Function of_digits) {
  PlaceTable table{};
  for (int i = 0; i < 32; ++i) {
    const int digits = i == 0 ? 0 : 31 - i;
    table[static_cast<std::size_t>(i)] = digits > most_digits ? beyond : of_digits(digits);
  }
  return table;
}
// With too many digits, the power is 0. Then divide() calculates a NaN and returns false.
constexpr PlaceTable kPower = make_table(kLargestExactPower, 0, [](int digits) {
  return std::bit_cast<std::uint64_t>(kExactPowers[digits]);
});
constexpr PlaceTable kInversePower = make_table(kLargestExactPower, 0, [](int digits) {
  return std::bit_cast<std::uint64_t>(1 / kExactPowers[digits]);
});
// Nanoseconds of one unit of the last digit. With too many digits, a bit in the upper half is set;
// ToNanoseconds::wide() detects this bit.
constexpr PlaceTable kNanoseconds =
    make_table(9, std::uint64_t{1} << 63, [](int digits) { return kPowersOfTen[9 - digits]; });

// Does not use gather instructions: on many processors they are slower than this function.
HWY_INLINE Longs look_up(const PlaceTable& table, Longs place) {
#if HWY_TARGET == HWY_AVX2
  alignas(32) std::uint64_t i[4];
  hn::Store(place, d64, i);
  return hn::BitCast(
      d64, Longs{_mm256_set_epi64x(
               static_cast<long long>(table[i[3]]), static_cast<long long>(table[i[2]]),
               static_cast<long long>(table[i[1]]), static_cast<long long>(table[i[0]]))});
#else
  const auto sixteen = [&](const std::uint64_t* from) HWY_ATTR {
    return Longs{_mm512_permutex2var_epi64(hn::LoadU(d64, from).raw, place.raw,
                                           hn::LoadU(d64, from + 8).raw)};
  };
  return hn::IfThenElse(hn::TestBit(place, hn::Set(d64, 16)), sixteen(table.data() + 16),
                        sixteen(table.data()));
#endif
}
HWY_INLINE Doubles look_up_double(const PlaceTable& table, Longs place) {
  return hn::BitCast(df, look_up(table, place));
}

// `power_bits`: the bits of 2^52 for a number below 2^52, or of 2^84 for a number below 2^32. Puts
// the number into the lower mantissa bits of this power and subtracts the power. The result is the
// number, or with 2^84, 2^32 times the number.
HWY_INLINE Doubles small_to_double(Longs small, std::uint64_t power_bits) {
  const Longs power = hn::Set(d64, power_bits);
  return hn::Sub(hn::BitCast(df, hn::Or(small, power)), hn::BitCast(df, power));
}
constexpr std::uint64_t kTwo52 = std::bit_cast<std::uint64_t>(0x1p52);
constexpr std::uint64_t kTwo84 = std::bit_cast<std::uint64_t>(0x1p84);

// Calculates m / 10^k, rounded to the nearest double; m: mantissa, k: number of digits after the
// point. Returns false if a rounding is not certain. m = high + low is exact, with two doubles. q
// is the rounded quotient high / 10^k, and the remainder r = high - q 10^k is exact. Then m / 10^k
// = q + c with c = (r + low) / 10^k, and the relative error of c is below 2^-50. The result is
// certain if q + c rounds to the same double with the upper and the lower limit of c.
HWY_INLINE bool divide(const Plain& plain, Doubles& x) {
  const Longs place = place_of_point(plain.seen);
  const Doubles upper = small_to_double(hn::ShiftRight<32>(plain.mantissa), kTwo84);
  const Doubles lower = small_to_double(hn::And(plain.mantissa, hn::Set(d64, 0xffffffff)), kTwo52);
  const Doubles high = hn::Add(upper, lower), low = hn::Sub(lower, hn::Sub(high, upper));
  const Doubles power = look_up_double(kPower, place);
  const Doubles q = hn::Div(high, power);
  const Doubles rest = hn::Add(hn::NegMulAdd(q, power, high), low);
  const Doubles c = hn::Mul(rest, look_up_double(kInversePower, place));
  const Doubles slack = hn::Mul(c, hn::Set(df, 0x1p-50));
  x = hn::Add(q, hn::Add(c, slack));
  return hn::AllTrue(df, hn::Eq(x, hn::Add(q, hn::Sub(c, slack))));
}

// Converts mantissas to doubles.
struct ToDouble {
  using Out = double;
  // Mantissa and power are exact, so only the division rounds.
  static HWY_INLINE bool narrow(const Plain& plain, double* out) {
    const Doubles power = look_up_double(kPower, place_of_point(plain.seen));
    store(hn::Div(small_to_double(plain.mantissa, kTwo52), power), plain, out);
    return true;
  }
  static HWY_INLINE bool wide(const Plain& plain, double* out) {
    Doubles x;
    if (!divide(plain, x)) return false;
    store(x, plain, out);
    return true;
  }

 private:
  static HWY_INLINE void store(Doubles x, const Plain& plain, double* out) {
    const Doubles sign = hn::BitCast(df, hn::ShiftLeft<63>(plain.seen));
    hn::StoreU(hn::Or(x, sign), df, out);
  }
};

// Converts mantissas of seconds to nanoseconds.
struct ToNanoseconds {
  using Out = std::int64_t;
  static HWY_INLINE bool narrow(const Plain& plain, std::int64_t* out) { return wide(plain, out); }
  // False: 10^18 ns or more, or not a whole number of nanoseconds.
  static HWY_INLINE bool wide(const Plain& plain, std::int64_t* out) {
    const Longs scale = look_up(kNanoseconds, place_of_point(plain.seen));
    const auto factor = hn::BitCast(d32, scale);
    const Longs lower = hn::MulEven(hn::BitCast(d32, plain.mantissa), factor);
    const Longs upper = hn::MulEven(hn::BitCast(d32, hn::ShiftRight<32>(plain.mantissa)), factor);
    const auto ns = hn::BitCast(di64, hn::Add(lower, hn::ShiftLeft<32>(upper)));
    // if `upper` is 2^29 or more, the result is 2^(32 + 29) or more, which is above 10^18
    const Longs odd = hn::Or(hn::ShiftRight<29>(upper), hn::ShiftRight<32>(scale));
    const auto large = hn::Gt(ns, hn::Set(di64, 999'999'999'999'999'999));
    if (!hn::AllTrue(d64, hn::Eq(odd, hn::Zero(d64))) || !hn::AllFalse(di64, large)) return false;
    const auto negative = hn::TestBit(hn::BitCast(di64, plain.seen), hn::Set(di64, 1));
    hn::StoreU(hn::IfThenElse(negative, hn::Neg(ns), ns), di64, out);
    return true;
  }
};

// Most columns contain fields of one width. After the first wide group, all further groups are read
// as wide groups.
template <class Convert>
HWY_INLINE std::size_t read_groups(const ColumnText& column, std::size_t n,
                                   typename Convert::Out* out) {
  std::size_t j = 0;
  ColumnText at = column;
  Plain plain;
  for (; j + kFields <= n; j += kFields, at.stop += kFields * at.stride)
    if (!read_fields<1>(at, plain) || !Convert::narrow(plain, out + j)) break;
  for (; j + kFields <= n; j += kFields, at.stop += kFields * at.stride)
    if (!read_fields<2>(at, plain) || !Convert::wide(plain, out + j)) break;
  return j;
}

std::size_t read_plain_doubles(const ColumnText& column, std::size_t n, double* out) {
  return read_groups<ToDouble>(column, n, out);
}
std::size_t read_plain_times_ns(const ColumnText& column, std::size_t n, std::int64_t* out) {
  return read_groups<ToNanoseconds>(column, n, out);
}

#endif
}  // namespace mdof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mdof {
namespace {

std::size_t read_no_doubles(const ColumnText&, std::size_t, double*) {
  return 0;
}
std::size_t read_no_times_ns(const ColumnText&, std::size_t, std::int64_t*) {
  return 0;
}

}  // namespace

PlainReaders plain_readers([[maybe_unused]] InstructionSet most) {
#if defined(__x86_64__)
  if (has_avx512(most)) return {N_AVX3::read_plain_doubles, N_AVX3::read_plain_times_ns};
  if (has_avx2(most)) return {N_AVX2::read_plain_doubles, N_AVX2::read_plain_times_ns};
#endif
  return {read_no_doubles, read_no_times_ns};
}

}  // namespace mdof
#endif
