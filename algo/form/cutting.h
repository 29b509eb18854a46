// Iterative correction of a cut surface: the next path from what the passes before left, and how
// much of their error comes again. README.md has the equations (Eq. 4-7). SI.
#pragma once

#include <optional>
#include <vector>

#include "algo/form/map_figures.h"
#include "schema/base/result.h"
#include "schema/form/height_map.h"

namespace mdof::algo {

enum class CuttingGain {
  one,     // the error of the last pass (Eq. 5)
  mean,    // the mean of all passes: their random shares average out
  optimal  // the mean times repeatable^2 / (repeatable^2 + random^2 / n): the least error
};

struct CuttingPasses {
  SurfaceMap wanted;             // z1, and the path of the first pass
  std::vector<SurfaceMap> cuts;  // measured after each pass, in order
  bool repeated = false;         // all were cut with the path of the first; else each with the next
  CuttingGain gain = CuttingGain::one;
  // Side of the square over which the correction is smoothed by parabolas: noise of single pixels
  // is then not cut into the part. 0: none. The passes before were corrected with the same one.
  double smooth_m = 0;
  // RMS of the random share of one pass, where it is known; `optimal` needs it for the first path.
  std::optional<double> random_rms_m = std::nullopt;
};

struct CuttingResult {
  std::vector<MapFigures> error;  // actual - wanted of each pass
  // Of two passes and more. What a pass leaves against its own path is a share that comes again and
  // a random one, RMS of one pass; the first is freed of what of the second is in the mean.
  std::optional<double> repeatable_rms_m, random_rms_m;
  std::optional<double> floor_gain_one_m, floor_mean_m,
      floor_optimal_m;  // of the next pass, for ever
  std::optional<bool> converges;
  std::size_t pixels = 0;        // that all maps have
  SurfaceMap next;               // the path of the next pass, over the pixels of `wanted`
  std::optional<double> factor;  // of the mean; only with `optimal`
  std::optional<double> left_by_smoothing_rms_m;  // of the correction; only with smooth_m
};

// Errors: maps that do not overlap; smooth_m below two pixels; `optimal` of one pass without
// random_rms_m.
Result<CuttingResult> next_cut(const CuttingPasses& passes);

}  // namespace mdof::algo
