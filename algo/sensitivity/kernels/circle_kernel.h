// Cosine and sine of an angle in turns, for vectors.
#pragma once

#include "algo/sensitivity/kernels/vector.h"

namespace mdof::algo {
namespace {

struct CirclePoint {
  Vector cosine, sine;
};

// Cosine and sine of 2π turns, for turns in [0, 1]. Subtracts the nearest quarter turn. For the
// rest |x| <= π/4 it uses Taylor polynomials to x¹⁷ and x¹⁶, whose remainder is below 5e-17. The
// total error is below 2.5e-16.
inline CirclePoint circle_point(Vector turns) {
  constexpr double kTwoPi = 6.283185307179586476925;
  const Vector shifted = turns * 4.0 + 0x1.8p52;  // the low bits contain the nearest integer
  const Vector quarters = shifted - 0x1.8p52;
  const Vector x = (turns - quarters * 0.25) * kTwoPi;
  const Vector y = x * x;
  Vector s = broadcast(1.0 / 355687428096000.0);
  s = s * y - 1.0 / 1307674368000.0;
  s = s * y + 1.0 / 6227020800.0;
  s = s * y - 1.0 / 39916800.0;
  s = s * y + 1.0 / 362880.0;
  s = s * y - 1.0 / 5040.0;
  s = s * y + 1.0 / 120.0;
  s = s * y - 1.0 / 6.0;
  s = x + x * y * s;
  Vector c = broadcast(1.0 / 20922789888000.0);
  c = c * y - 1.0 / 87178291200.0;
  c = c * y + 1.0 / 479001600.0;
  c = c * y - 1.0 / 3628800.0;
  c = c * y + 1.0 / 40320.0;
  c = c * y - 1.0 / 720.0;
  c = c * y + 1.0 / 24.0;
  c = c * y - 0.5;
  c = 1.0 + y * c;
  // (cosine, sine) for the quarters k = 0 ... 3: (c, s), (-s, c), (-c, -s), (s, -c).
  const Words k = as_words(shifted);
  const Words odd = broadcast(std::uint64_t{0}) - (k & 1u);
  const Words cosine = (as_words(c) & ~odd) | (as_words(s) & odd);
  const Words sine = (as_words(s) & ~odd) | (as_words(c) & odd);
  return {as_doubles(cosine ^ (((k + 1u) & 2u) << 62)), as_doubles(sine ^ ((k & 2u) << 62))};
}

}  // namespace
}  // namespace mdof::algo
