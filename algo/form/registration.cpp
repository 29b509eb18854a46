#include "algo/form/registration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "algo/form/evidence/shape_evidence.h"
#include "algo/form/map_figures.h"
#include "algo/form/surface.h"
#include "algo/linear_algebra/least_squares.h"
#include "algo/linear_algebra/spectra.h"
#include "schema/base/number/number_text.h"
#include "schema/base/random.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr std::size_t kForSearch = 1500, kForCourse = 50'000, kForFit = 1'000'000;  // pixels
constexpr double kLeastOverlap = 0.1;                                               // of A's pixels
constexpr double kSearchOverlap = 0.6;  // of a start that was searched for
constexpr double kSearchShift = 0.2;    // of the size of A, to each side
constexpr int kSearchSteps = 10;        // to each side
constexpr double kSearchTurn_deg = 2;   // a step; five to each side
// All other turns, by fewer pixels and larger steps; the best of them are fitted.
constexpr std::size_t kForTurns = 400;
constexpr int kTurnSteps = 4;  // of the shift, to each side
constexpr double kTurnStep_deg = 5;
constexpr std::size_t kTurnsFitted = 6;
constexpr double kUndetermined = 1e-7;   // share of the slopes that no plane explains
constexpr double kAlike = 1e-6;          // share of A's mean square: no search is needed
constexpr double kFitted_pixels = 1e-4;  // the last step

struct Turn {
  double cos = 1, sin = 0;
  explicit Turn(double rad)
      : cos(sine_of_turns(rad / (2 * std::numbers::pi) + 0.25)),
        sin(sine_of_turns(rad / (2 * std::numbers::pi))) {}
};

// Some of A's measured pixels about the middle of them.
struct Places {
  double x_mid_m = 0, y_mid_m = 0, size_m = 0;  // size: the larger side
  std::vector<double> x_m, y_m, z_m;
};

Places places_of(const SurfaceMap& a, std::size_t most) {
  Places places;
  const std::size_t measured = a.measured(), every = std::max<std::size_t>(1, measured / most);
  std::size_t least_i = a.nx, most_i = 0, least_j = a.ny, most_j = 0, k = 0;
  // A step that has no common factor with the rows, or whole columns would be left out.
  std::uint64_t mixed = 0;
  for (std::size_t j = 0; j < a.ny; ++j)
    for (std::size_t i = 0; i < a.nx; ++i) {
      const double z = a.at(i, j);
      if (std::isnan(z)) continue;
      least_i = std::min(least_i, i);
      most_i = std::max(most_i, i);
      least_j = std::min(least_j, j);
      most_j = std::max(most_j, j);
      mixed = k++ * 0x9e3779b97f4a7c15u;
      if (every > 1 && (mixed >> 33) % every != 0) continue;
      places.x_m.push_back(a.x_m(i));
      places.y_m.push_back(a.y_m(j));
      places.z_m.push_back(z);
    }
  if (measured == 0) return places;
  places.x_mid_m = (a.x_m(least_i) + a.x_m(most_i)) / 2;
  places.y_mid_m = (a.y_m(least_j) + a.y_m(most_j)) / 2;
  places.size_m = std::max(static_cast<double>(most_i - least_i + 1) * a.dx_m,
                           static_cast<double>(most_j - least_j + 1) * a.dy_m);
  for (double& x : places.x_m) x -= places.x_mid_m;
  for (double& y : places.y_m) y -= places.y_mid_m;
  return places;
}

// Sums over the places for the unknowns: piston, tilt x, tilt y (times size), shift x, shift y,
// turn (times size).
struct Sums {
  static constexpr int kUnknowns = 6;
  std::array<std::array<double, kUnknowns>, kUnknowns> A{};
  std::array<double, kUnknowns> b{};
  double squares = 0, count = 0;
};

