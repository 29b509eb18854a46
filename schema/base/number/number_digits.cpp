#include "schema/base/number/number_digits.h"

#include "schema/base/compiled_for.h"
#include "schema/base/number/number_round.h"

// F16C, PCLMUL and AES are disabled, because has_avx2() and has_avx512() do not check for them.
#define HWY_DISABLE_F16C
#define HWY_DISABLE_PCLMUL_AES
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "schema/base/number/number_digits.cpp"
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4)
#include <hwy/foreach_target.h>  // includes this file once for each set
// must follow foreach_target.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace mdof::digits::HWY_NAMESPACE {
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::ScalableTag<std::uint16_t> d16;
constexpr hn::ScalableTag<std::uint32_t> d32;
constexpr hn::ScalableTag<std::int32_t> di32;
constexpr hn::ScalableTag<std::uint64_t> d64;
constexpr hn::ScalableTag<std::int64_t> di64;
using Longs = hn::Vec<decltype(d64)>;
using Integers = hn::Vec<decltype(di64)>;
constexpr std::size_t kNumbers = HWY_LANES(std::uint64_t);

// Products of the lower 32-bit halves.
HWY_INLINE Longs times(Longs a, Longs b) {
  return hn::MulEven(hn::BitCast(d32, a), hn::BitCast(d32, b));
}
HWY_INLINE Longs times(Longs a, std::uint64_t b) {
  return times(a, hn::Set(d64, b));
}
HWY_INLINE Longs upper_half(Longs a) {
  return hn::ShiftRight<32>(a);
}
HWY_INLINE Longs lower_half(Longs a) {
  return hn::And(a, hn::Set(d64, 0xffffffff));
}

// Product of 64 by 64 bits.
struct Product {
  Longs high, low;
};
HWY_INLINE Product multiply(Longs a, Longs b) {
  const Longs ll = times(a, b), lh = times(a, upper_half(b));
  const Longs hl = times(upper_half(a), b), hh = times(upper_half(a), upper_half(b));
  const Longs middle = hn::Add(hn::Add(upper_half(ll), lower_half(lh)), lower_half(hl));
  return {hn::Add(hn::Add(hh, upper_half(middle)), hn::Add(upper_half(lh), upper_half(hl))),
          hn::Or(lower_half(ll), hn::ShiftLeft<32>(middle))};
}

HWY_INLINE Longs from_table(const std::uint64_t* table, Integers i) {
#if HWY_TARGET == HWY_AVX2  // its gather instruction is slower than this on many processors
  alignas(32) std::int64_t at[4];
  hn::Store(i, di64, at);
  return Longs{_mm256_set_epi64x(
      static_cast<long long>(table[at[3]]), static_cast<long long>(table[at[2]]),
      static_cast<long long>(table[at[1]]), static_cast<long long>(table[at[0]]))};
#else
  return hn::GatherIndex(d64, table, i);
#endif
}
struct Powers {
  Longs high, low;
};
HWY_INLINE Powers powers_of_ten(Integers q) {
  const Integers i =
      hn::ShiftLeft<1>(hn::Sub(q, hn::Set(di64, PowerTable::smallest_power_of_five)));
  const std::uint64_t* const table = PowerTable::power_of_five_128;
  return {from_table(table, i), from_table(table + 1, i)};
}
template <int kBits>
HWY_INLINE Integers times_shifted(Integers a, std::int32_t factor) {
  return hn::ShiftRight<kBits>(hn::MulEven(hn::BitCast(di32, a), hn::Set(di32, factor)));
}
HWY_INLINE Integers floor_log2_of_power_of_ten(Integers q) {
  return times_shifted<19>(q, 1741647);
}

// round_to_17() of schema/base/number/number_round.h, step by step.
struct Rounded {
  Longs digits;
  Integers exponent;
  hn::Mask<decltype(d64)> undecided;
};
HWY_INLINE Rounded round_to_17(Longs m, Integers e) {
  const Longs one = hn::Set(d64, 1);
  Integers k = times_shifted<20>(e, 315653);
  const Integers above = hn::Add(k, hn::Set(di64, 1));
  const Powers next = powers_of_ten(above);
  const auto no_tail = hn::Eq(next.low, hn::Zero(d64));
  const Longs bound = hn::Sub(next.high, hn::IfThenElseZero(no_tail, one));
  const auto next_decade =
      hn::And(hn::RebindMask(d64, hn::Eq(floor_log2_of_power_of_ten(above), e)), hn::Gt(m, bound));
  k = hn::IfThenElse(hn::RebindMask(di64, next_decade), above, k);
  const Integers q = hn::Sub(hn::Set(di64, 16), k);
  const Powers power = powers_of_ten(q);
  const Product product = multiply(m, power.high);
  const Longs low = hn::Add(product.low, multiply(m, power.low).high);
  const Longs high = hn::Add(product.high, hn::IfThenElseZero(hn::Lt(low, product.low), one));
  const Longs shift =
      hn::BitCast(d64, hn::Sub(hn::Sub(hn::Set(di64, 62), e), floor_log2_of_power_of_ten(q)));
  const Longs fraction = hn::Or(high << hn::Sub(hn::Set(d64, 64), shift), low >> shift);
  const Longs near_half = hn::Sub(fraction, hn::Set(d64, (std::uint64_t{1} << 63) - 3));
  return {hn::Add(high >> shift, hn::ShiftRight<63>(fraction)), k,
          hn::Lt(near_half, hn::Set(d64, 7))};
}

