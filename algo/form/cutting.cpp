#include "algo/form/cutting.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "algo/form/registration.h"

namespace mdof::algo {
namespace {

constexpr double kGrowth = 1.5;  // of an error that varies at its floor

// Actual - wanted of each pass, over the pixels that all have.
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
        ": the cuts have no pixel in common with it; give all in the same coordinates");
  return errors;
}

// What each pass left against its own path, and the correction of the next path.
struct Shares {
  std::vector<SurfaceMap> left;
  SurfaceMap correction;  // the next path is wanted - correction
};

Shares shares_of(std::vector<SurfaceMap> errors, bool repeated, CuttingGain gain) {
  Shares shares;
  SurfaceMap& correction = shares.correction;
  correction = errors.front();
  std::fill(correction.z_m.begin(), correction.z_m.end(), 0.0);
  for (std::size_t pass = 0; pass < errors.size(); ++pass) {
    SurfaceMap& error = errors[pass];
    const double part = gain == CuttingGain::one ? 1 : 1 / static_cast<double>(pass + 1);
    for (std::size_t k = 0; k < error.z_m.size(); ++k) {
      double& c = correction.z_m[k];
      // left = cut - path = error + (wanted - path)
      if (!repeated) error.z_m[k] += c;
      c += part * (error.z_m[k] - c);
    }
  }
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
}

// Repeated: whether the next pass will be better than those. Else: whether the passes became so.
bool is_converging(const CuttingPasses& passes, const CuttingResult& result) {
  const std::vector<MapFigures>& error = result.error;
  if (passes.repeated) {
    double square = 0;
    for (const MapFigures& pass : error)
      square += pass.rms_m * pass.rms_m / static_cast<double>(error.size());
    const double floor =
        passes.gain == CuttingGain::one ? *result.floor_gain_one_m : *result.floor_mean_m;
    return floor < std::sqrt(square);
  }
  double least = error[1].rms_m;
  for (std::size_t k = 1; k < error.size(); ++k) least = std::min(least, error[k].rms_m);
  return error.back().rms_m < error.front().rms_m && error.back().rms_m <= kGrowth * least;
}

}  // namespace

Result<CuttingResult> next_cut(const CuttingPasses& passes) {
  CuttingResult result;
  MDOF_TRY(std::vector<SurfaceMap> errors, errors_of(passes));
  for (const SurfaceMap& error : errors) result.error.push_back(figures_of(error));
  result.pixels = result.error.front().pixels;
  Shares shares = shares_of(std::move(errors), passes.repeated, passes.gain);
  result.next = empty_like(passes.wanted);
  for (std::size_t k = 0; k < result.next.z_m.size(); ++k)
    result.next.z_m[k] = passes.wanted.z_m[k] - shares.correction.z_m[k];
  if (passes.cuts.size() < 2) return result;
  split(shares.left, result);
  result.converges = is_converging(passes, result);
  return result;
}

}  // namespace mdof::algo