// About the middle of A: q = R p + shift.
Sums sums_at(const Places& a, const Surface& b, const MapPose& about_middle, bool with_plane_only) {
  Sums sums;
  const Turn turn(about_middle.turn_rad);
  const double scale = 1 / a.size_m;
  const int n = with_plane_only ? 3 : Sums::kUnknowns;
  for (std::size_t k = 0; k < a.z_m.size(); ++k) {
    const double x = turn.cos * a.x_m[k] - turn.sin * a.y_m[k],
                 y = turn.sin * a.x_m[k] + turn.cos * a.y_m[k];
    SurfacePoint at;
    if (!b.at(x + a.x_mid_m + about_middle.shift_x_m, y + a.y_mid_m + about_middle.shift_y_m, 0,
              at))
      continue;
    const double r = at.z_m - a.z_m[k];
    const std::array<double, Sums::kUnknowns> slope = {{1, a.x_m[k] * scale, a.y_m[k] * scale,
                                                        at.slope_x, at.slope_y,
                                                        (at.slope_y * x - at.slope_x * y) * scale}};
    for (int i = 0; i < n; ++i) {
      const auto u = static_cast<std::size_t>(i);
      for (std::size_t v = u; v < static_cast<std::size_t>(n); ++v)
        sums.A[u][v] += slope[u] * slope[v];
      sums.b[u] += slope[u] * r;
    }
    sums.squares += r * r;
    sums.count += 1;
  }
  for (std::size_t u = 0; u < Sums::kUnknowns; ++u)
    for (std::size_t v = 0; v < u; ++v) sums.A[u][v] = sums.A[v][u];
  return sums;
}

struct Step {
  double mean_square = 0;          // of the residual, without its best plane
  std::array<double, 3> change{};  // shift x, y, turn times size
  std::size_t undetermined = 0;
};

Step step_of(const Sums& sums, bool with_plane_only) {
  Step step;
  Eigen::MatrixXd P(3, 3), C(3, 3), M(3, 3);
  Eigen::VectorXd p(3), m(3);
  for (int u = 0; u < 3; ++u) {
    p(u) = sums.b[static_cast<std::size_t>(u)];
    m(u) = sums.b[static_cast<std::size_t>(u) + 3];
    for (int v = 0; v < 3; ++v) {
      const auto a = static_cast<std::size_t>(u), b = static_cast<std::size_t>(v);
      P(u, v) = sums.A[a][b];
      C(u, v) = sums.A[a][b + 3];
      M(u, v) = sums.A[a + 3][b + 3];
    }
  }
  const LeastNorm plane(P, 1e-12);
  const Eigen::VectorXd fitted = plane.solve(p);
  step.mean_square = std::max(0.0, sums.squares - p.dot(fitted)) / std::max(1.0, sums.count);
  if (with_plane_only) return step;
  const Eigen::MatrixXd left = M - C.transpose() * plane.solve(C);
  const Eigen::VectorXd right = m - C.transpose() * fitted;
  // Each unknown in its own scale, so that directions can be compared by their eigenvalues.
  Eigen::VectorXd scale(3);
  const double least = kUndetermined * kUndetermined * M.trace();  // below it, rounding
  for (int u = 0; u < 3; ++u) scale(u) = M(u, u) > least ? 1 / std::sqrt(M(u, u)) : 0;
  const SingularValues found = singular_values(scale.asDiagonal() * left * scale.asDiagonal());
  Eigen::VectorXd change = Eigen::VectorXd::Zero(3);
  for (int k = 0; k < 3; ++k) {
    if (!(found.values(k) > kUndetermined)) {
      ++step.undetermined;
      continue;
    }
    const double along = found.U.col(k).dot(scale.cwiseProduct(right)) / found.values(k);
    change -= along * scale.cwiseProduct(found.V.col(k));
  }
  step.change = {{change(0), change(1), change(2)}};
  return step;
}

struct Fit {
  MapPose pose;  // about the middle
  double mean_square = 0, overlap = 0;
  std::size_t undetermined = 0;
};

