// Harmonics of a path turn by turn: how fast a servo has to move, and what a slow one leaves out.
#pragma once

#include <complex>
#include <cstddef>
#include <vector>

namespace mdof::algo {

// Discrete Fourier transform of any length, by its prime factors (Cooley, Tukey, Mathematics of
// Computation 19 (1965) 297). The same bits in every build.
class Dft {
 public:
  explicit Dft(std::size_t n);
  // X[k] = sum of x[j] exp(-2 pi i j k / n); `inverse` with + and without 1 / n.
  void transform(std::vector<std::complex<double>>& x, bool inverse) const;

 private:
  void step(const std::complex<double>* in, std::complex<double>* out, std::size_t n,
            std::size_t stride, std::size_t factor, bool inverse) const;
  std::size_t n_;
  std::vector<std::size_t> factors_;
  std::vector<std::complex<double>> root_;  // exp(-2 pi i k / n)
  mutable std::vector<std::complex<double>> out_, room_;
};

struct PassedBand {
  double pv = 0, rms = 0;  // of what is left out
};

// Takes the heights of a path point by point.
class TurnSpectrum {
 public:
  // What lies above `band_harmonic` is what a low pass leaves out; a negative one: no low pass.
  TurnSpectrum(std::size_t points_per_turn, double band_harmonic);
  // Points of the last turn that is not whole have no part in it. A turn ends at another height
  // than it begins, by the feed: the line from its start to the start of the next is no undulation.
  void add(double z);
  // A last turn that is whole, but has no next one, drifts as the turn before it.
  void finish();

  // The largest harmonic whose amplitude in any turn is at least `share` of the largest amplitude
  // of any harmonic and turn; 0: nothing moves.
  std::size_t undulations(double share) const;
  PassedBand left_out() const;
  std::size_t turns() const { return turns_; }

 private:
  void finish_turn(double next);
  Dft dft_;
  double band_harmonic_;
  std::vector<double> turn_, largest_;  // largest_[n]: amplitude of harmonic n over all turns
  std::vector<std::complex<double>> work_;
  std::size_t turns_ = 0;
  double squares_ = 0, least_ = 0, most_ = 0, height_ = 0;
  double change_ = 0;  // from the start of a turn to the start of the next
  double bend_ = 0;    // the largest by which that differs from turn to turn
};

}  // namespace mdof::algo
