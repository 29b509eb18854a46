// Calculates the simulations of the paper, with one vector of trials at a time. SI.
#pragma once

#include "algo/model/small_angle/small_angle_kernel.h"
#include "algo/sensitivity/kernels/circle_kernel.h"
#include "algo/sensitivity/kernels/kernels.h"
#include "algo/sensitivity/kernels/random_kernel.h"

namespace mdof::algo {
namespace {

// Exact outputs of a probe at any place (Eq. 2, and the same equation for the side). The terms that
// do not depend on the place are calculated once:
//   Δz = (y - δy) q + (d - x) p + δz
//   Δy = (d - x) along - (z - δz) up + bulge + δy
struct Outputs {
  Vector p, q, along, up, bulge;
  Vector travel, dy, dz;

  Vector top(Vector x, Vector y) const { return (y - dy) * q + (travel - x) * p + dz; }
  Vector side(Vector x, Vector z) const {
    return (travel - x) * along - (z - dz) * up + bulge + dy;
  }
};

inline Outputs outputs_of(Vector travel, const Vector (&e)[5], double h) {
  const Vector ex = e[kEx], ey = e[kEy], ez = e[kEz];
  const Vector by_yaw = 1.0 / (1.0 + ez * ez), by_pitch = 1.0 / (1.0 + ey * ey);
  Outputs o;
  o.p = (ey + ex * ez) * by_yaw;
  o.q = (ex - ey * ez) * by_yaw;
  o.along = (ex * ey - ez) * by_pitch;
  o.up = (ex + ey * ez) * by_pitch;
  o.bulge = (ex * ex + ez * ez) * by_pitch * h;
  o.travel = travel;
  o.dy = e[kDy];
  o.dz = e[kDz];
  return o;
}

struct Drawn {
  Vector travel, truth[5], turns[5];
};

template <bool kCircle>
inline Drawn draw_trial(const SimulationConstants& s, const RoundKeys& keys, Words trial,
                        Vector bin) {
  const std::uint64_t stream = s.stream.stream;
  const Words same[3] = {trial, trial, trial};
  DrawPair main[3];
  draw_blocks(keys, same, {0, 1, 2}, stream, main);
  Drawn drawn;
  drawn.travel = s.travel_from + (bin + main[0].even) * s.travel_per_bin;
  drawn.truth[kDy] = (2.0 * main[0].odd - 1.0) * s.offset_range;
  drawn.truth[kDz] = (2.0 * main[1].even - 1.0) * s.offset_range;
  drawn.truth[kEx] = (2.0 * main[1].odd - 1.0) * s.angle_range;
  drawn.truth[kEy] = (2.0 * main[2].even - 1.0) * s.angle_range;
  drawn.truth[kEz] = (2.0 * main[2].odd - 1.0) * s.angle_range;
  if constexpr (kCircle) {
    DrawPair circle[3];
    draw_blocks(keys, same, {3, 4, 5}, stream, circle);
    drawn.turns[0] = circle[0].even;
    drawn.turns[1] = circle[0].odd;
    drawn.turns[2] = circle[1].even;
    drawn.turns[3] = circle[1].odd;
    drawn.turns[4] = circle[2].even;
  } else {
    for (Vector& turns : drawn.turns) turns = broadcast(0.0);
  }
  return drawn;
}

template <bool kCircle>
inline void errors_of(const SimulationConstants& s, const Drawn& drawn, Vector (&error)[5]) {
  const Outputs o = outputs_of(drawn.travel, drawn.truth, s.h);
  Vector reading[5];
  for (int k = 0; k < 5; ++k) {
    Vector x = broadcast(s.x[k]), across = broadcast(s.across[k]);
    if constexpr (kCircle) {
      const CirclePoint at = circle_point(drawn.turns[k]);
      x += s.radius * (at.cosine + s.skew[k] * at.sine);
      across += s.radius * (at.sine - s.skew[k] * at.cosine);
    }
    reading[k] = k < 3 ? o.top(x, across) : o.side(x, across);
  }
  simplified(s.nominal, drawn.travel, reading, error);
  for (int k = 0; k < 5; ++k) error[k] = (error[k] - drawn.truth[k]) * 1e6;
}

// Bins of one vector of trials, starting at trial `first`. If the step is a multiple of the number
// of bins, all trials are in the same bin.
inline Vector bins_of(std::uint64_t bins, std::uint64_t first, std::uint64_t step) {
  Vector bin = broadcast(0.0);
  for (std::size_t i = 0; i < kPerVector; ++i)
    bin[i] = static_cast<double>((first + step * i) % bins);
  return bin;
}

template <bool kCircle>
void simulate_all(const SimulationConstants& s, std::uint64_t first, std::uint64_t step,
                  std::size_t n, double* const* out, const SimulationDraws* draws) {
  const RoundKeys keys = round_keys(s.stream.seed);
  const Words lanes = lane_numbers() * step;
  const bool one_bin = step % s.bins == 0;
  Vector bin = bins_of(s.bins, first, step);
  for (std::size_t i = 0; i < n; i += kPerVector) {
    const std::uint64_t trial = first + step * i;
    if (!one_bin) bin = bins_of(s.bins, trial, step);
    const Drawn drawn = draw_trial<kCircle>(s, keys, lanes + trial, bin);
    Vector error[5];
    errors_of<kCircle>(s, drawn, error);
    const std::size_t some = n - i < kPerVector ? n - i : kPerVector;
    for (int k = 0; k < 5; ++k) write_some(out[k] + i, error[k], some);
    if (draws == nullptr) continue;
    write_some(draws->travel + i, drawn.travel, some);
    for (int k = 0; k < 5; ++k) {
      write_some(draws->truth[k] + i, drawn.truth[k], some);
      write_some(draws->turns[k] + i, drawn.turns[k], some);
    }
  }
}

inline void simulate_kernel(const SimulationConstants& s, std::uint64_t first, std::uint64_t step,
                            std::size_t n, double* const* out, const SimulationDraws* draws) {
  if (s.radius > 0) {
    simulate_all<true>(s, first, step, n, out, draws);
  } else {
    simulate_all<false>(s, first, step, n, out, draws);
  }
}

}  // namespace
}  // namespace mdof::algo
