#include "algo/form/cutting.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "algo/form/local_parabola.h"
#include "algo/form/registration.h"
#include "schema/base/number/number_text.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr double kGrowth = 1.5;  // the last error may exceed the smallest error by this factor,
                                 // because random errors vary
constexpr double kLeastSmoothingShare =
    0.2;  // share of the square that must be measured; at a corner of the map a quarter is measured

// Actual - wanted of each pass, at the pixels that all passes have.
Result<std::vector<SurfaceMap>> errors_of(const CuttingPasses& passes) {
  std::vector<SurfaceMap> errors;
  for (const SurfaceMap& cut : passes.cuts) {
    MDOF_TRY(SurfaceMap error, difference(passes.wanted, cut));
    errors.push_back(std::move(error));
  }
  for (std::size_t k = 0; k < passes.wanted.z_m.size(); ++k)
    if (std::any_of(errors.begin(), errors.end(),
                    [k](const SurfaceMap& error) { return std::isnan(error.z_m[k]); }))
      for (SurfaceMap& error : errors) error.z_m[k] = SurfaceMap::kMissing;
  if (errors.front().measured() < 2)
    return bad_input(
        passes.wanted.name +
        ": has fewer than 2 pixels in common with the maps of the cuts; give all maps in the "
        "same coordinates");
  return errors;
}

// Smooths a map with LocalParabola. Keeps the height of a pixel whose square does not determine a
// parabola.
SurfaceMap smoothed(const SurfaceMap& map, double side_m) {
  if (side_m <= 0) return map;
  const LocalParabola square(map, side_m, kLeastSmoothingShare);
  SurfaceMap result = map;
  Parabola found;
  for (std::size_t j = 0; j < map.ny; ++j)
    for (std::size_t i = 0; i < map.nx; ++i)
      if (!std::isnan(map.at(i, j)) && square.at(i, j, found))
        result.z_m[j * map.nx + i] = found.z_m;
  return result;
}

// Error of each pass relative to the path of that pass (`left`), and the correction of the next
// path.
struct Shares {
  std::vector<SurfaceMap> left;
  SurfaceMap correction;  // next path = wanted - correction
  double factor = 1;      // factor on the mean error
  double left_by_smoothing_rms_m = 0;
};

// Standard deviation of one repeated pass about the mean of the passes, RMS over the pixels.
double spread_rms_m(const std::vector<SurfaceMap>& left, const SurfaceMap& mean) {
  double variance = 0;
  for (SurfaceMap off : left) {
    for (std::size_t k = 0; k < off.z_m.size(); ++k) off.z_m[k] -= mean.z_m[k];
    variance += std::pow(figures_of(off).rms_m, 2) / static_cast<double>(left.size() - 1);
  }
  return std::sqrt(variance);
}

// Multiplies the correction by 1 - (random_rms_m^2 / n) / rms^2, at least 0 (Wiener's filter with
// one factor). random_rms_m is the RMS of the random error of one pass, n the number of passes. The
// mean height is kept. Returns the factor.
double shrink(SurfaceMap& correction, double random_rms_m, std::size_t n) {
  const MapFigures figures = figures_of(correction);
  const double random = random_rms_m * random_rms_m / static_cast<double>(n);
  const double square = figures.rms_m * figures.rms_m;
  const double factor = square > random ? 1 - random / square : 0;
  for (double& z : correction.z_m) z = figures.mean_m + factor * (z - figures.mean_m);
  return factor;
}

Shares shares_of(std::vector<SurfaceMap> errors, const CuttingPasses& passes) {
  Shares shares;
  SurfaceMap found = errors.front();  // the correction before smoothing
  std::fill(found.z_m.begin(), found.z_m.end(), 0.0);
  shares.correction = found;
  for (std::size_t pass = 0; pass < errors.size(); ++pass) {
    SurfaceMap& error = errors[pass];
    const double part = passes.gain == CuttingGain::one ? 1 : 1 / static_cast<double>(pass + 1);
    for (std::size_t k = 0; k < error.z_m.size(); ++k) {
      // left = cut - path = error + (wanted - path)
      if (!passes.repeated) error.z_m[k] += shares.correction.z_m[k];
      found.z_m[k] += part * (error.z_m[k] - found.z_m[k]);
    }
    if (passes.repeated && pass + 1 < errors.size()) continue;
    shares.correction = smoothed(found, passes.smooth_m);
    if (passes.gain != CuttingGain::optimal) continue;
    const double random_m =
        passes.random_rms_m ? *passes.random_rms_m : spread_rms_m(errors, found);
    shares.factor = shrink(shares.correction, random_m, pass + 1);
  }
  for (std::size_t k = 0; k < found.z_m.size(); ++k) found.z_m[k] -= shares.correction.z_m[k];
  shares.left_by_smoothing_rms_m = figures_of(found).rms_m;
  shares.left = std::move(errors);
  return shares;
}

