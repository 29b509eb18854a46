// A surface that is the sum of many plane waves; each wave has a random direction and phase. By the
// central limit theorem the heights are normally distributed, and equally in all directions. No
// other code of the project uses this model.
#pragma once

#include <cmath>
#include <random>
#include <vector>

namespace mdof::algo::test_faults {

class DrawnSurface {
 public:
  // `u_m`: standard deviation of the heights. `length_m`: the longest wave L. The waves have the
  // lengths L, L/2, L/3 and L/4 and the weights 1/k² for the length L/k.
  template <class Engine>
  DrawnSurface(double u_m, double length_m, Engine& engine) {
    constexpr int kWaves = 20;  // number of waves of each length
    const double norm = 1 + 1 / 16.0 + 1 / 81.0 + 1 / 256.0;
    std::normal_distribution<> normal;
    std::uniform_real_distribution<> uniform;
    for (int k = 1; k <= 4; ++k)
      for (int w = 0; w < kWaves; ++w) {
        const double angle = 2 * M_PI * uniform(engine), per_m = 2 * M_PI * k / length_m;
        const double u = u_m / (k * k) / std::sqrt(norm * kWaves);
        waves_.push_back({per_m * std::cos(angle), per_m * std::sin(angle), u * normal(engine),
                          u * normal(engine)});
      }
  }
  double height_m(double first_m, double second_m) const {
    double sum = 0;
    for (const Wave& w : waves_) {
      const double phase = w.along * first_m + w.across * second_m;
      sum += w.cosine_m * std::cos(phase) + w.sine_m * std::sin(phase);
    }
    return sum;
  }
  // Change of the height under a probe, m, since the probe was zeroed over this place at the travel
  // 0.
  double above_zero_m(double first_m, double second_m, double travel_m) const {
    return height_m(first_m - travel_m, second_m) - height_m(first_m, second_m);
  }

 private:
  struct Wave {
    double along, across, cosine_m, sine_m;
  };
  std::vector<Wave> waves_;
};

}  // namespace mdof::algo::test_faults
