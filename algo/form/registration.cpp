#include "algo/form/registration.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "algo/form/evidence/shape_evidence.h"
#include "algo/form/map_figures.h"
#include "algo/form/pose/places.h"
#include "algo/form/pose/pose_fit.h"
#include "algo/form/surface.h"
#include "schema/base/number/number_text.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr std::size_t kForSearch = 1500, kForCourse = 50'000,
                      kForFit = 250'000;  // numbers of pixels
// Smallest share of the pixels of A that have a counterpart in B.
constexpr double kLeastOverlap = 0.1;
constexpr double kSearchShift = 0.2;  // largest shift, relative to the size of A, in each direction
constexpr int kSearchSteps = 10;  // number of shifts from 0 to the largest shift, in each direction
constexpr double kSearchTurn_deg = 2;  // step of the turn; five steps in each direction
// The search over all other turns uses fewer pixels and larger steps. It fits only the best poses.
constexpr std::size_t kForTurns = 400;
constexpr int kTurnSteps = 4;  // number of shifts from 0 to the largest shift, in each direction
constexpr double kTurnStep_deg = 5;
constexpr std::size_t kTurnsFitted = 6;
// Relative to the mean absolute height of A. If the residual is smaller, there is no search.
constexpr double kAlike = 5e-3;
// Relative to the mean absolute height of A. A larger residual of one place is replaced by this
// limit.
constexpr double kPlaceResidualLimit = 4;
// The residual at a pose that the search finds must be less than this factor times the residual at
// the pose found before, and less than this factor times the mean absolute height of A.
constexpr double kAcceptedResidualRatio = 0.5;

// The pose with the smallest residual in a grid of shifts, relative to `centre`, and turns.
MapPose searched(const Places& a, const Surface& b, const MapPose& centre) {
  MapPose best;
  double least = -1;
  const double step_m = kSearchShift * a.size_m / kSearchSteps;
  for (int turn = -5; turn <= 5; ++turn)
    for (int j = -kSearchSteps; j <= kSearchSteps; ++j)
      for (int i = -kSearchSteps; i <= kSearchSteps; ++i) {
        const MapPose pose{centre.shift_x_m + i * step_m, centre.shift_y_m + j * step_m,
                           turn * kSearchTurn_deg * std::numbers::pi / 180};
        const double mean_square = mean_square_at(a, b, pose, kRegistrationOverlap);
        if (mean_square < 0 || (least >= 0 && mean_square >= least)) continue;
        least = mean_square;
        best = pose;
      }
  return best;
}

