// The compiled kernels of one instruction set. Each kernel is written once on vectors (vector.h)
// and compiled for every set; all sets give the same bits.
#pragma once

#include <cstddef>
#include <cstdint>

#include "algo/model/small_angle/small_angle.h"
#include "algo/sensitivity/random.h"
#include "schema/base/instruction_set.h"

namespace mdof::algo {

struct ChainProgram;

// Constants of the paper's simulations, SI.
struct SimulationConstants {
  Stream stream;
  std::uint64_t bins;
  double travel_from, travel_per_bin;
  double angle_range, offset_range;
  double x[5], across[5];  // A to E as installed: x, and y (top) or z (side)
  double h;
  double radius;   // 0: no angles are drawn
  double skew[5];  // skew of the unit: x += skew · Δacross, across -= skew · Δx
  SmallAngleFixture nominal;
};

// Numbers drawn in a trial, for a detailed replay.
struct SimulationDraws {
  double *travel, *truth[5], *turns[5];
};

// Sums of one cell of trials, in fixed order: Σu, Σu² and the extremes of x.
struct CellSums {
  double power[2];
  double min, max;
};

struct Kernels {
  // draws 2 group and 2 group + 1 of trials first + step j
  void (*draw_pairs)(const Stream&, std::uint64_t group, std::uint64_t first, std::uint64_t step,
                     std::size_t n, double* even, double* odd);
  // out: five errors (µm, µrad); draws: null, or destination of the drawn numbers
  void (*simulate)(const SimulationConstants&, std::uint64_t first, std::uint64_t step,
                   std::size_t n, double* const* out, const SimulationDraws* draws);
  // x: n > 0 values, with room for a multiple of 8. t = (x - low) per_width, u = t / 4096 - 1.
  // sums: of u and u². index[j] = 1 + the histogram bin of x[j]; 0 below the bins, 8193 above them
  // (NaN: 0).
  void (*scan)(double* x, std::size_t n, double low, double per_width, CellSums& sums,
               std::uint64_t* index);
  // error: x, y, z of the tool, m. columns: each has `stride` numbers, a multiple of 8 above n - 1.
  void (*chain)(const ChainProgram&, const double* columns, std::size_t stride, std::size_t n,
                double* const* error);
};

inline constexpr std::size_t kCoreBins = 8192;
inline constexpr std::size_t kCellTrials = 512;

const Kernels& kernels(InstructionSet set);
const Kernels& kernels_baseline();
const Kernels& kernels_avx2();
const Kernels& kernels_avx512();

}  // namespace mdof::algo
