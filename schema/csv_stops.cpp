#include "schema/csv_stops.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace mdof {
namespace {

constexpr std::size_t kStep = kStopsMargin;  // bytes a round

// Bit i: byte p[i] is a stop, i < 64.
std::uint64_t stop_bits(const char* p) {
#ifdef __SSE2__
  auto sixteen = [p](int offset) {
    const __m128i text = _mm_loadu_si128(reinterpret_cast<const __m128i*>(p + offset));
    return static_cast<std::uint64_t>(_mm_movemask_epi8(_mm_cmplt_epi8(text, _mm_set1_epi8('-'))));
  };
  return sixteen(0) | sixteen(16) << 16 | sixteen(32) << 32 | sixteen(48) << 48;
#else
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < kStep; ++i)
    bits |= static_cast<std::uint64_t>(static_cast<signed char>(p[i]) < '-') << i;
  return bits;
#endif
}

// std::popcount() without its call into a library where the processor is not known to have one.
std::uint64_t count_bits(std::uint64_t bits) {
  bits -= bits >> 1 & 0x5555555555555555;
  bits = (bits & 0x3333333333333333) + (bits >> 2 & 0x3333333333333333);
  return ((bits + (bits >> 4)) & 0x0f0f0f0f0f0f0f0f) * 0x0101010101010101 >> 56;
}

// Appends the positions of the bits in groups of four, the last group with some too many: a loop of
// unknown length is mispredicted at its end. Gives the new end.
std::uint32_t* append_positions(std::uint64_t bits, std::uint32_t begin, std::uint32_t* out) {
  std::uint32_t* const end = out + count_bits(bits);
  do {
    for (int k = 0; k < 4; ++k, bits &= bits - 1)
      *out++ = begin + static_cast<std::uint32_t>(std::countr_zero(bits));
  } while (out < end);
  return end;
}

}  // namespace

void find_stops(std::string_view text, std::vector<std::uint32_t>& stops) {
  if (stops.empty()) stops.resize(1);
  stops[0] = static_cast<std::uint32_t>(-1);
  std::size_t count = 1;
  for (std::size_t begin = 0; begin < text.size(); begin += kStep) {
    if (stops.size() < count + kStep + 4) stops.resize(2 * (count + kStep));
    std::uint64_t bits = stop_bits(text.data() + begin);
    if (text.size() - begin < kStep) bits &= (std::uint64_t{1} << (text.size() - begin)) - 1;
    std::uint32_t* const out = stops.data() + count;
    count += static_cast<std::size_t>(
        append_positions(bits, static_cast<std::uint32_t>(begin), out) - out);
  }
  stops.resize(count);
}

}  // namespace mdof
