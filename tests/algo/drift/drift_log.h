// The points of a log whose first error and fourth probe drift.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "algo/drift/run_drift.h"
#include "schema/base/random.h"

namespace mdof::algo {

// 13 targets at 0 ... 60 mm, forward and in reverse, with one stop every 2 s. A run takes 52 s.
struct Log {
  int runs = 3, targets = 13;
  double noise_m = 0;
  std::uint32_t seed = 1;
  bool both_ways = true, back_to_start = false;
  std::function<double(double)> drift = [](double) { return 0.0; };  // m, at a time in s
  std::function<double(int)> reversal = [](int) { return 80e-9; };   // m, at a target
  std::function<double(int)> of_run = [](int) { return 0.0; };       // shift, m

  double length_s() const { return 2.0 * (targets * (both_ways ? 2 : 1) * runs - 1); }

  std::vector<MeasuredPoint> points() const {
    std::vector<MeasuredPoint> out;
    for (int run = 1; run <= runs; ++run)
      for (int way = 0; way < (both_ways ? 2 : 1); ++way)
        for (int i = 1; i <= targets; ++i)
          add(out, run, way == 0 ? i : targets + 1 - i, way == 0 ? 1 : -1);
    if (back_to_start) add(out, runs + 1, 1, 1);
    return out;
  }
  double form(int target) const { return 1e-6 * std::sin(target) + 0.2e-6 * target; }

 private:
  void add(std::vector<MeasuredPoint>& out, int run, int target, int direction) const {
    const auto n = static_cast<std::uint32_t>(out.size());
    const double time_s = 2.0 * n;
    MeasuredPoint p;
    p.target = target;
    p.run = run;
    p.target_m = p.point.position_m = 5e-3 * (target - 1);
    p.point.direction = direction;
    p.point.begin_ns = static_cast<std::int64_t>((time_s - 0.5) * 1e9);
    p.point.end_ns = static_cast<std::int64_t>((time_s + 0.5) * 1e9);
    p.errors.valid = true;
    const double whole = drift(time_s) + of_run(run);
    const double side = direction > 0 ? 0.5 : -0.5;
    for (std::uint32_t k = 0; k < 5; ++k)
      p.errors.local[k] =
          form(target) + side * reversal(target) + noise(n, k) + (k == 0 ? whole : 0);
    p.errors.covariance = {};
    for (std::uint32_t k = 0; k < 5; ++k) {
      p.point.probe_m.push_back(form(target) + noise(n, 5 + k) + (k == 3 ? whole : 0));
      p.point.probe_u_m.push_back(0);
    }
    out.push_back(p);
  }
  double noise(std::uint32_t point, std::uint32_t series) const {
    // A hash of three numbers (splitmix64), so that the numbers of different seeds are unrelated.
    std::uint64_t x = (std::uint64_t{seed} << 40) ^ (std::uint64_t{point} << 8) ^ series;
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    x ^= x >> 31;
    return noise_m *
           gaussian(uniform(static_cast<std::uint32_t>(x >> 32), static_cast<std::uint32_t>(x)));
  }
};

inline constexpr double kNoise = 3e-9;

}  // namespace mdof::algo
