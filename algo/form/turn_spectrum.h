// Harmonics of each turn of a path. The harmonics show which bandwidth a servo needs, and which
// motion a slower servo leaves out.
#pragma once

#include <complex>
#include <cstddef>
#include <functional>
#include <vector>

namespace mdof::algo {

// Discrete Fourier transform of any length, calculated by the prime factors of the length (Cooley,
// Tukey, Mathematics of Computation 19 (1965) 297). The results have the same bits in every build.
class Dft {
 public:
  explicit Dft(std::size_t n);
  // X[k] = sum over j of x[j] exp(-2 pi i j k / n). `inverse`: with + in the exponent, not divided
  // by n.
  void transform(std::vector<std::complex<double>>& x, bool inverse) const;

 private:
  void step(const std::complex<double>* in, std::complex<double>* out, std::size_t n,
            std::size_t stride, std::size_t factor, bool inverse) const;
  std::size_t n_;
  std::vector<std::size_t> factors_;
  std::vector<std::complex<double>> root_;  // exp(-2 pi i k / n)
  mutable std::vector<std::complex<double>> out_, room_;
};

struct MotionAboveBand {
  double pv = 0, rms = 0;  // of the motion above the band
};

// Receives the heights of a path point by point.
class TurnSpectrum {
 public:
  // left_out() evaluates the harmonics above `band_harmonic`. If `band_harmonic` is negative,
  // left_out() is 0. `error`: upper limit of the amplitude that the interpolation between pixels
  // causes in a turn (0, 1, ...); no function: 0.
  TurnSpectrum(std::size_t points_per_turn, double band_harmonic,
               std::function<double(std::size_t turn)> error = {});
  // Ignores the points of an incomplete last turn. Because of the feed, the end of a turn has
  // another height than its start. Therefore the line from the start of the turn to the start of
  // the next turn is subtracted.
  void add(double z);
  // Ends the path. A complete last turn has no next turn; the slopes of the two turns before
  // determine the slope of its line.
  void finish();

  // The highest harmonic whose amplitude in any turn is at least `share` times the largest
  // amplitude of all harmonics and turns. In a turn, only amplitudes count that neither the bend of
  // a surface of revolution nor `error` explains. 0: no amplitude counts.
  std::size_t undulations(double share) const;
  MotionAboveBand left_out() const;
  std::size_t turns() const { return turns_; }

 private:
  void finish_turn(double next);
  // Updates `largest` with the amplitudes of the last turn that count. The steps: differences of
  // `change_` between this turn and the turns before and after.
  void count_last(double step_before, double step_after, std::vector<double>& largest) const;
  Dft dft_;
  double band_harmonic_;
  std::function<double(std::size_t turn)> error_;
  std::vector<double> turn_;
  // For harmonic h: largest amplitude that counts in any turn except the last; amplitude in the
  // last turn; amplitude that a kink of slope 1 per turn leaves.
  std::vector<double> largest_, last_, bend_;
  std::vector<std::complex<double>> work_;
  std::size_t turns_ = 0;
  double squares_ = 0, least_ = 0, most_ = 0, height_ = 0;
  // Height of the start of the next turn minus height of the start of this turn.
  double change_ = 0;
  double step_ = 0;  // `change_` minus the `change_` of the turn before
};

}  // namespace mdof::algo
