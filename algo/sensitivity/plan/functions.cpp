#include "algo/sensitivity/plan/functions.h"

#include <cassert>
#include <cmath>

namespace mdof::algo {
namespace {

// 42 bits, so that products with |k| < 2^11 are exact.
constexpr double kLn2High = 0x1.62e42fefa38p-1;
constexpr double kLn2Low = 0x1.ef35793c7673p-45;  // ln 2 - kLn2High
constexpr double kHalfLnTwoPi = 0.91893853320467274178;
constexpr double kLnPi = 1.14472988584940017414;
constexpr double kInverseRootTwoPi = 0.39894228040143267794;

// Continued fraction of the incomplete beta function by the modified Lentz method.
double beta_fraction(double a, double b, double x) {
  constexpr double kTiny = 1e-300;
  const auto safe = [](double v) { return std::abs(v) < kTiny ? kTiny : v; };
  double c = 1, d = 1 / safe(1 - (a + b) * x / (a + 1));
  double h = d;
  for (int m = 1; m < 2000; ++m) {
    const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
    d = 1 / safe(1 + even * d);
    c = safe(1 + even / c);
    h *= d * c;
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
    d = 1 / safe(1 + odd * d);
    c = safe(1 + odd / c);
    const double factor = d * c;
    h *= factor;
    if (std::abs(factor - 1) < 1e-15) break;
  }
  return h;
}

}  // namespace

double natural_log(double x) {
  assert(x > 0);
  int exponent = 0;
  double mantissa = std::frexp(x, &exponent);  // [1/2, 1)
  if (mantissa < 0.70710678118654752440) {
    mantissa *= 2;
    --exponent;
  }
  const double z = (mantissa - 1) / (mantissa + 1);  // |z| < 0.172; the series is 2 artanh(z)
  double sum = 0;
  for (int k = 23; k >= 1; k -= 2) sum = sum * (z * z) + 1.0 / k;
  return exponent * kLn2High + (2 * z * sum + exponent * kLn2Low);
}

double exponential(double x) {
  if (x < -700) return 0;
  assert(x <= 700);
  const double k = std::floor(x / (kLn2High + kLn2Low) + 0.5);
  const double r = (x - k * kLn2High) - k * kLn2Low;  // |r| < 0.347
  double sum = 1;
  for (int n = 15; n >= 1; --n) sum = 1 + sum * r / n;
  return std::ldexp(sum, static_cast<int>(k));
}

double normal_density(double z) {
  return kInverseRootTwoPi * exponential(-z * z / 2);
}

double normal_cdf(double z) {
  const double a = std::abs(z);
  double upper = 0;  // P(Z > a)
  if (a < 3) {
    // Φ - 1/2 = φ (a + a³/3 + a⁵/15 ...): all terms have the same sign
    double term = a, sum = a;
    for (int k = 3; term > sum * 1e-17; k += 2) {
      term *= a * a / k;
      sum += term;
    }
    upper = 0.5 - normal_density(a) * sum;
  } else {
    // Laplace's continued fraction of Mills' ratio
    double tail = a;
    for (int k = 80; k >= 1; --k) tail = a + k / tail;
    upper = normal_density(a) / tail;
  }
  return z < 0 ? upper : 1 - upper;
}

double log_gamma(double x) {
  assert(x > 0);
  double product = 1;
  for (; x < 15; x += 1) product *= x;
  const double z = 1 / (x * x);
  // Stirling's series, DLMF 5.11.1; from x = 15 on the next term is below 1e-17
  const double series =
      (1.0 / 12 -
       z * (1.0 / 360 -
            z * (1.0 / 1260 - z * (1.0 / 1680 - z * (1.0 / 1188 - z * (691.0 / 360360)))))) /
      x;
  return (x - 0.5) * natural_log(x) - x + kHalfLnTwoPi + series - natural_log(product);
}

double t_upper_tail(double x, double dof) {
  assert(x >= 0 && dof > 0);
  if (x == 0) return 0.5;
  const double a = dof / 2, b = 0.5, square = x * x;
  const double y = dof / (dof + square), rest = square / (dof + square);  // y + rest = 1
  const double front = exponential(log_gamma(a + b) - log_gamma(a) - kLnPi / 2 +
                                   a * natural_log(y) + b * natural_log(rest));
  if (y < (a + 1) / (a + b + 2)) return 0.5 * front * beta_fraction(a, b, y) / a;
  return 0.5 * (1 - front * beta_fraction(b, a, rest) / b);
}

double t_density(double x, double dof) {
  const double log_density = log_gamma((dof + 1) / 2) - log_gamma(dof / 2) -
                             (natural_log(dof) + kLnPi) / 2 -
                             (dof + 1) / 2 * natural_log(1 + x * x / dof);
  return exponential(log_density);
}

}  // namespace mdof::algo
