// Sine and cosine of small angles. Without Eigen, because the vector kernels include this header.
#pragma once

namespace mdof::algo {

// Sine and cosine for |x| <= 0.1 rad, within 1 ulp. They use only additions and products, so the
// result has the same bits on every processor. V: double, or a vector of double.
template <class V>
inline V tiny_sin(V x) {
  const V z = x * x;
  return x + x * (z * (-1.0 / 6 + z * (1.0 / 120 + z * (-1.0 / 5040 + z * (1.0 / 362880)))));
}
template <class V>
inline V tiny_cos(V x) {
  const V z = x * x;
  return 1.0 +
         z * (-0.5 + z * (1.0 / 24 + z * (-1.0 / 720 + z * (1.0 / 40320 + z * (-1.0 / 3628800)))));
}

}  // namespace mdof::algo
