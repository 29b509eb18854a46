// Iterative correction of a cut surface. Calculates the path of the next pass from the errors of
// the previous passes. Also calculates how much of these errors is repeatable. README.md has the
// equations (Eq. 4-7). SI.
#pragma once

#include <optional>
#include <vector>

#include "algo/form/map_figures.h"
#include "schema/base/result.h"
#include "schema/form/height_map.h"

namespace mdof::algo {

enum class CuttingGain {
  one,     // uses the error of the last pass (Eq. 5)
  mean,    // uses the mean error of all passes: random errors average out
  optimal  // like `mean`, times repeatable^2 / (repeatable^2 + random^2 / n) for n passes
};

struct CuttingPasses {
  SurfaceMap wanted;             // wanted heights z1; also the path of the first pass
  std::vector<SurfaceMap> cuts;  // heights measured after each pass, in the order of the passes
  bool repeated = false;  // True: all passes used the path of the first pass. False: each pass used
                          // the path that next_cut() calculated from the previous passes.
  CuttingGain gain = CuttingGain::one;
  // Side of the square over which a parabola smooths the correction (LocalParabola). Without
  // smoothing (0), the noise of single pixels is cut into the part. The side must be the same for
  // all passes.
  double smooth_m = 0;
  // RMS of the random error of one pass, if known. Required by `optimal`, except for two or more
  // repeated passes.
  std::optional<double> random_rms_m = std::nullopt;
};

struct CuttingResult {
  std::vector<MapFigures> error;  // actual - wanted of each pass
  // RMS of the repeatable share and of the random share of the error of one pass, relative to the
  // path of that pass. Only for two or more passes. The random share of the mean error is removed
  // from the repeatable share.
  std::optional<double> repeatable_rms_m, random_rms_m;
  // Expected RMS error of the next pass for each gain, from random errors only, without smoothing.
  std::optional<double> floor_gain_one_m, floor_mean_m, floor_optimal_m;
  std::optional<bool> converges;  // whether the passes reduce the error (README.md, "Passes")
  std::size_t pixels = 0;         // pixels that all maps have
  SurfaceMap next;                // path of the next pass, over the pixels of `wanted`
  std::optional<double> factor;   // factor on the mean error; only with `optimal`
  std::optional<double> left_by_smoothing_rms_m;  // RMS that the smoothing removed from the
                                                  // correction; only with smooth_m
};

// Errors:
//   the maps do not overlap
//   smooth_m is below two pixels
//   `optimal` without random_rms_m, if the passes are not repeated or there is only one pass
Result<CuttingResult> next_cut(const CuttingPasses& passes);

}  // namespace mdof::algo
