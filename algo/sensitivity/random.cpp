#include "algo/sensitivity/random.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "algo/sensitivity/kernels/kernels.h"
#include "schema/base/random.h"

namespace mdof::algo {

double draw(const Stream& from, std::uint64_t trial, std::uint64_t q) {
  const Philox words =
      philox({static_cast<std::uint32_t>(trial), static_cast<std::uint32_t>(trial >> 32),
              static_cast<std::uint32_t>(q / 2), from.stream},
             from.seed);
  return q % 2 == 0 ? uniform(words[0], words[1]) : uniform(words[2], words[3]);
}

void draws(const Stream& from, std::uint64_t q, std::uint64_t first, std::uint64_t step,
           std::span<double> out, InstructionSet set) {
  std::array<double, 256> other{};
  for (std::size_t at = 0; at < out.size(); at += other.size()) {
    const std::span<double> part = out.subspan(at, std::min(other.size(), out.size() - at));
    const std::span<double> rest(other.data(), part.size());
    draw_pairs(from, q / 2, first + step * at, step, q % 2 == 0 ? part : rest,
               q % 2 == 0 ? rest : part, set);
  }
}

void draw_pairs(const Stream& from, std::uint64_t group, std::uint64_t first, std::uint64_t step,
                std::span<double> even, std::span<double> odd, InstructionSet set) {
  assert(even.size() == odd.size());
  kernels(set).draw_pairs(from, group, first, step, even.size(), even.data(), odd.data());
}

}  // namespace mdof::algo
