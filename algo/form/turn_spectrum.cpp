#include "algo/form/turn_spectrum.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "schema/base/random.h"

namespace mdof::algo {
namespace {

using Complex = std::complex<double>;

// Relative to the largest height: limit of the amplitudes that rounding causes.
constexpr double kRounding = 1e-13;

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

TurnSpectrum::TurnSpectrum(std::size_t points_per_turn, double band_harmonic,
                           std::function<double(std::size_t turn)> error)
    : dft_(points_per_turn),
      band_harmonic_(band_harmonic),
      error_(std::move(error)),
      largest_(points_per_turn / 2 + 1),
      last_(points_per_turn / 2 + 1),
      bend_(points_per_turn / 2 + 1),
      work_(points_per_turn) {
  turn_.reserve(points_per_turn);
  const auto n = static_cast<double>(points_per_turn);
  for (std::size_t h = 1; h < bend_.size(); ++h) {
    const double sine = n * sine_of_turns(static_cast<double>(h) / (2 * n));
    bend_[h] = 1 / (sine * sine);
  }
}

void TurnSpectrum::add(double z) {
  if (turn_.size() == work_.size()) finish_turn(z);
  turn_.push_back(z);
  height_ = std::max(height_, std::abs(z));
}

void TurnSpectrum::finish() {
  if (turn_.size() == work_.size()) finish_turn(turn_.front() + change_ + step_);
}

void TurnSpectrum::finish_turn(double next) {
  const std::size_t n = turn_.size();
  const double change = next - turn_.front();
  if (turns_ > 0) {
    const double step = change - change_;
    count_last(turns_ > 1 ? step_ : step, step, largest_);
    step_ = step;
  }
  change_ = change;
  for (std::size_t k = 0; k < n; ++k)
    work_[k] = turn_[k] - change_ * (static_cast<double>(k) / static_cast<double>(n));
  turn_.clear();
  ++turns_;
  dft_.transform(work_, false);
  const double scale = 1 / static_cast<double>(n);
  for (std::size_t h = 1; h < last_.size(); ++h) {
    const double both = 2 * h == n ? 1 : 2;
    const Complex x = work_[h];
    last_[h] = both * scale * std::sqrt(x.real() * x.real() + x.imag() * x.imag());
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

// A surface whose height depends on the radius alone also has harmonics, because the line of a turn
// does not follow the bend of this surface. A kink that changes the slope by K per turn, at the
// share s of the turn, leaves the amplitude K |sin(pi h s)| / (n sin(pi h / n))^2 of the harmonic
// h: the second difference of the heights minus the line is K / n at the kink and -K / n at the
// start of the turn. K = K (1 - s) + K s is the sum of the steps of `change_` before and after this
// turn. A bend is a sum of kinks. If all kinks of the three turns have the same sign, K of the bend
// in the turn is at most the sum of both steps.
void TurnSpectrum::count_last(double step_before, double step_after,
                              std::vector<double>& largest) const {
  const double bend = std::abs(step_before) + std::abs(step_after),
               error = (error_ ? error_(turns_ - 1) : 0) + kRounding * height_;
  for (std::size_t h = 1; h < largest.size(); ++h)
    if (last_[h] > bend * bend_[h] + error) largest[h] = std::max(largest[h], last_[h]);
}

std::size_t TurnSpectrum::undulations(double share) const {
  std::vector<double> largest = largest_;
  if (turns_ > 0) count_last(step_, step_, largest);
  double most = 0;
  for (const double amplitude : largest) most = std::max(most, amplitude);
  std::size_t found = 0;
  for (std::size_t h = 1; h < largest.size(); ++h)
    if (largest[h] > 0 && largest[h] >= share * most) found = h;
  return found;
}

MotionAboveBand TurnSpectrum::left_out() const {
  const auto points = static_cast<double>(turns_ * work_.size());
  return {most_ - least_, points > 0 ? std::sqrt(squares_ / points) : 0};
}

}  // namespace mdof::algo
