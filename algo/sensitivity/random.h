// The random numbers of a trial. Draw q of trial i is a pure function of (seed, stream, i, q): any
// trial can be calculated alone, and one more quantity at the end of a list changes no other
// number.
//
// Philox4x32-10 (schema/base/random.h) with key = seed and counter = {i, i >> 32, q / 2, stream};
// words 0 and 1 of its block are draw 2(q/2), words 2 and 3 the next.
#pragma once

#include <cstdint>
#include <span>

#include "schema/base/instruction_set.h"

namespace mdof::algo {

struct Stream {
  std::uint64_t seed = 0;
  std::uint32_t stream = 0;  // 0; variance-based indices use 1 as a second, independent stream
};

// Uniform in (0, 1), 52 bits; never 0 or 1. q < 2^33.
double draw(const Stream& from, std::uint64_t trial, std::uint64_t q);

// out[j] = draw(from, first + step j, q), the same bits, by vector instructions. draw_pairs() gives
// both draws of a block, 2g and 2g + 1, in the time of one.
void draws(const Stream& from, std::uint64_t q, std::uint64_t first, std::uint64_t step,
           std::span<double> out, InstructionSet set = best_instruction_set());
void draw_pairs(const Stream& from, std::uint64_t group, std::uint64_t first, std::uint64_t step,
                std::span<double> even, std::span<double> odd,
                InstructionSet set = best_instruction_set());

}  // namespace mdof::algo