void split(std::vector<SurfaceMap>& left, CuttingResult& result) {
  const auto n = static_cast<double>(left.size());
  for (SurfaceMap& map : left) {
    const double mean = figures_of(map).mean_m;
    for (double& z : map.z_m) z -= mean;
  }
  double repeats = 0, varies = 0, pixels = 0;
  for (std::size_t k = 0; k < left.front().z_m.size(); ++k) {
    double mean = 0;
    for (const SurfaceMap& map : left) mean += map.z_m[k] / n;
    if (std::isnan(mean)) continue;
    pixels += 1;
    repeats += mean * mean;
    for (const SurfaceMap& map : left) varies += (map.z_m[k] - mean) * (map.z_m[k] - mean);
  }
  const double variance = varies / (n - 1) / pixels;
  const double random = std::sqrt(variance);
  result.random_rms_m = random;
  result.repeatable_rms_m = std::sqrt(std::max(0.0, repeats / pixels - variance / n));
  result.floor_gain_one_m = std::sqrt(2.0) * random;
  result.floor_mean_m = random * std::sqrt(1 + 1 / n);
  if (result.factor) result.floor_optimal_m = random * std::sqrt(1 + *result.factor / n);
}

// For repeated passes, true if the RMS error of the passes is 0, or if the expected error of the
// next pass is smaller than this RMS error. For other passes, true if the last error is 0, or if
// the last error is smaller than the first error and at most kGrowth times the smallest error after
// the first pass.
bool is_converging(const CuttingPasses& passes, const CuttingResult& result) {
  const std::vector<MapFigures>& error = result.error;
  if (passes.repeated) {
    double square = 0;
    for (const MapFigures& pass : error)
      square += pass.rms_m * pass.rms_m / static_cast<double>(error.size());
    const double floor = passes.gain == CuttingGain::one    ? *result.floor_gain_one_m
                         : passes.gain == CuttingGain::mean ? *result.floor_mean_m
                                                            : *result.floor_optimal_m;
    return floor < std::sqrt(square) || square == 0;
  }
  if (error.back().rms_m == 0) return true;  // the last pass has no error
  double least = error[1].rms_m;
  for (std::size_t k = 1; k < error.size(); ++k) least = std::min(least, error[k].rms_m);
  return error.back().rms_m < error.front().rms_m && error.back().rms_m <= kGrowth * least;
}

}  // namespace

Result<CuttingResult> next_cut(const CuttingPasses& passes) {
  CuttingResult result;
  if (passes.smooth_m > 0 && !LocalParabola(passes.wanted, passes.smooth_m, 1).is_large_enough())
    return fail(
        ErrorCode::usage,
        "the smoothing length of " + plain_number(to_mm(passes.smooth_m)) +
            " mm is less than two pixels (one pixel: " + plain_number(to_mm(passes.wanted.dx_m)) +
            " x " + plain_number(to_mm(passes.wanted.dy_m)) +
            " mm); give a larger length, or 0 for no smoothing");
  if (passes.gain == CuttingGain::optimal && !passes.random_rms_m &&
      (!passes.repeated || passes.cuts.size() < 2))
    return fail(ErrorCode::usage,
                "the RMS of the random error of a pass is unknown, but the optimal gain depends on "
                "it; give this RMS, or give two or more passes with the same path");
  MDOF_TRY(std::vector<SurfaceMap> errors, errors_of(passes));
  for (const SurfaceMap& error : errors) result.error.push_back(figures_of(error));
  result.pixels = result.error.front().pixels;
  Shares shares = shares_of(std::move(errors), passes);
  if (passes.gain == CuttingGain::optimal) result.factor = shares.factor;
  if (passes.smooth_m > 0) result.left_by_smoothing_rms_m = shares.left_by_smoothing_rms_m;
  result.next = empty_like(passes.wanted);
  for (std::size_t k = 0; k < result.next.z_m.size(); ++k)
    result.next.z_m[k] = passes.wanted.z_m[k] - shares.correction.z_m[k];
  if (passes.cuts.size() < 2) return result;
  split(shares.left, result);
  result.converges = is_converging(passes, result);
  return result;
}

}  // namespace mdof::algo
