#include "algo/form/turn_spectrum.h"

#include <algorithm>
#include <cmath>

#include "schema/base/random.h"

namespace mdof::algo {
namespace {

using Complex = std::complex<double>;

// Amplitudes that are smaller than this factor times the largest height are taken as 0.
constexpr double kRounding = 1e-13;
constexpr double kBendRemainder =
    1.0 / 16;  // relative to the change of slope between two turns: amplitude that remains after
               // subtraction of the line (1 / (2 pi^2), rounded up)

// Faster than operator* of the standard library, which also handles infinities.
Complex times(const Complex& a, const Complex& b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

}  // namespace

Dft::Dft(std::size_t n) : n_(n), out_(n) {
  for (std::size_t rest = n, p = 2; rest > 1; ++p) {
    if (p * p > rest) p = rest;
    for (; rest % p == 0; rest /= p) factors_.push_back(p);
  }
  for (std::size_t k = 0; k < n; ++k) {
    const double turns = static_cast<double>(k) / static_cast<double>(n);
    root_.emplace_back(sine_of_turns(turns + 0.25), -sine_of_turns(turns));
  }
  room_.resize(factors_.empty() ? 1 : factors_.back());
}

// Transforms n values of `in`: every stride-th value.
void Dft::step(const Complex* in, Complex* out, std::size_t n, std::size_t stride,
               std::size_t factor, bool inverse) const {
  if (n == 1) {
    *out = *in;
    return;
  }
  const std::size_t p = factors_[factor], m = n / p;
  for (std::size_t q = 0; q < p; ++q)
    step(in + q * stride, out + q * m, m, stride * p, factor + 1, inverse);
  const auto root = [&](std::size_t k) {  // k-th power of the n-th root of unity
    const Complex& w = root_[k % n * stride];
    return inverse ? Complex(w.real(), -w.imag()) : w;
  };
  for (std::size_t k = 0; k < m; ++k) {
    if (p == 2) {
      const Complex odd = times(out[m + k], root(k)), even = out[k];
      out[k] = even + odd;
      out[m + k] = even - odd;
      continue;
    }
    for (std::size_t q = 0; q < p; ++q) room_[q] = times(out[q * m + k], root(q * k));
    for (std::size_t r = 0; r < p; ++r) {
      Complex sum = room_[0];
      for (std::size_t q = 1; q < p; ++q) sum += times(room_[q], root(q * r * m));
      out[r * m + k] = sum;
    }
  }
}

void Dft::transform(std::vector<Complex>& x, bool inverse) const {
  step(x.data(), out_.data(), n_, 1, 0, inverse);
  x.swap(out_);
}

TurnSpectrum::TurnSpectrum(std::size_t points_per_turn, double band_harmonic)
    : dft_(points_per_turn),
      band_harmonic_(band_harmonic),
      largest_(points_per_turn / 2 + 1),
      work_(points_per_turn) {
  turn_.reserve(points_per_turn);
}

void TurnSpectrum::add(double z) {
  if (turn_.size() == work_.size()) finish_turn(z);
  turn_.push_back(z);
  height_ = std::max(height_, std::abs(z));
}

void TurnSpectrum::finish() {
  if (turn_.size() == work_.size()) finish_turn(turn_.front() + change_);
}

void TurnSpectrum::finish_turn(double next) {
  const std::size_t n = turn_.size();
  const double change = next - turn_.front();
  if (turns_ > 0) largest_change_step_ = std::max(largest_change_step_, std::abs(change - change_));
  change_ = change;
  for (std::size_t k = 0; k < n; ++k)
    work_[k] = turn_[k] - change_ * (static_cast<double>(k) / static_cast<double>(n));
  turn_.clear();
  ++turns_;
  dft_.transform(work_, false);
  const double scale = 1 / static_cast<double>(n);
  for (std::size_t h = 1; h < largest_.size(); ++h) {
    const double both = 2 * h == n ? 1 : 2;
    const Complex x = work_[h];
    const double amplitude = both * scale * std::sqrt(x.real() * x.real() + x.imag() * x.imag());
    largest_[h] = std::max(largest_[h], amplitude);
  }
  if (band_harmonic_ < 0) return;
  for (std::size_t k = 0; k < n; ++k)
    if (static_cast<double>(std::min(k, n - k)) <= band_harmonic_) work_[k] = 0;
  dft_.transform(work_, true);
  for (const Complex& x : work_) {
    const double left = x.real() * scale;
    least_ = std::min(least_, left);
    most_ = std::max(most_, left);
    squares_ += left * left;
  }
}

std::size_t TurnSpectrum::undulations(double share) const {
  double most = 0;
  for (std::size_t h = 1; h < largest_.size(); ++h) most = std::max(most, largest_[h]);
  std::size_t found = 0;
  for (std::size_t h = 1; h < largest_.size(); ++h)
    if (largest_[h] > std::max(kRounding * height_, kBendRemainder * largest_change_step_) &&
        largest_[h] >= share * most)
      found = h;
  return found;
}

MotionAboveBand TurnSpectrum::left_out() const {
  const auto points = static_cast<double>(turns_ * work_.size());
  return {most_ - least_, points > 0 ? std::sqrt(squares_ / points) : 0};
}

}  // namespace mdof::algo
