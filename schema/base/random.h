// Random numbers and a sine that have the same bits with every compiler, build type and library.
// The functions use only integers, + - * / and sqrt, which IEEE 754 rounds correctly. Stateless and
// thread-safe.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace mdof {

// Philox4x32-10 (Salmon et al., "Parallel random numbers: as easy as 1, 2, 3", SC11). It calculates
// a random number as a hash of a counter and a key. Therefore any number of any random sequence can
// be calculated directly.
using Philox = std::array<std::uint32_t, 4>;
Philox philox(const Philox& counter, std::uint64_t key);

// Converts two 32-bit words to a double with 52 random bits, in (0, 1); the result is never 0 or 1.
double uniform(std::uint32_t high, std::uint32_t low);

// Quantile of the standard normal distribution at p in (0, 1), with a relative error of about
// 1e-15. Algorithm: Wichura's AS 241 (Applied Statistics 37, 1988), PPND16, with a logarithm that
// is part of mdof.
double gaussian(double p);
// Replaces each p by its quantile. Returns the same bits as gaussian(), three times as fast.
void gaussians(std::span<double> p);

// sin(2π turns), with an absolute error of at most 1e-15 for |turns| < 1e6.
double sine_of_turns(double turns);

}  // namespace mdof
