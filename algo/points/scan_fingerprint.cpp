#include "algo/points/scan_fingerprint.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

namespace mdof::algo {
namespace {

constexpr std::size_t kGroup = 8;

// The finalizer of SplitMix64 (Steele, Lea, Flood 2014): each bit of the input changes about half
// of the bits of the output.
std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31U);
}

std::uint64_t hash_of_row(const FrameBlock& frames, std::size_t row) {
  std::uint64_t hash = mixed(std::bit_cast<std::uint64_t>(frames.encoder_m[row]) + 1);
  for (const auto& column : frames.probe_m)
    hash = mixed(hash + std::bit_cast<std::uint64_t>(column[row]));
  return hash;
}

}  // namespace

std::uint64_t scan_fingerprint(const FrameBlock& frames, std::size_t from, std::size_t to) {
  if (to < from + kGroup) return 0;
  std::array<std::uint64_t, kGroup> rows{};
  std::uint64_t smallest = std::numeric_limits<std::uint64_t>::max();
  for (std::size_t i = from; i < to; ++i) {
    rows[i % kGroup] = hash_of_row(frames, i);
    if (i + 1 < from + kGroup) continue;
    std::uint64_t group = 0;
    for (std::size_t k = 1; k <= kGroup; ++k) group = mixed(group + rows[(i + k) % kGroup]);
    smallest = std::min(smallest, group);
  }
  return smallest;
}

}  // namespace mdof::algo