// Converts numbers below 10^8 to eight bytes 0 ... 9, the first digit in the lowest byte. Splits
// the eight digits into groups of four, two and one digits by multiplication with a reciprocal.
HWY_INLINE Longs digits_of(Longs v) {
  const Longs upper4 = hn::ShiftRight<45>(times(v, 0xd1b71759));
  const Longs lower4 = hn::Sub(v, times(upper4, 10000));
  const auto fours = hn::BitCast(d16, hn::Or(upper4, hn::ShiftLeft<32>(lower4)));
  const auto hundredth = hn::BitCast(d16, hn::Set(d32, 5243));
  const auto hundred = hn::BitCast(d16, hn::Set(d32, 100));
  const auto upper2 = hn::ShiftRight<3>(hn::MulHigh(fours, hundredth));
  const auto lower2 = hn::Sub(fours, hn::Mul(upper2, hundred));
  const auto twos = hn::Or(upper2, hn::BitCast(d16, hn::ShiftLeft<16>(hn::BitCast(d32, lower2))));
  const auto upper = hn::MulHigh(twos, hn::Set(d16, 6554));
  const auto lower = hn::Sub(twos, hn::Mul(upper, hn::Set(d16, 10)));
  return hn::BitCast(d64, hn::Or(upper, hn::ShiftLeft<8>(lower)));
}

// Splits 17 digits into 1 + 8 + 8.
HWY_INLINE void split(Longs digits, std::size_t at, EightDigits& out) {
  constexpr std::uint64_t kTen8 = 100'000'000;
  const Longs nine =  // digits / 10^8
      hn::ShiftRight<26>(multiply(digits, hn::Set(d64, 0xabcc77118461cefd)).high);
  const Longs first = hn::ShiftRight<57>(times(nine, 0x55e63b89));  // nine / 10^8
  hn::StoreU(first, d64, out.first + at);
  hn::StoreU(digits_of(hn::Sub(nine, times(first, kTen8))), d64, out.upper + at);
  hn::StoreU(digits_of(hn::Sub(digits, times(nine, kTen8))), d64, out.lower + at);
}

// Finds the digits of the numbers from x[at] on. Bit i of the result is set if the digits of x[i]
// are not certain.
HWY_INLINE unsigned find_vector_digits(const double* x, std::size_t at, EightDigits& out) {
  const Longs bits = hn::BitCast(d64, hn::LoadU(hn::ScalableTag<double>(), x + at));
  const Longs biased = hn::And(hn::ShiftRight<52>(bits), hn::Set(d64, 0x7ff));
  const auto in_range = hn::Lt(hn::Sub(biased, hn::Set(d64, kDoubleBias + kLeastExponent)),
                               hn::Set(d64, kMostExponent - kLeastExponent + 1));
  const Integers e =
      hn::BitCast(di64, hn::IfThenElseZero(in_range, hn::Sub(biased, hn::Set(d64, kDoubleBias))));
  const Longs m = hn::Or(hn::ShiftLeft<11>(bits), hn::Set(d64, std::uint64_t{1} << 63));
  const Rounded rounded = round_to_17(m, e);
  split(rounded.digits, at, out);
  hn::StoreU(rounded.exponent, di64, out.exponent + at);
  const auto too_large = hn::Gt(rounded.exponent, hn::Set(di64, kMostPlainExponent));
  const auto too_many = hn::Gt(rounded.digits, hn::Set(d64, kMost17Digits));
  const auto undecided = hn::Or(hn::Or(hn::Not(in_range), rounded.undecided),
                                hn::Or(too_many, hn::RebindMask(d64, too_large)));
  std::uint8_t lanes[8] = {};
  hn::StoreMaskBits(d64, undecided, lanes);
  return static_cast<unsigned>(lanes[0]) << at;
}

unsigned find_eight_digits(const double* x, EightDigits& digits) {
  unsigned undecided = 0;
  for (std::size_t at = 0; at < 8; at += kNumbers) undecided |= find_vector_digits(x, at, digits);
  return undecided;
}

#endif
}  // namespace mdof::digits::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mdof {

FindDigits find_digits([[maybe_unused]] InstructionSet most) {
#if defined(__x86_64__)
  if (has_avx512(most)) return digits::N_AVX3::find_eight_digits;
  if (has_avx2(most)) return digits::N_AVX2::find_eight_digits;
#endif
  return nullptr;
}

}  // namespace mdof
#endif
