// Harmonics of a path, turn by turn: the bandwidth that a servo needs, and the part that a slow
// servo omits.
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
  double pv = 0, rms = 0;  // figures of the omitted part
};

// Receives the heights of a path point by point.
class TurnSpectrum {
 public:
  // The omitted part is that above `band_harmonic`; if it is negative, there is no low pass.
  TurnSpectrum(std::size_t points_per_turn, double band_harmonic);
  // Points of an incomplete last turn are ignored. The feed makes the end of a turn higher or lower
  // than its start: the line from its start to the start of the next turn is subtracted.
  void add(double z);
  // Ends the path. A complete last turn without a next one gets the drift of the turn before.
  void finish();

  // The largest harmonic whose amplitude in any turn is at least `share` of the largest amplitude
  // of all harmonics and turns; 0: no motion.
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
  double change_ = 0;               // from the start of a turn to the start of the next
  double largest_change_step_ = 0;  // largest difference of `change_` between successive turns
};

}  // namespace mdof::algo
