// The vector functions ("kernels") of the sensitivity studies. Each kernel has one source with
// vectors (vector.h), and is compiled for each instruction set. The results have the same bits with
// all instruction sets.
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
  double x[5], across[5];  // installed places of probes A to E: x, and y (top) or z (side)
  double h;
  double radius;   // mounting tolerance of a probe; 0: no angles are drawn
  double skew[5];  // rotation of the unit: x += skew · Δacross, across -= skew · Δx
  SmallAngleFixture nominal;
};

// Destinations of the numbers that were drawn, for the details of one trial.
struct SimulationDraws {
  double *travel, *truth[5], *turns[5];
};

// Σu, Σu² (u: see Kernels::scan), minimum and maximum of x over one cell of trials. The order of
// the additions is fixed.
struct CellSums {
  double power[2];
  double min, max;
};

struct Kernels {
  // Calculates draws 2 group and 2 group + 1 of the trials first + step j.
  void (*draw_pairs)(const Stream&, std::uint64_t group, std::uint64_t first, std::uint64_t step,
                     std::size_t n, double* even, double* odd);
  // out: five errors (µm, µrad). draws: null, or destinations of the numbers.
  void (*simulate)(const SimulationConstants&, std::uint64_t first, std::uint64_t step,
                   std::size_t n, double* const* out, const SimulationDraws* draws);
  // x: n > 0 values; the memory must be large enough for the next multiple of 8. With t = (x - low)
  // per_width and u = t / 4096 - 1, sums contains Σu and Σu². index[j] = 1 + histogram bin of x[j];
  // 0 below the bins and for NaN, 8193 above the bins.
  void (*scan)(double* x, std::size_t n, double low, double per_width, CellSums& sums,
               std::uint64_t* index);
  // error: errors of the tool point in x, y, z, m. columns: each column has `stride` numbers;
  // `stride` is a multiple of 8 and at least n.
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