Fit fitted_from(const Places& a, const Surface& b, MapPose pose, double pixel_m, int most) {
  Fit fit;
  const auto all = static_cast<double>(a.z_m.size());
  Sums sums = sums_at(a, b, pose, false);
  Step step = step_of(sums, false);
  for (int k = 0; k < most; ++k) {
    double part = 1;
    bool is_better = false;
    const double size =
        std::abs(step.change[0]) + std::abs(step.change[1]) + std::abs(step.change[2]);
    for (int halved = 0; halved < 6 && !is_better; ++halved, part /= 2) {
      MapPose next = pose;
      next.shift_x_m += part * step.change[0];
      next.shift_y_m += part * step.change[1];
      next.turn_rad += part * step.change[2] / a.size_m;
      const Sums at_next = sums_at(a, b, next, false);
      const Step after = step_of(at_next, false);
      is_better = at_next.count >= kLeastOverlap * all && after.mean_square < step.mean_square;
      if (!is_better && size * part < kFitted_pixels * pixel_m) break;
      if (!is_better) continue;
      pose = next;
      step = after;
      sums = at_next;
    }
    if (!is_better || size < kFitted_pixels * pixel_m) break;
  }
  fit.pose = pose;
  fit.mean_square = step.mean_square;
  fit.overlap = sums.count / all;
  fit.undetermined = step.undetermined;
  return fit;
}

// The best of starts over shifts and turns, by a few pixels.
MapPose searched(const Places& a, const Surface& b) {
  MapPose best;
  double least = -1;
  const auto all = static_cast<double>(a.z_m.size());
  const double step_m = kSearchShift * a.size_m / kSearchSteps;
  for (int turn = -5; turn <= 5; ++turn)
    for (int j = -kSearchSteps; j <= kSearchSteps; ++j)
      for (int i = -kSearchSteps; i <= kSearchSteps; ++i) {
        const MapPose pose{i * step_m, j * step_m, turn * kSearchTurn_deg * std::numbers::pi / 180};
        const Sums sums = sums_at(a, b, pose, true);
        if (sums.count < kSearchOverlap * all) continue;
        const double mean_square = step_of(sums, true).mean_square;
        if (least >= 0 && mean_square >= least) continue;
        least = mean_square;
        best = pose;
      }
  return best;
}

// The best shift of each turn beyond those of searched(), the best turn first: a part that was laid
// into the machine the other way round.
std::vector<MapPose> turned_starts(const Places& a, const Surface& b) {
  std::vector<std::pair<double, MapPose>> starts;
  const auto all = static_cast<double>(a.z_m.size());
  const double step_m = kSearchShift * a.size_m / kTurnSteps;
  for (double turn_deg = 15; turn_deg < 350; turn_deg += kTurnStep_deg) {
    std::pair<double, MapPose> best{-1, {}};
    for (int j = -kTurnSteps; j <= kTurnSteps; ++j)
      for (int i = -kTurnSteps; i <= kTurnSteps; ++i) {
        const MapPose pose{i * step_m, j * step_m, turn_deg * std::numbers::pi / 180};
        const Sums sums = sums_at(a, b, pose, true);
        if (sums.count < kSearchOverlap * all) continue;
        const double mean_square = step_of(sums, true).mean_square;
        if (best.first < 0 || mean_square < best.first) best = {mean_square, pose};
      }
    if (best.first >= 0) starts.push_back(best);
  }
  std::stable_sort(starts.begin(), starts.end(),
                   [](const auto& x, const auto& y) { return x.first < y.first; });
  std::vector<MapPose> poses;
  for (const auto& [mean_square, pose] : starts)
    if (poses.size() < kTurnsFitted) poses.push_back(pose);
  return poses;
}

MapPose about_origin(const MapPose& about_middle, const Places& a) {
  const Turn turn(about_middle.turn_rad);
  MapPose pose = about_middle;
  pose.shift_x_m += a.x_mid_m - (turn.cos * a.x_mid_m - turn.sin * a.y_mid_m);
  pose.shift_y_m += a.y_mid_m - (turn.sin * a.x_mid_m + turn.cos * a.y_mid_m);
  return pose;
}

