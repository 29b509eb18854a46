// The random numbers of a trial. Draw q of trial i depends only on (seed, stream, i, q). Therefore
// any trial can be calculated without the others, and an additional quantity at the end of a list
// does not change other numbers.
//
// Philox4x32-10 (schema/base/random.h) with key = seed and counter = {i, i >> 32, q / 2, stream};
// words 0 and 1 of the block are draw 2(q/2), words 2 and 3 are draw 2(q/2) + 1.
#pragma once

#include <cstdint>
#include <span>

#include "schema/base/instruction_set.h"

namespace mdof::algo {

struct Stream {
  std::uint64_t seed = 0;
  std::uint32_t stream = 0;  // variance-based indices use 0 and 1 as two independent streams
};

// Uniform number in (0, 1) with 52 bits, never 0 or 1. q must be below 2^33.
double draw(const Stream& from, std::uint64_t trial, std::uint64_t q);

// out[j] = draw(from, first + step j, q), with the same bits, but calculated by vector
// instructions. draw_pairs() calculates both draws of a block, 2 group and 2 group + 1, in the time
// of one draw.
void draws(const Stream& from, std::uint64_t q, std::uint64_t first, std::uint64_t step,
           std::span<double> out, InstructionSet set = best_instruction_set());
void draw_pairs(const Stream& from, std::uint64_t group, std::uint64_t first, std::uint64_t step,
                std::span<double> even, std::span<double> odd,
                InstructionSet set = best_instruction_set());

}  // namespace mdof::algo
