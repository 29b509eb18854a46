// Iterative correction of a cut surface: calculates the next path from the errors of the previous
// passes, and the repeatable share of these errors. README.md has the equations (Eq. 4-7). SI.
#pragma once

#include <optional>
#include <vector>

#include "algo/form/map_figures.h"
#include "schema/base/result.h"
#include "schema/form/height_map.h"

namespace mdof::algo {

enum class CuttingGain {
  one,     // uses the error of the last pass (Eq. 5)
  mean,    // uses the mean of all passes: their random errors average out
  optimal  // the mean times repeatable^2 / (repeatable^2 + random^2 / n): the smallest error
};

struct CuttingPasses {
  SurfaceMap wanted;             // z1; also the path of the first pass
  std::vector<SurfaceMap> cuts;  // measured after each pass, in order
  bool repeated = false;  // all used the path of the first pass; else each used the next path
  CuttingGain gain = CuttingGain::one;
  // Side of the square over which parabolas smooth the correction, so that noise of single pixels
  // is not cut into the part. 0: no smoothing. The previous passes were corrected with the same
  // side.
  double smooth_m = 0;
  // RMS of the random error of one pass, if known; `optimal` needs it for the first path.
  std::optional<double> random_rms_m = std::nullopt;
};

struct CuttingResult {
  std::vector<MapFigures> error;  // actual - wanted of each pass
  // Only for two passes or more. The error of a pass relative to its own path has a repeatable
  // share and a random share, as RMS of one pass. The repeatable share does not include the random
  // share of the mean.
  std::optional<double> repeatable_rms_m, random_rms_m;
  std::optional<double> floor_gain_one_m, floor_mean_m,
      floor_optimal_m;  // errors of the next pass and of all later ones
  std::optional<bool> converges;
  std::size_t pixels = 0;        // pixels that all maps have
  SurfaceMap next;               // path of the next pass, over the pixels of `wanted`
  std::optional<double> factor;  // factor of the mean; only with `optimal`
  std::optional<double> left_by_smoothing_rms_m;  // removed from the correction; only with smooth_m
};

// Errors: maps that do not overlap; smooth_m below two pixels; `optimal` with one pass and without
// random_rms_m.
Result<CuttingResult> next_cut(const CuttingPasses& passes);

}  // namespace mdof::algo
