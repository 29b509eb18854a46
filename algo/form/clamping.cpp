#include "algo/form/clamping.h"

#include <cmath>
#include <string>
#include <utility>

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
                     " are identical: the surface does not spring back after the release, so K "
                     "cannot be calculated");
  result.K = product / square;
  // With the two maps exchanged, clamping and plastic are exchanged and elastic has the other sign,
  // so K is -1 - K.
  if (!(result.K > -1))
    return bad_input(after.name + " and " + released.name + ": K is " + plain_number(result.K) +
                     ", but must be greater than -1: the part would be bent more after the release "
                     "than in the clamp. The maps AFTER (clamped) and RELEASED are probably "
                     "exchanged (K is then " +
                     plain_number(-1 - result.K) + "); check the order BEFORE AFTER RELEASED");
  SurfaceMap left = result.plastic;
  for (std::size_t k = 0; k < left.z_m.size(); ++k) left.z_m[k] -= result.K * result.elastic.z_m[k];
  result.K_unexplained_rms_m = figures_of(left).rms_m;
  return result;
}

bool springs_past(const ClampingParts& parts) {
  constexpr double kClearly = 0.5;
  return parts.K < 0 && parts.K_unexplained_rms_m &&
         *parts.K_unexplained_rms_m < kClearly * figures_of(parts.plastic).rms_m;
}

namespace {

SurfaceMap mirrored(const SurfaceMap& map, bool in_x, bool in_y) {
  SurfaceMap result = map;
  for (std::size_t j = 0; j < map.ny; ++j)
    for (std::size_t i = 0; i < map.nx; ++i)
      result.z_m[j * map.nx + i] = map.at(in_x ? map.nx - 1 - i : i, in_y ? map.ny - 1 - j : j);
  return result;
}

std::optional<MapFigures> difference_figures(const SurfaceMap& before, const SurfaceMap& after) {
  auto found = difference(before, after);
  if (!found) return std::nullopt;
  remove_plane(*found);
  return figures_of(*found);
}

}  // namespace

std::optional<MirroredMatch> mirrored_match(const SurfaceMap& before, const SurfaceMap& after) {
  constexpr double kCloser = 0.5, kLeastPixels = 0.9;
  const auto given = difference_figures(before, after);
  if (!given) return std::nullopt;
  MirroredMatch best{"", given->rms_m, kCloser * given->rms_m};
  const std::pair<bool, bool> ways[] = {{true, false}, {false, true}, {true, true}};
  for (const auto& [in_x, in_y] : ways) {
    const auto found = difference_figures(before, mirrored(after, in_x, in_y));
    if (!found || !(found->rms_m < best.mirrored_rms_m) ||
        static_cast<double>(found->pixels) < kLeastPixels * static_cast<double>(given->pixels))
      continue;
    best.mirrored = in_x && in_y ? "x, y" : in_x ? "x" : "y";
    best.mirrored_rms_m = found->rms_m;
  }
  if (best.mirrored.empty()) return std::nullopt;
  return best;
}

}  // namespace mdof::algo