Fit registered(const SurfaceMap& a, const Surface& b, double pixel_m, const Places& places) {
  SurfaceMap flat = a;
  remove_plane(flat);
  const Places few = places_of(flat, kForSearch);
  Fit fit = fitted_from(few, b, {}, pixel_m, 30);
  double own = 0;  // mean square of A
  for (const double z : few.z_m) own += z * z / static_cast<double>(few.z_m.size());
  // A start elsewhere has to be much better: the form of both may differ.
  if (fit.overlap < kSearchOverlap || fit.mean_square > kAlike * own) {
    const auto take = [&](const MapPose& start) {
      const Fit other = fitted_from(few, b, start, pixel_m, 30);
      if (other.overlap >= kSearchOverlap &&
          (fit.overlap < kSearchOverlap || 4 * other.mean_square < fit.mean_square))
        fit = other;
    };
    take(searched(few, b));
    if (fit.overlap < kSearchOverlap || fit.mean_square > kAlike * own)
      for (const MapPose& start : turned_starts(places_of(flat, kForTurns), b)) take(start);
  }
  if (places.z_m.size() > kForCourse)
    fit = fitted_from(places_of(a, kForCourse), b, fit.pose, pixel_m, 20);
  return fitted_from(places, b, fit.pose, pixel_m, 6);
}

SurfaceMap difference_at(const SurfaceMap& a, const Surface& b, const MapPose& pose) {
  SurfaceMap difference = empty_like(a);
  const Turn turn(pose.turn_rad);
  for (std::size_t j = 0; j < a.ny; ++j)
    for (std::size_t i = 0; i < a.nx; ++i) {
      const double z = a.at(i, j), x = a.x_m(i), y = a.y_m(j);
      SurfacePoint at;
      if (std::isnan(z) || !b.at(turn.cos * x - turn.sin * y + pose.shift_x_m,
                                 turn.sin * x + turn.cos * y + pose.shift_y_m, 0, at))
        continue;
      difference.z_m[j * a.nx + i] = at.z_m - z;
    }
  return difference;
}

std::string extent(const SurfaceMap& map) {
  const auto mm = [](double x_m) { return plain_number(to_mm(x_m), 6); };
  return "x " + mm(map.x0_m) + " to " + mm(map.x_m(map.nx - 1)) + " mm, y " + mm(map.y0_m) +
         " to " + mm(map.y_m(map.ny - 1)) + " mm";
}

Status check_overlap(const SurfaceMap& a, const SurfaceMap& b, std::size_t pixels) {
  const std::size_t measured = a.measured();
  if (pixels > 1 && static_cast<double>(pixels) >= kLeastOverlap * static_cast<double>(measured))
    return {};
  return bad_input(
      a.name + " and " + b.name + ": only " + std::to_string(pixels) + " of " +
      std::to_string(measured) +
      " pixels of the first map have a counterpart in the second map (the first map covers " +
      extent(a) + ", the second map covers " + extent(b) +
      "); give both maps in the same coordinates");
}

}  // namespace

Result<SurfaceMap> difference(const SurfaceMap& a, const SurfaceMap& b) {
  SurfaceMap found = difference_at(a, Surface(b, 0, Extension::parabola), {});
  MDOF_CHECK(check_overlap(a, b, found.measured()));
  return found;
}

Result<Comparison> compare(const SurfaceMap& a, const SurfaceMap& b, Register how) {
  Comparison result;
  const Surface surface(b, 0, Extension::parabola);
  if (how == Register::rigid) {
    const double pixel_m = std::min(std::min(a.dx_m, a.dy_m), std::min(b.dx_m, b.dy_m));
    const Places places = places_of(a, kForFit);
    const Fit fit = registered(a, surface, pixel_m, places);
    result.pose = about_origin(fit.pose, places);
    result.undetermined = fit.undetermined;
    result.by_noise =
        std::max(directions_without_shape(a, surface, result.pose), fit.undetermined) -
        fit.undetermined;
  }
  result.difference = difference_at(a, surface, result.pose);
  MDOF_CHECK(check_overlap(a, b, result.difference.measured()));
  if (how != Register::none) remove_plane(result.difference);
  const MapFigures figures = figures_of(result.difference);
  result.pv_m = figures.pv_m;
  result.rms_m = figures.rms_m;
  result.pixels = figures.pixels;
  return result;
}

}  // namespace mdof::algo
