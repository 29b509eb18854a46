// Philox4x32-10 for vectors, with one trial in each lane. The numbers have the same bits as those
// of schema/base/random.h. Each translation unit that includes this header has one instruction set.
#pragma once

#include "algo/sensitivity/kernels/vector.h"
#include "algo/sensitivity/random.h"

namespace mdof::algo {
namespace {

// The keys of the ten rounds.
struct RoundKeys {
  std::uint64_t low[10], high[10];
};

inline RoundKeys round_keys(std::uint64_t seed) {
  RoundKeys keys;
  auto low = static_cast<std::uint32_t>(seed), high = static_cast<std::uint32_t>(seed >> 32);
  for (int i = 0; i < 10; ++i) {
    keys.low[i] = low;
    keys.high[i] = high;
    low += 0x9E3779B9;
    high += 0xBB67AE85;
  }
  return keys;
}

// Uniform number as in schema/base/random.h: (bits + 1/2) 2⁻⁵². All operations are exact.
inline Vector uniform_of(Words high, Words low) {
  const Words word = (high << 32) | (low & 0xFFFFFFFFu);
  return as_doubles((word >> 12) | 0x3FF0000000000000u) - (1.0 - 0x1p-53);
}

struct DrawPair {
  Vector even, odd;  // draws 2g and 2g + 1
};

// Draws the pairs of several blocks. The rounds of all blocks are calculated in turn, so that the
// processor does not wait for the result of a product. The upper halves of the words are not used:
// products ignore them.
template <std::size_t kPairs>
inline void draw_blocks(const RoundKeys& keys, const Words (&trial)[kPairs],
                        const std::uint64_t (&group)[kPairs], std::uint64_t stream,
                        DrawPair (&out)[kPairs]) {
  Words x0[kPairs], x1[kPairs], x2[kPairs], x3[kPairs];
  for (std::size_t p = 0; p < kPairs; ++p) {
    x0[p] = trial[p];
    x1[p] = trial[p] >> 32;
    x2[p] = broadcast(group[p]);
    x3[p] = broadcast(stream);
  }
  const Words m0 = broadcast(std::uint64_t{0xD2511F53}), m1 = broadcast(std::uint64_t{0xCD9E8D57});
#pragma GCC unroll 10
  for (int i = 0; i < 10; ++i) {
#pragma GCC unroll 6
    for (std::size_t p = 0; p < kPairs; ++p) {
      const Words a = product32(m0, x0[p]), b = product32(m1, x2[p]);
      x0[p] = xor3(b >> 32, x1[p], broadcast(keys.low[i]));
      x1[p] = b;
      x2[p] = xor3(a >> 32, x3[p], broadcast(keys.high[i]));
      x3[p] = a;
    }
  }
  for (std::size_t p = 0; p < kPairs; ++p) {
    out[p] = {uniform_of(x0[p], x1[p]), uniform_of(x2[p], x3[p])};
  }
}

// Draws numbers for kVectors vectors of trials, and stores at most n numbers.
template <std::size_t kVectors>
inline void draw_some_pairs(const RoundKeys& keys, Words trial, std::uint64_t step,
                            std::uint64_t group, std::uint64_t stream, std::size_t n, double* even,
                            double* odd) {
  Words trials[kVectors];
  std::uint64_t groups[kVectors];
  DrawPair pairs[kVectors];
  for (std::size_t v = 0; v < kVectors; ++v) {
    trials[v] = trial + step * (v * kPerVector);
    groups[v] = group;
  }
  draw_blocks(keys, trials, groups, stream, pairs);
  for (std::size_t v = 0; v < kVectors; ++v) {
    const std::size_t at = v * kPerVector;
    const std::size_t some = n - at < kPerVector ? n - at : kPerVector;
    write_some(even + at, pairs[v].even, some);
    write_some(odd + at, pairs[v].odd, some);
  }
}

inline void draw_pairs_kernel(const Stream& from, std::uint64_t group, std::uint64_t first,
                              std::uint64_t step, std::size_t n, double* even, double* odd) {
  const RoundKeys keys = round_keys(from.seed);
  const Words trial = lane_numbers() * step + first;
  constexpr std::size_t kParallelBlocks = 3;
  std::size_t i = 0;
  for (; i + kParallelBlocks * kPerVector <= n; i += kParallelBlocks * kPerVector) {
    draw_some_pairs<kParallelBlocks>(keys, trial + step * i, step, group, from.stream, n - i,
                                     even + i, odd + i);
  }
  for (; i < n; i += kPerVector) {
    draw_some_pairs<1>(keys, trial + step * i, step, group, from.stream, n - i, even + i, odd + i);
  }
}

}  // namespace
}  // namespace mdof::algo
