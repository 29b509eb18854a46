#include "algo/form/clamping.h"

#include <cmath>
#include <string>

#include "algo/form/map_figures.h"
#include "algo/form/registration.h"
#include "schema/base/number/number_text.h"

namespace mdof::algo {
namespace {

SurfaceMap scaled(const SurfaceMap& map, double factor) {
  SurfaceMap result = map;
  for (double& z : result.z_m) z *= factor;
  return result;
}

// Sets the pixels of `map` that are missing in `other` to missing.
void keep_common(SurfaceMap& map, const SurfaceMap& other) {
  for (std::size_t k = 0; k < map.z_m.size(); ++k)
    if (std::isnan(other.z_m[k])) map.z_m[k] = SurfaceMap::kMissing;
}

// Three pixels determine piston and tilt, so no deformation remains.
Status check_common(const SurfaceMap& common, const std::string& maps) {
  if (common.measured() >= 4) return {};
  return bad_input(maps +
                   " have fewer than 4 pixels in common; give all maps in the same coordinates");
}

}  // namespace

Result<ClampingParts> clamping_by_K(const SurfaceMap& before, const SurfaceMap& after, double K) {
  if (!(K > -1 && std::isfinite(K)))
    return fail(ErrorCode::usage, "K is " + plain_number(K) +
                                      "; K must be greater than -1, because the elastic "
                                      "deformation is the clamping deformation divided by 1 + K");
  ClampingParts result;
  MDOF_TRY(result.clamping, difference(before, after));
  MDOF_CHECK(check_common(result.clamping, before.name + " and " + after.name));
  remove_plane(result.clamping);
  result.K = K;
  result.elastic = scaled(result.clamping, 1 / (1 + K));
  result.plastic = scaled(result.elastic, K);
  return result;
}

Result<ClampingParts> clamping_by_release(const SurfaceMap& before, const SurfaceMap& after,
                                          const SurfaceMap& released) {
  ClampingParts result;
  MDOF_TRY(result.clamping, difference(before, after));
  MDOF_TRY(result.plastic, difference(before, released));
  keep_common(result.clamping, result.plastic);
  keep_common(result.plastic, result.clamping);
  MDOF_CHECK(
      check_common(result.clamping, before.name + ", " + after.name + " and " + released.name));
  remove_plane(result.clamping);
  remove_plane(result.plastic);
  result.elastic = result.clamping;
  double square = 0, product = 0;
  for (std::size_t k = 0; k < result.elastic.z_m.size(); ++k) {
    result.elastic.z_m[k] -= result.plastic.z_m[k];
    if (std::isnan(result.elastic.z_m[k])) continue;
    square += result.elastic.z_m[k] * result.elastic.z_m[k];
    product += result.elastic.z_m[k] * result.plastic.z_m[k];
  }
  if (!(square > 0))
    return bad_input(after.name + " and " + released.name +
                     " are identical, so there is no springback and K cannot be calculated");
  result.K = product / square;
  SurfaceMap left = result.plastic;
  for (std::size_t k = 0; k < left.z_m.size(); ++k) left.z_m[k] -= result.K * result.elastic.z_m[k];
  result.K_unexplained_rms_m = figures_of(left).rms_m;
  return result;
}

}  // namespace mdof::algo