// The best shifts of the best turns outside the grid of searched(), the best turn first. These
// turns occur if the part was measured in another orientation.
std::vector<MapPose> turned_starts(const Places& a, const Surface& b, const MapPose& centre) {
  std::vector<std::pair<double, MapPose>> starts;
  const double step_m = kSearchShift * a.size_m / kTurnSteps;
  for (double turn_deg = 15; turn_deg < 350; turn_deg += kTurnStep_deg) {
    std::pair<double, MapPose> best{-1, {}};
    for (int j = -kTurnSteps; j <= kTurnSteps; ++j)
      for (int i = -kTurnSteps; i <= kTurnSteps; ++i) {
        const MapPose pose{centre.shift_x_m + i * step_m, centre.shift_y_m + j * step_m,
                           turn_deg * std::numbers::pi / 180};
        const double mean_square = mean_square_at(a, b, pose, kRegistrationOverlap);
        if (mean_square < 0) continue;
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

// Finds the pose of B relative to A. Inside this class, all poses are about the middle of A.
class Registration {
 public:
  Registration(const SurfaceMap& a, const SurfaceMap& b, const Surface& surface)
      : b_map_(b),
        b_(surface),
        pixel_m_(std::min(std::min(a.dx_m, a.dy_m), std::min(b.dx_m, b.dy_m))),
        flat_(without_plane(a)),
        search_places_(places_of(flat_, kForSearch)),
        fit_places_(places_of(flat_, kForCourse)),
        evidence_(a, search_places_) {
    own_.left_m = search_places_.z_m;
    double sum_m = 0;
    for (const double z : search_places_.z_m) sum_m += std::abs(z);
    most_m_ = kPlaceResidualLimit * sum_m / static_cast<double>(search_places_.z_m.size());
  }

  MapPose found() {
    MapPose pose = fitted_at_rest();
    PoseFit fit = plane_fit_at_pose(search_places_, b_, pose);
    if (search(fit))
      pose =
          fitted_from(fit_places_, b_, fit.pose, evidence_.determined(b_, fit.pose), pixel_m_, 20)
              .pose;
    Eigen::MatrixXd directions = evidence_.determined(b_, pose);
    if (directions.cols() > 0 && flat_.measured() > fit_places_.z_m.size()) {
      pose = fitted_from(places_of(flat_, kForFit), b_, pose, directions, pixel_m_, 6).pose;
      directions = evidence_.determined(b_, pose);
    }
    undetermined_ = 3 - static_cast<std::size_t>(directions.cols());
    const PoseFit moved = plane_fit_at_pose(search_places_, b_, pose),
                  at_rest = plane_fit_at_pose(search_places_, b_, {});
    const double before_m = left(at_rest, common(at_rest, moved)).size_m;
    if (overlap(at_rest) < kRegistrationOverlap)
      residual_ratio_ = 0;
    else if (before_m > 0)
      residual_ratio_ = left(moved, common(moved, at_rest)).size_m / before_m;
    moved_m_ =
        std::hypot(pose.shift_x_m, pose.shift_y_m) +
        std::abs(std::remainder(pose.turn_rad, 2 * std::numbers::pi)) * search_places_.size_m / 2;
    return about_origin(pose, search_places_);
  }
  std::size_t undetermined() const { return undetermined_; }
  double residual_ratio() const { return residual_ratio_; }
  double moved_m() const { return moved_m_; }

 private:
  static SurfaceMap without_plane(SurfaceMap map) {
    remove_plane(map);
    return map;
  }

  // Fits from shift and turn 0, in the directions that the shape determines there. If the shape
  // determines fewer directions at the fitted pose, the fit starts again from shift and turn 0 in
  // the fewer directions. If the shape determines more directions there, the fit continues from the
  // fitted pose in these directions, unless it was started again.
  MapPose fitted_at_rest() const {
    MapPose pose;
    Eigen::MatrixXd directions = evidence_.determined(b_, pose);
    bool has_restarted = false;
    for (int again = 0; again < 5 && directions.cols() > 0; ++again) {
      pose = fitted_from(fit_places_, b_, pose, directions, pixel_m_, 20).pose;
      const Eigen::MatrixXd now = evidence_.determined(b_, pose);
      if (now.cols() == directions.cols() || (has_restarted && now.cols() > directions.cols()))
        break;
      if (now.cols() < directions.cols()) {
        has_restarted = true;
        pose = {};
      }
      directions = now;
    }
    return pose;
  }

  PoseFit fitted_at_search_places(const MapPose& start, const Eigen::MatrixXd& directions) const {
    return fitted_from(search_places_, b_, start, directions, pixel_m_, 30);
  }
  // Fits from another start. If the shape does not determine a direction at the fitted pose, the
  // movement in this direction is set to 0 and the fit is repeated.
  PoseFit fitted_from_other_start(const MapPose& start) const {
    PoseFit fit = fitted_at_search_places(start, Eigen::MatrixXd::Identity(3, 3));
    const Eigen::MatrixXd directions = evidence_.determined(b_, fit.pose);
    if (directions.cols() == 3) return fit;
    const double turn = std::remainder(fit.pose.turn_rad, 2 * std::numbers::pi);
    const Eigen::Vector3d at(fit.pose.shift_x_m, fit.pose.shift_y_m, turn * search_places_.size_m);
    const Eigen::Vector3d held = directions * (directions.transpose() * at);
    return fitted_at_search_places({held(0), held(1), held(2) / search_places_.size_m}, directions);
  }

  double overlap(const PoseFit& fit) const {
    return fit.count / static_cast<double>(search_places_.z_m.size());
  }
  bool is_measured(double x_m, double y_m) const {
    const double i = std::nearbyint((x_m + search_places_.x_mid_m - flat_.x0_m) / flat_.dx_m),
                 j = std::nearbyint((y_m + search_places_.y_mid_m - flat_.y0_m) / flat_.dy_m);
    return i >= 0 && j >= 0 && i < static_cast<double>(flat_.nx) &&
           j < static_cast<double>(flat_.ny) &&
           !std::isnan(flat_.at(static_cast<std::size_t>(i), static_cast<std::size_t>(j)));
  }
  // Returns for each place whether two conditions are true: the place has a counterpart in B in
  // both poses, and its counterpart in pose `fit` is the counterpart of a measured place of A in
  // pose `other`. Without the second condition, a difference at the border of B would be ignored.
  std::vector<bool> common(const PoseFit& fit, const PoseFit& other) const {
    std::vector<bool> counts(fit.left_m.size());
    const Turn here(fit.pose.turn_rad), back(-other.pose.turn_rad);
    for (std::size_t k = 0; k < counts.size(); ++k) {
      const double x = here.x_m(search_places_.x_m[k], search_places_.y_m[k]) + fit.pose.shift_x_m -
                       other.pose.shift_x_m,
                   y = here.y_m(search_places_.x_m[k], search_places_.y_m[k]) + fit.pose.shift_y_m -
                       other.pose.shift_y_m;
      counts[k] = !std::isnan(fit.left_m[k]) && !std::isnan(other.left_m[k]) &&
                  is_measured(back.x_m(x, y), back.y_m(x, y));
    }
    return counts;
  }
  std::vector<bool> measured(const PoseFit& fit) const {
    std::vector<bool> counts(fit.left_m.size());
    for (std::size_t k = 0; k < counts.size(); ++k) counts[k] = !std::isnan(fit.left_m[k]);
    return counts;
  }

  MeanLeft left(const PoseFit& fit, const std::vector<bool>& counts) const {
    return mean_left(fit, counts, most_m_);
  }

  // The forms of A and B may differ. Therefore the residual must be much smaller, also over the
  // places that are common to both poses.
  bool is_much_better(const PoseFit& other, const PoseFit& fit) const {
    if (overlap(other) < kRegistrationOverlap) return false;
    const std::vector<bool> counts = measured(other);
    if (!(left(other, counts).size_m < kAcceptedResidualRatio * left(own_, counts).size_m))
      return false;
    const MeanLeft there = left(other, common(other, fit)), here = left(fit, common(fit, other));
    if (std::min(there.share, here.share) < kLeastOverlap)
      return overlap(fit) < kRegistrationOverlap;
    return there.size_m < kAcceptedResidualRatio * here.size_m;
  }
  bool is_found(const PoseFit& fit) const {
    const std::vector<bool> counts = measured(fit);
    return overlap(fit) >= kRegistrationOverlap &&
           left(fit, counts).size_m <= kAlike * left(own_, counts).size_m;
  }

  // Searches other poses. Returns true, with the best pose in `fit`, if another pose is much
  // better.
  bool search(PoseFit& fit) const {
    if (is_found(fit) || !evidence_.has_shape()) return false;
    bool has_better_pose = false;
    const auto take = [&](const MapPose& start) {
      PoseFit other = fitted_from_other_start(start);
      if (!is_much_better(other, fit)) return;
      fit = std::move(other);
      has_better_pose = true;
    };
    std::vector<MapPose> centres(1);
    if (overlap(fit) > 0 && overlap(fit) < kRegistrationOverlap)
      centres.push_back(with_common_middle());
    for (const MapPose& centre : centres)
      if (!is_found(fit)) take(centre);
    for (const MapPose& centre : centres)
      if (!is_found(fit)) take(searched(search_places_, b_, centre));
    for (const MapPose& centre : centres)
      if (!is_found(fit))
        for (const MapPose& start : turned_starts(places_of(flat_, kForTurns), b_, centre))
          take(start);
    return has_better_pose;
  }
  // The pose in which the middles of both maps coincide. The origins of maps may be at the middle
  // or at a corner of the part.
  MapPose with_common_middle() const {
    const Places b = places_of(b_map_, 1);
    return {b.x_mid_m - search_places_.x_mid_m, b.y_mid_m - search_places_.y_mid_m, 0};
  }

  const SurfaceMap& b_map_;
  const Surface& b_;
  double pixel_m_;
  SurfaceMap flat_;
  Places search_places_, fit_places_;
  ShapeEvidence evidence_;
  PoseFit own_;  // the heights of A at `search_places_`, as a residual
  double most_m_ = 0;
  std::size_t undetermined_ = 0;
  double residual_ratio_ = 1, moved_m_ = 0;
};

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
    Registration registration(a, b, surface);
    result.pose = registration.found();
    result.undetermined = registration.undetermined();
    result.residual_ratio = registration.residual_ratio();
    result.moved_m = registration.moved_m();
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
