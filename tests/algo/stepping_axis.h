// A simulated machine axis with an encoder. A test commands its moves and stops.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "algo/points/dwell.h"
#include "schema/sample.h"

namespace mdof::algo {

// stop() moves to a position and waits there.
struct SteppingAxis {
  double rate_hz = 500, dwell_s = 0.4, speed_m_s = 0.05, noise_m = 10e-9;
  double x_m = -1e-3;
  std::int64_t t_ns = 0;
  FrameBlock frames;
  std::mt19937_64 rng{1};

  explicit SteppingAxis(std::uint64_t seed = 1) : rng(seed) {
    frames.probe_m.resize(1);
    frames.probe_quality.resize(1);
  }
  void scan() {
    std::normal_distribution<> unit;
    frames.time_ns.push_back(t_ns);
    frames.encoder_m.push_back(x_m + noise_m * unit(rng));
    frames.probe_m[0].push_back(1e-3 * x_m + noise_m * unit(rng));
    t_ns += static_cast<std::int64_t>(1e9 / rate_hz);
  }
  void move_to(double target_m) {
    const double step_m = speed_m_s / rate_hz;
    while (std::abs(target_m - x_m) > step_m) {
      x_m += target_m > x_m ? step_m : -step_m;
      scan();
    }
    x_m = target_m;
  }
  void wait(double s) {
    for (int i = 0; i < s * rate_hz; ++i) scan();
  }
  void stop(double target_m) {
    move_to(target_m);
    wait(dwell_s);
  }
  // Moves past the target by `by_m`, returns and stops.
  void stop_overshot(double target_m, double by_m) {
    move_to(target_m + (target_m > x_m ? by_m : -by_m));
    stop(target_m);
  }
  std::vector<Point> points() const {
    DwellDetector detector({}, {"A"}, {200e-6});
    std::vector<Point> found;
    detector.push(frames, found);
    detector.flush(found);
    return found;
  }
};

}  // namespace mdof::algo
