// The SHA-256 of the result of a run. Two runs have the same hash only if every point, straightness
// figure and angle figure is bit-identical. The hash does not depend on the computer, the compiler
// or the file. Provenance, file names and UTC times are not included.
//
// The hash is over the bytes of all points, then of all straightness figures, then of all angle
// figures. The letters i (integer), d (double) and s (text) are defined in schema/base/canonical.h.
//   point:
//     i target, d target_m, i repetition, i direction, i begin_ns, i end_ns, d position_m,
//     i samples, i number of flags, s each flag,
//     i n, d probe_m[n], i n, d probe_u_m[n],
//     with errors:     i 1, d 5 local errors, d residual_m, d 25 covariance
//     without errors:  i 0, s reason
//   straightness figure:
//     s error_key, s approach, d the seven values in the order of schema/run.h
//   angle figure:
//     s error_key, s approach, d start_rad, d min_rad, d max_rad
#pragma once

#include <cstdint>
#include <string>

#include "schema/base/sha256.h"
#include "schema/run.h"

namespace mdof::store {

class ResultHash {
 public:
  void add(const MeasuredPoint& point);
  void add(const StraightnessFigure& figure);
  void add(const AngleFigure& figure);
  std::string hex() const;

 private:
  Sha256 hash_;
  std::string row_;  // memory for the bytes of one row
};

std::string result_sha256(const Run& run);
// The first 8 bytes of the SHA-256 of the bytes that ResultHash uses for one point.
std::uint64_t row_hash(const MeasuredPoint& point);

}  // namespace mdof::store
