// Vector functions for the power sums, extremes and histogram bins of one cell.
#pragma once

#include "algo/sensitivity/kernels/kernels.h"
#include "algo/sensitivity/kernels/vector.h"

namespace mdof::algo {
namespace {

inline constexpr std::size_t kLanes = 8;  // 8 partial sums, over j, j + 8, j + 16 ..., for vectors
                                          // of any width
inline constexpr std::size_t kParts = kLanes / kPerVector;

struct Lanes {
  Vector part[kParts];
};

inline double total(const Lanes& sums) {
  double x[kLanes];
  for (std::size_t p = 0; p < kParts; ++p) write(x + p * kPerVector, sums.part[p]);
  return ((x[0] + x[1]) + (x[2] + x[3])) + ((x[4] + x[5]) + (x[6] + x[7]));
}

struct Scan {
  Lanes power[2]{};
  Lanes min, max;
  double low, per_width;

  // Bin 1 ... 8192 in the core, 0 below it, 8193 above it. A value on the edge of two bins may be
  // in either bin.
  static Words bin_of(Vector t) {
    const Vector top = broadcast(kCoreBins + 0.75);  // so that t + 1/2 rounds to 0 ... 8193
    Vector b = t > -0.5 ? t : broadcast(-0.5);       // also where t is NaN
    b = b < top ? b : top;
    return as_words((b + 0.5) + 0x1p52) - as_words(broadcast(0x1p52));
  }

  template <bool kSome>
  void add(std::size_t p, const double* x, const double* weight, std::uint64_t* index) {
    const Vector v = read(x);
    const Vector t = (v - low) * per_width;
    write(index, bin_of(t));
    Vector u = t * (2.0 / kCoreBins) - 1.0;
    if constexpr (kSome) u = u * read(weight);
    power[0].part[p] += u;
    power[1].part[p] += u * u;
    min.part[p] = v < min.part[p] ? v : min.part[p];
    max.part[p] = v > max.part[p] ? v : max.part[p];
  }
};

inline double extreme(const Lanes& lanes, bool largest) {
  double x[kLanes];
  for (std::size_t p = 0; p < kParts; ++p) write(x + p * kPerVector, lanes.part[p]);
  double found = x[0];
  for (const double y : x) {
    if (largest ? y > found : y < found) found = y;
  }
  return found;
}

inline void scan_kernel(double* x, std::size_t n, double low, double per_width, CellSums& sums,
                        std::uint64_t* index) {
  Scan scan;
  scan.low = low;
  scan.per_width = per_width;
  for (std::size_t p = 0; p < kParts; ++p) scan.min.part[p] = scan.max.part[p] = broadcast(x[0]);
  const std::size_t whole = n / kLanes * kLanes;
  for (std::size_t i = 0; i < whole; i += kLanes) {
    for (std::size_t p = 0; p < kParts; ++p) {
      scan.add<false>(p, x + i + p * kPerVector, nullptr, index + i + p * kPerVector);
    }
  }
  if (whole < n) {
    double weight[kLanes];
    for (std::size_t j = 0; j < kLanes; ++j) {
      weight[j] = whole + j < n ? 1.0 : 0.0;
      if (whole + j >= n) x[whole + j] = x[0];
    }
    for (std::size_t p = 0; p < kParts; ++p) {
      scan.add<true>(p, x + whole + p * kPerVector, weight + p * kPerVector,
                     index + whole + p * kPerVector);
    }
  }
  for (int k = 0; k < 2; ++k) sums.power[k] = total(scan.power[k]);
  sums.min = extreme(scan.min, false);
  sums.max = extreme(scan.max, true);
}

}  // namespace
}  // namespace mdof::algo
