// Random numbers and a sine with the same bits from every compiler, build type and library. They
// use only integers, + - * / and sqrt, which IEEE 754 rounds correctly. Stateless and thread-safe.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace mdof {

// Philox4x32-10 (Salmon et al., "Parallel random numbers: as easy as 1, 2, 3", SC11): a keyed hash
// of a counter. Any number of any stream can be calculated directly.
using Philox = std::array<std::uint32_t, 4>;
Philox philox(const Philox& counter, std::uint64_t key);

// Converts two words to a double in (0, 1): 52 bits, never 0 or 1.
double uniform(std::uint32_t high, std::uint32_t low);

// Quantile of the standard normal distribution at p in (0, 1), to about 1e-15 relative. Wichura's
// AS 241 (Applied Statistics 37, 1988), PPND16, with mdof's own logarithm.
double gaussian(double p);
// Replaces each p by its quantile: the same bits as gaussian() in a third of the time.
void gaussians(std::span<double> p);

// sin(2π turns), to 1e-15 absolute for |turns| < 1e6.
double sine_of_turns(double turns);

}  // namespace mdof
