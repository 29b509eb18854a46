#include "schema/base/csv/csv_stops.h"

#include <array>
#include <bit>
#include <cstddef>

#include "schema/base/compiled_for.h"

namespace mdof {
namespace {

constexpr std::size_t kStep = kStopsMargin;  // number of bytes in one iteration

// Position at which the next stops are written. Stops are written in groups of four; the last group
// may contain unused positions.
struct Out {
  std::uint32_t* at;
  char* byte;
};

// Returns a mask of all 64 bits, or of the first n bits if fewer than 64 bytes remain.
std::uint64_t text_bits_mask(std::size_t n) {
  return n < kStep ? (std::uint64_t{1} << n) - 1 : ~std::uint64_t{0};
}

// Bit i of the result: the byte p[i] is a stop, i < 64.
[[gnu::always_inline]] inline std::uint64_t stop_bits(const char* p) {
#ifdef __SSE2__
  std::uint64_t bits = 0;
  for (unsigned i = 0; i < kStep; i += 16) {
    const __m128i text = _mm_loadu_si128(reinterpret_cast<const __m128i*>(p + i));
    const int stops = _mm_movemask_epi8(_mm_cmplt_epi8(text, _mm_set1_epi8('-')));
    bits |= static_cast<std::uint64_t>(static_cast<unsigned>(stops)) << i;
  }
  return bits;
#else
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < kStep; ++i)
    bits |= static_cast<std::uint64_t>(static_cast<signed char>(p[i]) < '-') << i;
  return bits;
#endif
}

// As std::popcount(), but without a library call if the compiler cannot assume a popcount
// instruction.
template <bool kHasInstruction>
[[gnu::always_inline]] inline std::uint64_t count_bits(std::uint64_t bits) {
  if constexpr (kHasInstruction) return static_cast<std::uint64_t>(std::popcount(bits));
  bits -= bits >> 1 & 0x5555555555555555;
  bits = (bits & 0x3333333333333333) + (bits >> 2 & 0x3333333333333333);
  return ((bits + (bits >> 4)) & 0x0f0f0f0f0f0f0f0f) * 0x0101010101010101 >> 56;
}

// Writes the stops in groups of four. A loop that writes one stop at a time would be slower,
// because the processor mispredicts the end of the loop.
template <bool kPopcount>
[[gnu::always_inline]] inline Out append(const char* text, std::size_t begin, std::uint64_t bits,
                                         Out out) {
  std::uint32_t* const end = out.at + count_bits<kPopcount>(bits);
  Out to = out;
  do {
    for (int k = 0; k < 4; ++k, bits &= bits - 1) {
      const std::size_t at = begin + (static_cast<unsigned>(std::countr_zero(bits)) & 63u);
      to.at[k] = static_cast<std::uint32_t>(at);
      to.byte[k] = text[at];
    }
    to = {to.at + 4, to.byte + 4};
  } while (to.at < end);
  return {end, out.byte + (end - out.at)};
}

template <bool kPopcount>
[[gnu::always_inline]] inline Out append_all(std::string_view text, Out out) {
  for (std::size_t begin = 0; begin < text.size(); begin += kStep) {
    const std::uint64_t bits = stop_bits(text.data() + begin) & text_bits_mask(text.size() - begin);
    out = append<kPopcount>(text.data(), begin, bits, out);
  }
  return out;
}
Out append_all_baseline(std::string_view text, Out out) {
  return append_all<false>(text, out);
}
MDOF_AVX2 Out append_all_avx2(std::string_view text, Out out) {
  return append_all<true>(text, out);
}

#if defined(__x86_64__)
constexpr std::array<char, kStep> kPlaces = [] {
  std::array<char, kStep> places{};
  for (std::size_t i = 0; i < kStep; ++i) places[i] = static_cast<char>(i);
  return places;
}();

MDOF_AVX512 Out append_all_avx512(std::string_view text, Out out) {
  const __m512i all_places = _mm512_loadu_si512(kPlaces.data());
  for (std::size_t begin = 0; begin < text.size(); begin += kStep) {
    const __m512i bytes = _mm512_loadu_si512(text.data() + begin);
    const std::uint64_t bits =
        _mm512_cmplt_epi8_mask(bytes, _mm512_set1_epi8('-')) & text_bits_mask(text.size() - begin);
    const int count = __builtin_popcountll(bits);
    _mm512_storeu_si512(out.byte, _mm512_maskz_compress_epi8(bits, bytes));
    __m512i places = _mm512_maskz_compress_epi8(bits, all_places);
    const __m512i first = _mm512_set1_epi32(static_cast<int>(begin));
    for (int k = 0; k < count; k += 16) {
      const __m512i sixteen = _mm512_maskz_cvtepu8_epi32(0xffff, _mm512_castsi512_si128(places));
      _mm512_storeu_si512(out.at + k, _mm512_add_epi32(sixteen, first));
      places = _mm512_maskz_alignr_epi32(0xffff, places, places, 4);
    }
    out = {out.at + count, out.byte + count};
  }
  return out;
}
#endif

using AppendAll = Out (*)(std::string_view, Out);
AppendAll append_all_function(InstructionSet set) {
#if defined(__x86_64__)
  if (has_avx512(set)) return append_all_avx512;
#endif
  return has_avx2(set) ? append_all_avx2 : append_all_baseline;
}

}  // namespace

void find_stops(std::string_view text, CsvStops& stops, InstructionSet set) {
  const std::size_t most = 1 + text.size() + kStep;
  if (stops.room < most) {
    stops.at.reset(new std::uint32_t[most]);
    stops.byte.reset(new char[most]);
    stops.room = most;
  }
  stops.at[0] = static_cast<std::uint32_t>(-1);
  stops.byte[0] = '\n';
  const Out end = append_all_function(set)(text, {stops.at.get() + 1, stops.byte.get() + 1});
  stops.count = static_cast<std::size_t>(end.at - stops.at.get());
}

}  // namespace mdof
