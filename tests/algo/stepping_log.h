// The log of an axis that steps to 13 targets in both directions, three times: 78 stops. This model
// shares no code with the product.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "algo/points/flags.h"
#include "schema/point.h"
#include "schema/sample.h"

namespace mdof::algo {

struct SteppingLog {
  double rate_hz = 500, dwell_s = 0.5, move_s = 0.25;
  double pitch_mm = 5, overrun_mm = 1;
  int targets = 13, runs = 3;
  double encoder_noise_um = 0.005, probe_noise_um = 0.01;
  double probe_step_um = 1e-6;  // resolution of the logged readings; 0: no rounding
  double drift_um_per_min = 0.005;
  std::size_t probes = 5;  // A ... E; the sixth is a top probe, the seventh a side probe
  std::uint64_t seed = 1;

  // Position of the axis at each scan, mm.
  std::vector<double> path_mm() const {
    std::vector<double> stops;  // mm
    std::vector<bool> stays;
    const auto stop = [&](double mm, bool stay) { stops.push_back(mm), stays.push_back(stay); };
    stop(-overrun_mm, false);
    for (int run = 0; run < runs; ++run) {
      for (int i = 0; i < targets; ++i) stop(i * pitch_mm, true);
      stop((targets - 1) * pitch_mm + overrun_mm, false);
      for (int i = targets - 1; i >= 0; --i) stop(i * pitch_mm, true);
      stop(-overrun_mm, false);
    }
    std::vector<double> path(10, stops.front());
    const auto moving = static_cast<int>(move_s * rate_hz);
    const auto still = static_cast<int>(dwell_s * rate_hz);
    for (std::size_t k = 1; k < stops.size(); ++k) {
      for (int i = 1; i <= moving; ++i) {
        const double u = static_cast<double>(i) / moving;
        path.push_back(stops[k - 1] +
                       (stops[k] - stops[k - 1]) * u * u * u * (10 + u * (-15 + 6 * u)));
      }
      for (int i = 0; stays[k] && i < still; ++i) path.push_back(stops[k]);
    }
    return path;
  }

  // Readings of the probes without noise at the position d (mm), in µm, to first order. The form of
  // the axis depends on the seed.
  std::vector<double> readings_um(double d) const {
    const double w = 0.09 * d, p = static_cast<double>(seed % 97);
    const double dy = 1.8 * std::sin(w + p) + 0.01 * d, dz = 1.3 * std::cos(2 * w + 2 * p);
    const double ex = 14 * std::sin(w + 3 * p), ey = 18 * std::cos(w - p),
                 ez = -11 * std::sin(2 * w);
    const auto top = [&](double x, double y) { return dz + 1e-3 * (ex * y + ey * (d - x)); };
    const auto side = [&](double x, double z) { return dy - 1e-3 * (ez * (d - x) + ex * z); };
    std::vector<double> all = {top(10, 0), top(0, 10), top(0, -10), side(0, 20), side(10, 20)};
    if (probes > 5) all.push_back(top(-10, 5));
    if (probes > 6) all.push_back(side(-10, 10));
    all.resize(probes);
    return all;
  }

  FrameBlock frames() const {
    FrameBlock log;
    log.probe_m.resize(probes);
    log.probe_quality.resize(probes);
    std::mt19937_64 engine(seed);
    std::normal_distribution<> unit;
    const auto path = path_mm();
    for (std::size_t i = 0; i < path.size(); ++i) {
      const double t_s = static_cast<double>(i) / rate_hz;
      log.time_ns.push_back(static_cast<std::int64_t>(std::llround(t_s * 1e9)));
      log.encoder_m.push_back(1e-3 * path[i] + 1e-6 * encoder_noise_um * unit(engine));
      const auto exact = readings_um(path[i]);
      for (std::size_t k = 0; k < probes; ++k) {
        double um = exact[k] + probe_noise_um * unit(engine) +
                    drift_um_per_min * (k % 2 ? 1 : -1) * t_s / 60;
        if (probe_step_um > 0) um = std::round(um / probe_step_um) * probe_step_um;
        log.probe_m[k].push_back(um * 1e-6);
      }
    }
    return log;
  }

  std::vector<std::string> ids() const {
    std::vector<std::string> names;
    for (std::size_t k = 0; k < probes; ++k) names.emplace_back(1, static_cast<char>('A' + k));
    return names;
  }
};

// The first row of `frames` at or after this time.
inline std::size_t row_at(const FrameBlock& frames, double time_s) {
  const auto ns = static_cast<std::int64_t>(time_s * 1e9);
  const auto at = std::lower_bound(frames.time_ns.begin(), frames.time_ns.end(), ns);
  return static_cast<std::size_t>(at - frames.time_ns.begin());
}

// Rows `from` to `to` - 1.
inline FrameBlock cut_frames(const FrameBlock& frames, std::size_t from, std::size_t to) {
  const auto cut = [&](const auto& c) {
    using Cut = std::decay_t<decltype(c)>;
    if (c.empty()) return Cut{};
    return Cut(c.begin() + static_cast<std::ptrdiff_t>(from),
               c.begin() + static_cast<std::ptrdiff_t>(to));
  };
  FrameBlock part{cut(frames.time_ns), cut(frames.encoder_m), {}, {}};
  for (const auto& column : frames.probe_m) part.probe_m.push_back(cut(column));
  for (const auto& column : frames.probe_quality) part.probe_quality.push_back(cut(column));
  return part;
}

}  // namespace mdof::algo
