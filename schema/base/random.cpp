#include "schema/base/random.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace mdof {
namespace {

// Two numbers in one register. x86-64 processors calculate both at once, other processors one after
// the other.
typedef double Pair __attribute__((vector_size(16)));

// Calculates c[0] + c[1] x + c[2] x² ...
template <std::size_t n, class Number>
Number polynomial(const double (&c)[n], Number x) {
  Number sum = Number{} + c[n - 1];
  for (std::size_t i = n - 1; i-- > 0;) sum = sum * x + c[i];
  return sum;
}

// Natural logarithm. For the mantissa m in [0.5, 1), ln m = 2 artanh(z) with z = (m - 1) / (m + 1),
// |z| <= 1/3; artanh is calculated by its series.
double logarithm(double x) {
  constexpr double kLn2 = 0.693147180559945309417;
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);
  const double z = (mantissa - 1) / (mantissa + 1);
  double sum = 0;
  for (int k = 33; k >= 1; k -= 2) sum = sum * (z * z) + 1.0 / k;
  return 2 * z * sum + exponent * kLn2;
}

constexpr double kCentreP[] = {3.3871328727963666080e0,  1.3314166789178437745e+2,
                               1.9715909503065514427e+3, 1.3731693765509461125e+4,
                               4.5921953931549871457e+4, 6.7265770927008700853e+4,
                               3.3430575583588128105e+4, 2.5090809287301226727e+3};
constexpr double kCentreQ[] = {1.0,
                               4.2313330701600911252e+1,
                               6.8718700749205790830e+2,
                               5.3941960214247511077e+3,
                               2.1213794301586595867e+4,
                               3.9307895800092710610e+4,
                               2.8729085735721942674e+4,
                               5.2264952788528545610e+3};
constexpr double kTailP[] = {1.42343711074968357734e0,  4.63033784615654529590e0,
                             5.76949722146069140550e0,  3.64784832476320460504e0,
                             1.27045825245236838258e0,  2.41780725177450611770e-1,
                             2.27238449892691845833e-2, 7.74545014278341407640e-4};
constexpr double kTailQ[] = {1.0,
                             2.05319162663775882187e0,
                             1.67638483018380384940e0,
                             6.89767334985100004550e-1,
                             1.48103976427480074590e-1,
                             1.51986665636164571966e-2,
                             5.47593808499534494600e-4,
                             1.05075007164441684324e-9};
constexpr double kFarTailP[] = {6.65790464350110377720e0,  5.46378491116411436990e0,
                                1.78482653991729133580e0,  2.96560571828504891230e-1,
                                2.65321895265761230930e-2, 1.24266094738807843860e-3,
                                2.71155556874348757815e-5, 2.01033439929228813265e-7};
constexpr double kFarTailQ[] = {1.0,
                                5.99832206555887937690e-1,
                                1.36929880922735805310e-1,
                                1.48753612908506148525e-2,
                                7.86869131145613259100e-4,
                                1.84631831751005468180e-5,
                                1.42151175831644588870e-7,
                                2.04426310338993978564e-15};

}  // namespace

Philox philox(const Philox& counter, std::uint64_t key) {
  Philox x = counter;
  auto k0 = static_cast<std::uint32_t>(key);
  auto k1 = static_cast<std::uint32_t>(key >> 32);
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t a = std::uint64_t{0xD2511F53} * x[0];
    const std::uint64_t b = std::uint64_t{0xCD9E8D57} * x[2];
    x = {static_cast<std::uint32_t>(b >> 32) ^ x[1] ^ k0, static_cast<std::uint32_t>(b),
         static_cast<std::uint32_t>(a >> 32) ^ x[3] ^ k1, static_cast<std::uint32_t>(a)};
    k0 += 0x9E3779B9;
    k1 += 0xBB67AE85;
  }
  return x;
}

double uniform(std::uint32_t high, std::uint32_t low) {
  const std::uint64_t bits = (std::uint64_t{high} << 32 | low) >> 12;
  return (static_cast<double>(bits) + 0.5) * 0x1p-52;
}

double gaussian(double p) {
  const double q = p - 0.5;
  if (std::abs(q) <= 0.425) {
    const double r = 0.180625 - q * q;
    return q * polynomial(kCentreP, r) / polynomial(kCentreQ, r);
  }
  const double r = std::sqrt(-logarithm(q < 0 ? p : 1 - p));
  const double x = r <= 5 ? polynomial(kTailP, r - 1.6) / polynomial(kTailQ, r - 1.6)
                          : polynomial(kFarTailP, r - 5) / polynomial(kFarTailQ, r - 5);
  return q < 0 ? -x : x;
}

// Uses the formula for the central range for all values, two at a time. Then recalculates the
// values in the tails, one by one.
void gaussians(std::span<double> p) {
  constexpr std::size_t kSome = 64;
  std::array<double, kSome> centre{};
  for (std::size_t first = 0; first < p.size(); first += kSome) {
    const std::span<double> some = p.subspan(first, std::min(kSome, p.size() - first));
    for (std::size_t i = 0; i < kSome; i += 2) {
      const Pair q =
          Pair{i < some.size() ? some[i] : 0.5, i + 1 < some.size() ? some[i + 1] : 0.5} - 0.5;
      const Pair r = 0.180625 - q * q;
      const Pair x = q * polynomial(kCentreP, r) / polynomial(kCentreQ, r);
      centre[i] = x[0];
      centre[i + 1] = x[1];
    }
    for (std::size_t i = 0; i < some.size(); ++i)
      some[i] = std::abs(some[i] - 0.5) <= 0.425 ? centre[i] : gaussian(some[i]);
  }
}

double sine_of_turns(double turns) {
  constexpr double kTwoPi = 6.283185307179586476925;
  double t = turns - std::floor(turns + 0.5);  // [-1/2, 1/2)
  if (t > 0.25) t = 0.5 - t;
  if (t < -0.25) t = -0.5 - t;
  const double x = kTwoPi * t;  // [-π/2, π/2]
  double sum = 1;
  for (int k = 22; k >= 2; k -= 2) sum = 1 - x * x / (k * (k + 1)) * sum;
  return x * sum;
}

}  // namespace mdof
