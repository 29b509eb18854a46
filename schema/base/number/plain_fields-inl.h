// Reads fields of the form [-]ddd.ddd as mantissas, as many fields at a time as a vector has 64-bit
// lanes. The code uses Highway and is compiled for vectors of 32 and of 64 bytes:
// number_columns_vector.cpp includes this file once for each size. A vector consists of blocks of
// 16 bytes. The first block of a field contains its last 16 characters; a long field has a second
// block with the 16 characters before them.
#if defined(MDOF_PLAIN_FIELDS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MDOF_PLAIN_FIELDS_INL_H
#undef MDOF_PLAIN_FIELDS_INL_H
#else
#define MDOF_PLAIN_FIELDS_INL_H
#endif

#include <hwy/highway.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "schema/base/number/number_columns.h"

HWY_BEFORE_NAMESPACE();
namespace mdof::HWY_NAMESPACE {
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::ScalableTag<std::uint8_t> d8;
constexpr hn::ScalableTag<std::int8_t> di8;
constexpr hn::ScalableTag<std::int16_t> di16;
constexpr hn::ScalableTag<std::uint32_t> d32;
constexpr hn::ScalableTag<std::int32_t> di32;
constexpr hn::ScalableTag<std::uint64_t> d64;
constexpr hn::ScalableTag<std::int64_t> di64;
using Bytes = hn::Vec<decltype(d8)>;
using Halves = hn::Vec<decltype(di16)>;
using Words = hn::Vec<decltype(di32)>;
using Longs = hn::Vec<decltype(d64)>;

constexpr std::size_t kFields = HWY_LANES(std::uint64_t);
constexpr std::size_t kBlocksOfVector = kFields / 2;

// `seen` encodes the position of the decimal point in a field, and the sign of the number (1:
// minus). If the point is character i of the last 32 characters, the value is 2 (32 + i) + sign. If
// there is no point, the value is the sign.
constexpr std::uint8_t kFirstPlace = 64;
HWY_INLINE Longs place_of_point(Longs seen) {  // i; 0: no point
  return hn::And(hn::ShiftRight<1>(seen), hn::Set(d64, 31));
}

struct Plain {
  Longs mantissa, seen;
  Longs odd;  // any bit set: a field is not plain
};

// A table for one block; all blocks use the same table.
using Table = std::array<std::uint8_t, 16>;
HWY_INLINE Bytes in_all_blocks(const Table& table) {
  return hn::LoadDup128(d8, table.data());
}
// Block k of a field: for each byte, the code of a decimal point at this position.
template <int k>
HWY_INLINE Bytes places() {
  static constexpr Table kPlaces = [] {
    Table table{};
    for (std::size_t i = 0; i < 16; ++i)
      table[i] = static_cast<std::uint8_t>(kFirstPlace + 2 * ((k == 0 ? 16 : 0) + i));
    return table;
  }();
  return in_all_blocks(kPlaces);
}
// The character c at all positions where it is allowed; 255 elsewhere (no field contains a byte
// 255). The last character of a field must be a digit. A point at position 0 is not allowed,
// because it could not be distinguished from no point.
template <int k>
HWY_INLINE Bytes allowed(char c) {
  static constexpr Table kNever = [] {
    Table table{};
    table[k == 0 ? 15 : 0] = 255;
    return table;
  }();
  return hn::Or(in_all_blocks(kNever), hn::Set(d8, static_cast<std::uint8_t>(c)));
}

// The 32 bytes from kLast + n on: the last n of these bytes are 255, n <= 32.
constexpr std::array<std::uint8_t, 64> kLast = [] {
  std::array<std::uint8_t, 64> last{};
  for (std::size_t i = 32; i < last.size(); ++i) last[i] = 255;
  return last;
}();

// The ends of the fields in one vector. A vector contains every second field of a group.
struct Ends {
  const std::uint8_t* text[kBlocksOfVector];  // end of each field
  const std::uint8_t* last[kBlocksOfVector];  // kLast + size of each field
};

// Finds the ends of the fields first, first + 2, ... Returns false if a field is empty or has more
// than 16 kBlocks characters.
template <int kBlocks>
HWY_INLINE bool find_ends(const ColumnText& column, std::size_t first, Ends& ends) {
  const auto* const text = reinterpret_cast<const std::uint8_t*>(column.text);
  const std::uint32_t* stop = column.stop + first * column.stride;
  std::uint32_t sizes = 0;
  for (std::size_t j = 0; j < kBlocksOfVector; ++j, stop += 2 * column.stride) {
    const std::uint32_t less = stop[1] - stop[0] - 2u;  // one less than the size
    ends.text[j] = text + stop[1];
    ends.last[j] = kLast.data() + 1 + less;
    sizes |= less;
  }
  return sizes < 16 * kBlocks;
}

// Loads 16 bytes from each pointer in `from`, plus `offset`.
template <class D>
HWY_INLINE hn::Vec<D> blocks(D d, const std::uint8_t* const* from, std::ptrdiff_t offset) {
  if constexpr (hn::MaxLanes(D()) == 16) {
    return hn::LoadU(d, from[0] + offset);
  } else {
    const hn::Half<D> half;
    constexpr std::size_t kHalf = hn::MaxLanes(D()) / 32;
    return hn::Combine(d, blocks(half, from + kHalf, offset), blocks(half, from, offset));
  }
}

// Loads the last 16 bytes as block [0] and, if there are two blocks, the 16 bytes before as block
// [1].
HWY_INLINE void load_blocks(const std::uint8_t* const* from, std::ptrdiff_t offset,
                            Bytes (&block)[1]) {
  block[0] = blocks(d8, from, offset + 16);
}
HWY_INLINE void load_blocks(const std::uint8_t* const* from, std::ptrdiff_t offset,
                            Bytes (&block)[2]) {
#if HWY_TARGET == HWY_AVX2
  const Bytes a = hn::LoadU(d8, from[0] + offset), b = hn::LoadU(d8, from[1] + offset);
  block[0] = hn::ConcatUpperUpper(d8, b, a);
  block[1] = hn::ConcatLowerLower(d8, b, a);
#else
  const auto two = [&](std::size_t i) HWY_ATTR {
    const hn::Half<decltype(d8)> half;
    return hn::Combine(d8, hn::LoadU(half, from[i + 1] + offset),
                       hn::LoadU(half, from[i] + offset));
  };
  const Bytes a = two(0), b = two(2);
  block[0] = Bytes{_mm512_shuffle_i64x2(a.raw, b.raw, 0xdd)};
  block[1] = Bytes{_mm512_shuffle_i64x2(a.raw, b.raw, 0x88)};
#endif
}

// Block k of the fields, with each byte moved to the next higher position.
template <int k, int kBlocks>
HWY_INLINE Bytes moved_up(const Bytes (&x)[kBlocks]) {
  if constexpr (k + 1 < kBlocks) {
    return hn::CombineShiftRightBytes<15>(d8, x[k], x[k + 1]);
  } else {
    return hn::ShiftLeftBytes<1>(d8, x[k]);
  }
}

// Pairs of digits as numbers: 10 times the first plus the second. (Later versions of Highway have
// this as SatWidenMulPairwiseAdd. g++ converts the portable form, a product by 2561, into shifts.)
HWY_INLINE Halves pairs(Bytes digits) {
  const Halves factors = hn::Set(di16, 1 << 8 | 10);
#if HWY_TARGET == HWY_AVX2
  return Halves{_mm256_maddubs_epi16(digits.raw, factors.raw)};
#else
  return Halves{_mm512_maddubs_epi16(digits.raw, factors.raw)};
#endif
}

// Joins neighbouring numbers: factor times the first number plus the second number.
HWY_INLINE Words join(Halves x, int factor) {
  auto unused = hn::Zero(di32);
  return hn::ReorderWidenMulAccumulate(di32, x, hn::BitCast(di16, hn::Set(di32, 1 << 16 | factor)),
                                       hn::Zero(di32), unused);
}

// Joins numbers of four digits, four in each block of the fields 0, 2, ... and 1, 3, ..., to
// numbers of sixteen digits. (On x86 the packing alternates between blocks, which puts the fields
// in order.)
HWY_INLINE Longs sixteens(Words even, Words odd) {
  const Words eights = join(hn::ReorderDemote2To(di16, even, odd), 10000);
  return hn::Add(hn::MulEven(hn::BitCast(d32, eights), hn::Set(d32, 100'000'000)),
                 hn::ShiftRight<32>(hn::BitCast(d64, eights)));
}

// Intermediate results of one vector of a group.
template <int kBlocks>
struct Half {
  Words fours[kBlocks];
  Longs seen;  // twice in each block
  Bytes odd;   // 255: not a character of a plain number
};

// Adds the contents of block k. `digits`: values of the digits, 0 elsewhere.
template <int k, int kBlocks>
HWY_INLINE void classify_block(const Bytes& all, const Bytes (&field)[kBlocks],
                               Bytes (&digits)[kBlocks], Bytes& seen, Bytes& odd) {
  const Bytes text = hn::And(all, field[k]);
  const Bytes first = hn::AndNot(moved_up<k>(field), field[k]);
  const auto is_point = hn::Eq(text, allowed<k>('.'));
  const auto is_sign = hn::Eq(hn::And(text, first), allowed<k>('-'));
  // makes digits the largest signed bytes
  const Bytes high = hn::Add(text, hn::Set(d8, 127 - '9'));
  constexpr std::uint8_t kZero = 127 - 9;
  const auto is_digit = hn::RebindMask(d8, hn::Gt(hn::BitCast(di8, high), hn::Set(di8, kZero - 1)));
  digits[k] = hn::SaturatedSub(high, hn::Set(d8, kZero));
  odd = hn::Or(odd, hn::IfThenZeroElse(hn::Or(hn::Or(is_digit, is_point), is_sign), field[k]));
  seen = hn::Add(seen, hn::Or(hn::IfThenElseZero(is_point, places<k>()),
                              hn::IfThenElseZero(is_sign, hn::Set(d8, 1))));
}

// Makes the digits contiguous (digits before the point move to the next higher position) and joins
// them in groups of four.
template <int k, int kBlocks>
HWY_INLINE Words in_a_row(const Bytes (&digits)[kBlocks], Bytes point) {
  const auto behind =
      hn::RebindMask(d8, hn::Gt(hn::BitCast(di8, places<k>()), hn::BitCast(di8, point)));
  return join(pairs(hn::IfThenElse(behind, digits[k], moved_up<k>(digits))), 100);
}

template <int kBlocks>
HWY_INLINE bool look_at(const ColumnText& column, std::size_t first, Half<kBlocks>& half) {
  Ends ends;
  if (!find_ends<kBlocks>(column, first, ends)) return false;
  Bytes text[kBlocks], field[kBlocks], digits[kBlocks], seen = hn::Zero(d8);
  half.odd = hn::Zero(d8);
  load_blocks(ends.text, -32, text);
  load_blocks(ends.last, 0, field);
  classify_block<0>(text[0], field, digits, seen, half.odd);
  if constexpr (kBlocks == 2) classify_block<1>(text[1], field, digits, seen, half.odd);
  const Longs sum = hn::SumsOf8(seen);
  half.seen = hn::Add(sum, hn::Shuffle01(sum));
  const Bytes point = hn::TableLookupBytes(hn::BitCast(d8, half.seen), hn::Zero(d8));
  half.fours[0] = in_a_row<0>(digits, point);
  if constexpr (kBlocks == 2) half.fours[1] = in_a_row<1>(digits, point);
  return true;
}

// Adds the digits before the last sixteen digits. The number that they form must be below 1024:
// 1024 · 10^16 < 2^64.
HWY_INLINE void add_upper(Longs upper, Plain& plain) {
  constexpr std::uint64_t kTen16 = 10'000'000'000'000'000;
  const auto factor = hn::BitCast(d32, upper);
  const Longs low = hn::MulEven(factor, hn::Set(d32, kTen16 & 0xffffffff));
  const Longs high = hn::MulEven(factor, hn::Set(d32, kTen16 >> 32));
  plain.mantissa = hn::Add(plain.mantissa, hn::Add(low, hn::ShiftLeft<32>(high)));
  plain.odd = hn::Or(plain.odd, hn::ShiftRight<10>(upper));
}

// Reads the next kFields fields of up to 16 kBlocks characters. Mantissas are below 2^52 if kBlocks
// is 1. False: a field is not plain.
template <int kBlocks>
HWY_INLINE bool read_fields(const ColumnText& column, Plain& plain) {
  // one vector after the other, because the registers do not suffice for both
  Half<kBlocks> even, odd;
  if (!look_at(column, 0, even) || !look_at(column, 1, odd)) return false;
  plain.seen = hn::OddEven(odd.seen, even.seen);
  plain.mantissa = sixteens(even.fours[0], odd.fours[0]);
  // two points give a sum above 127
  plain.odd = hn::Or(hn::BitCast(d64, hn::Or(even.odd, odd.odd)), hn::ShiftRight<7>(plain.seen));
  if constexpr (kBlocks == 1) {
    plain.odd = hn::Or(plain.odd, hn::ShiftRight<52>(plain.mantissa));
  } else {
    add_upper(sixteens(even.fours[1], odd.fours[1]), plain);
  }
  return hn::AllTrue(d64, hn::Eq(plain.odd, hn::Zero(d64)));
}

#endif
}  // namespace mdof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
