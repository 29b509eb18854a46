#include "algo/calibration/mounting.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

#include "algo/calibration/mounting_model.h"
#include "algo/calibration/mounting_view.h"
#include "algo/linear_algebra/least_squares.h"
#include "algo/linear_algebra/spectra.h"
#include "schema/base/number/number_text.h"
#include "schema/uncertainty/chi_square_limit.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr int kMaxIterations = 100;
// Only the first iterations select the seen combinations. Without this limit, a singular value near
// kSeenFactor could alternate between above and below kSeenFactor, and the iteration would not end.
constexpr int kChoosingSteps = 10;
constexpr double kLeastShare = 1e-3, kRounding = 1e-12;
// The iteration ends if the change of all unknowns, in units of scale(), is smaller. kDescentDone
// is used after kChoosingSteps. kDescentDone is larger, because chi-square must then decrease, and
// the rounding of chi-square limits the accuracy.
constexpr double kStepDone = 1e-7, kDescentDone = 1e-4;
constexpr double kRankTolerance = 1e-9;
// Limit of the root mean square of residual / u. If the declared noise is too small, the value
// stays below this limit. If an error affects all readings, the value can be above this limit;
// Birge's factor does not cover such an error.
constexpr double kMostMisfit = 20;
// Largest distance from the position in the rig; clamping by hand is more accurate.
constexpr double kFarthest_m = 1e-3;

// The column space of the derivatives by the unknowns of the clampings, with its least-squares
// solution.
struct PoseSpace {
  LeastSquares fit;
  Eigen::MatrixXd basis;

  explicit PoseSpace(const Eigen::MatrixXd& by_pose)
      : fit(by_pose, kRankTolerance), basis(fit.basis()) {}
  Eigen::MatrixXd without(const Eigen::MatrixXd& m) const {
    return m - basis * (basis.transpose() * m);
  }
};

MountingView view_of(const SingularValues& svd) {
  const Eigen::VectorXd& all = svd.values;
  const auto n = std::count_if(all.begin(), all.end(), [](double s) { return s >= kSeenFactor; });
  const Eigen::MatrixXd& v = svd.V;
  return {v.leftCols(n), v.rightCols(v.cols() - n), all.head(n)};
}

class Fit {
 public:
  explicit Fit(MountingModel model)
      : model_(std::move(model)),
        pose_(Eigen::VectorXd::Zero(model_.pose_unknowns())),
        probe_(Eigen::VectorXd::Zero(model_.unknowns())) {}

  Status run(double u_encoder_m) {
    MDOF_CHECK(settle([this] { return solve_poses(); }));
    model_.add_encoder_uncertainty(pose_, u_encoder_m);
    return settle([this] { return solve_all_unknowns(); });
  }
  MountingFit result(const Rig& rig, const std::vector<Clamping>& clampings) const;
  const MountingView& view() const { return view_; }
  Eigen::VectorXd change() const { return probe_.cwiseProduct(model_.scale()); }
  const MountingModel& model() const { return model_; }

 private:
  template <class Step>
  Status settle(Step step) {
    for (int i = 0; i < kMaxIterations; ++i) {
      const double size = step();
      if (!(pose_.cwiseAbs().maxCoeff() < 25)) break;  // 0.25 rad, the limit of the model
      if (size < (steps_ > kChoosingSteps ? kDescentDone : kStepDone)) return {};
    }
    return fail(
        ErrorCode::check,
        "no positions of the probes and no tilts of the target agree with these readings. Check "
        "that the target stays in the same clamping during a log, and that only one axis moves: "
        "the axis that is given with the log (Y for Y=FILE). Also check that the target moves in "
        "the direction that mdof calculates from the rig and the encoder",
        Remedy::reverse_target);
  }

  double solve_poses() {
    const auto lines = model_.linearised(pose_, probe_);
    const Eigen::VectorXd step = LeastSquares(lines.by_pose, kRankTolerance).solve(lines.misfit);
    pose_ += step;
    return step.cwiseAbs().maxCoeff();
  }

  // Calculates new values of all unknowns. The unknowns of the probes are solved completely, not as
  // a correction of their last values, and only in the combinations that are seen in this
  // iteration. Therefore a combination that was seen only in an earlier iteration has the value of
  // the rig again. After kChoosingSteps the seen combinations do not change. Returns the largest
  // change.
  double solve_all_unknowns() {
    const auto lines = model_.linearised(pose_, probe_);
    const PoseSpace poses(lines.by_pose);
    const Eigen::MatrixXd shown = poses.without(lines.by_probe);
    const Eigen::VectorXd goal = poses.without(lines.misfit) + shown * probe_;
    const bool choosing = steps_++ < kChoosingSteps || view_.singular.size() == 0;
    const SingularValues svd = singular_values(choosing ? shown : shown * view_.seen);
    if (choosing)
      view_ = view_of(svd);
    else
      view_ = {view_.seen * svd.V, view_.unseen, svd.values};
    const auto n = view_.singular.size();
    const Eigen::VectorXd now =
        view_.seen * (svd.U.leftCols(n).transpose() * goal).cwiseQuotient(view_.singular);
    const Eigen::VectorXd change = now - probe_;
    const Eigen::VectorXd step =
        poses.fit.solve(Eigen::VectorXd(lines.misfit - lines.by_probe * change));
    const double share = choosing ? 1 : descending_share(lines, step, change);
    probe_ += share * change;
    pose_ += share * step;
    pose_rank_ = poses.fit.rank();
    return std::max(change.cwiseAbs().maxCoeff(), step.cwiseAbs().maxCoeff());
  }

  // Returns the factor (at most 1) for the Gauss-Newton step. The readings contain the squares of
  // the angles between the probes and the target. If the noise is as large as these squares, the
  // full step can be too large. The factor is halved until chi-square decreases by at least half of
  // the predicted decrease (Armijo's rule).
  double descending_share(const MountingModel::Linearised& lines, const Eigen::VectorXd& step,
                          const Eigen::VectorXd& change) const {
    const double now = lines.misfit.squaredNorm();
    const double expected =
        now - (lines.misfit - lines.by_probe * change - lines.by_pose * step).squaredNorm();
    double share = 1;
    while (share > kLeastShare &&
           model_.linearised(pose_ + share * step, probe_ + share * change).misfit.squaredNorm() >
               now - share * expected / 2 + kRounding * now)
      share /= 2;
    return share;
  }

  void judge(MountingCalibration& found) const;
  void report_probe(const Rig& rig, std::size_t k, const Unseen& unseen,
                    const Eigen::MatrixXd& covariance, MountedProbe& out) const;
  double u_of(Eigen::Index unknown, const Unseen& unseen, const Eigen::MatrixXd& covariance) const;
  void report_covariance(const Rig& rig, const Unseen& unseen, const Eigen::MatrixXd& covariance,
                         MountingCalibration& found) const;

  MountingModel model_;
  Eigen::VectorXd pose_, probe_;
  MountingView view_;
  Eigen::Index pose_rank_ = 0;
  int steps_ = 0;  // number of solve_all_unknowns() calls
};

// Returns u of an unknown. The covariance gives u of the seen part, the rig gives u of the unseen
// part. NaN: the unknown is not seen, and the rig does not declare its u.
double Fit::u_of(Eigen::Index unknown, const Unseen& unseen,
                 const Eigen::MatrixXd& covariance) const {
  const double share = unseen.share(unknown), scale = model_.scale()(unknown);
  if (share > kUnseenShare && !model_.declared(unknown)) return std::nan("");
  return std::sqrt(covariance(unknown, unknown) + share * scale * scale);
}

void Fit::report_probe(const Rig& rig, std::size_t k, const Unseen& unseen,
                       const Eigen::MatrixXd& covariance, MountedProbe& out) const {
  const Eigen::VectorXd found = change();
  const auto seen = [&](MountingUnknown which) {
    return unseen.share(unknown_of(k, which)) <= kUnseenShare;
  };
  const auto axes = local_axes(rig.axis);
  const auto u = [&](MountingUnknown which) {
    return u_of(unknown_of(k, which), unseen, covariance);
  };
  const Eigen::Vector3d &e1 = model_.along(k, 0), &e2 = model_.along(k, 1);
  const Eigen::Vector3d moved =
      found(unknown_of(k, kPlace1)) * e1 + found(unknown_of(k, kPlace2)) * e2;
  const Eigen::Vector3d direction =
      model_.rotated_direction(k, found(unknown_of(k, kTowards1)), found(unknown_of(k, kTowards2)));
  out.id = rig.probes[k].id;
  out.position_seen = seen(kPlace1) && seen(kPlace2);
  out.direction_seen = seen(kTowards1) && seen(kTowards2);
  out.zero_seen = seen(kZero);
  const double cross = covariance(unknown_of(k, kPlace1), unknown_of(k, kPlace2));
  for (std::size_t m = 0; m < 3; ++m) {
    double shift = 0, turned = 0, part1 = 0, part2 = 0;
    for (std::size_t l = 0; l < 3; ++l) {
      const auto i = static_cast<Eigen::Index>(l);
      shift += axes[m][l] * moved(i);
      turned += axes[m][l] * direction(i);
      part1 += axes[m][l] * e1(i);
      part2 += axes[m][l] * e2(i);
    }
    out.position_m[m] = rig.probes[k].position_m[m] + shift;
    out.direction[m] = out.direction_seen ? turned : rig.probes[k].direction[m];
    const auto square = [](double part, double u_part) {
      return part == 0 ? 0 : part * part * u_part * u_part;
    };
    out.u_position_m[m] = std::sqrt(std::max(
        square(part1, u(kPlace1)) + square(part2, u(kPlace2)) + 2 * part1 * part2 * cross, 0.0));
    if (std::isnan(u(kPlace1)) && part1 != 0) out.u_position_m[m] = std::nan("");
    if (std::isnan(u(kPlace2)) && part2 != 0) out.u_position_m[m] = std::nan("");
  }
  const double u1 = u(kTowards1), u2 = u(kTowards2);
  out.u_direction_rad = std::isnan(u1) || std::isnan(u2) ? std::nan("") : std::max(u1, u2);
  out.zero_m = out.zero_seen ? found(unknown_of(k, kZero)) : 0;
  out.u_zero_m = out.zero_seen ? u(kZero) : std::nan("");
  out.scale_1 = found(unknown_of(k, kScale));
  out.u_scale_1 = u(kScale);
  out.readings = static_cast<std::size_t>(
      std::count_if(model_.readings().begin(), model_.readings().end(),
                    [&](const TraverseReading& reading) { return reading.probe == k; }));
}

// Sets the covariance of the positions, directions and zeros that are seen. Positions and
// directions have components along the axes of the machine. The diagonal is consistent with u_of().
void Fit::report_covariance(const Rig& rig, const Unseen& unseen, const Eigen::MatrixXd& covariance,
                            MountingCalibration& found) const {
  Eigen::MatrixXd all = covariance;
  for (Eigen::Index i = 0; i < all.rows(); ++i) {
    const double unseen_part = model_.scale()(i);
    all(i, i) += unseen.share(i) * unseen_part * unseen_part;
  }
  const auto axes = local_axes(rig.axis);
  std::vector<Eigen::VectorXd> rows;
  // Adds the component along machine axis m of a vector. The unknowns `first` and `first` + 1 are
  // the components of this vector along the local vectors `one` and `other`.
  const auto add_component = [&](const std::string& name, std::size_t m, Eigen::Index first,
                                 const Eigen::Vector3d& one, const Eigen::Vector3d& other) {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(all.rows());
    for (std::size_t l = 0; l < 3; ++l) {
      const auto i = static_cast<Eigen::Index>(l);
      row(first) += axes[m][l] * one(i);
      row(first + 1) += axes[m][l] * other(i);
    }
    if (row.norm() < kRankTolerance) return;  // perpendicular to both
    found.covariance.of.push_back(name);
    rows.push_back(std::move(row));
  };
  for (std::size_t k = 0; k < rig.probes.size(); ++k) {
    const MountedProbe& probe = found.probes[k];
    for (std::size_t m = 0; m < 3 && probe.position_seen; ++m)
      add_component(place_name(probe.id, m), m, unknown_of(k, kPlace1), model_.along(k, 0),
                    model_.along(k, 1));
    for (std::size_t m = 0; m < 3 && probe.direction_seen; ++m)
      add_component(direction_name(probe.id, m), m, unknown_of(k, kTowards1), model_.towards(k, 0),
                    model_.towards(k, 1));
    if (!probe.zero_seen) continue;
    found.covariance.of.push_back(zero_name(probe.id));
    rows.push_back(Eigen::VectorXd::Unit(all.rows(), unknown_of(k, kZero)));
  }
  found.covariance.m2.assign(rows.size(), std::vector<double>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j <= i; ++j)
      found.covariance.m2[i][j] = found.covariance.m2[j][i] = rows[i].dot(all * rows[j]);
}

// Calculates chi-square. If the uncertainties of the readings do not explain the residuals,
// result() multiplies the covariance by chi-square / freedom (Birge).
void Fit::judge(MountingCalibration& found) const {
  const auto lines = model_.linearised(pose_, probe_);
  found.readings = model_.readings().size();
  found.chi_square = lines.misfit.squaredNorm();
  found.freedom = static_cast<int>(lines.misfit.size() - pose_rank_ - view_.singular.size());
  found.explained = found.freedom <= 0 || found.chi_square <= chi_square_limit(found.freedom);
}

MountingFit Fit::result(const Rig& rig, const std::vector<Clamping>& clampings) const {
  MountingFit fit;
  judge(fit.found);
  const double widened =
      fit.found.explained ? 1 : fit.found.chi_square / static_cast<double>(fit.found.freedom);
  const Eigen::MatrixXd scaled =
      view_.seen * view_.singular.cwiseAbs2().cwiseInverse().asDiagonal() * view_.seen.transpose();
  const auto& s = model_.scale();
  fit.change = change();
  fit.covariance = widened * (s.asDiagonal() * scaled * s.asDiagonal());
  fit.seen = s.asDiagonal() * view_.projector() *
             s.unaryExpr([](double x) { return x > 0 ? 1 / x : 0; }).asDiagonal();
  const Unseen unseen = find_unseen(model_, view_);
  fit.found.not_seen = unseen.sentences;
  std::set<Axis> axes;
  for (const Clamping& clamping : clampings)
    for (const Traverse& traverse : clamping.traverses) axes.insert(traverse.axis);
  if (axes.size() > 1)
    fit.found.not_seen.emplace_back(
        "the squareness of the axes of the traverses. The calibration assumes that these axes are "
        "square. u does not contain an error of this squareness");
  fit.found.u_together_m = unseen.u_together_m;
  fit.found.clampings = clampings.size();
  fit.found.probes.resize(rig.probes.size());
  for (std::size_t k = 0; k < rig.probes.size(); ++k)
    report_probe(rig, k, unseen, fit.covariance, fit.found.probes[k]);
  report_covariance(rig, unseen, fit.covariance, fit.found);
  for (std::size_t i = 0; i < clampings.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Errors5 a = model_.clamping_angles(pose_, i), b = model_.clamping_angles(pose_, j);
      const Eigen::Vector3d apart(a[kEx] - b[kEx], a[kEy] - b[kEy], a[kEz] - b[kEz]);
      fit.found.tilt_rad = std::max(fit.found.tilt_rad, apart.norm());
    }
  return fit;
}

Status check_places(const Rig& rig, const MountingFit& fit) {
  for (std::size_t k = 0; k < rig.probes.size(); ++k) {
    const double x = fit.change(unknown_of(k, kPlace1)), y = fit.change(unknown_of(k, kPlace2));
    const double away_m = std::sqrt(x * x + y * y);
    if (away_m <= kFarthest_m) continue;
    return fail(ErrorCode::check,
                rig.source + ": according to the readings, probe \"" + rig.probes[k].id + "\" is " +
                    plain_number(to_mm(away_m), 3) + " mm away from its position_mm (limit " +
                    plain_number(to_mm(kFarthest_m), 3) +
                    " mm); check position_mm of this probe, check that no two probes are "
                    "exchanged, and check that the target moves in the direction that mdof "
                    "calculates from the rig and the encoder",
                Remedy::reverse_target);
  }
  return {};
}

Status check_misfit(const Rig& rig, const MountingCalibration& found) {
  if (found.explained) return {};
  const double misfit = std::sqrt(found.chi_square / found.freedom);
  if (misfit <= kMostMisfit) return {};
  return fail(ErrorCode::check,
              rig.source +
                  ": the readings do not fit any mounting of the probes: the RMS deviation of the "
                  "readings is " +
                  plain_number(misfit, 3) + " times their uncertainty (limit " +
                  plain_number(kMostMisfit) +
                  "). Calibrate the sensitivities of the probes first, or declare "
                  "u_sensitivity_ppm. Also check that the target is flat and did not move in its "
                  "clamp, and that the axes are straight",
              Remedy::calibrate_sensitivity);
}

Status check_seen(const MountingFit& fit, double u_reading_m) {
  const auto& probes = fit.found.probes;
  if (std::any_of(probes.begin(), probes.end(), [](const auto& p) { return p.position_seen; }))
    return {};
  return fail(ErrorCode::check,
              "these clampings do not determine the position of any probe. The tilts of the target "
              "differ by at most " +
                  plain_number(fit.found.tilt_rad * 1e3, 3) +
                  " mrad, and the standard uncertainty of a reading at a stop is " +
                  plain_number(to_um(u_reading_m) * 1e3, 3) +
                  " nm (median). Clamp the target at three or more tilts that differ by several "
                  "mrad about two axes. Or move the target farther along each axis, or make each "
                  "stop longer");
}

double median_u_m(const MountingModel& model) {
  std::vector<double> all;
  for (const TraverseReading& reading : model.readings()) all.push_back(reading.u_m);
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end());
  return *middle;
}

}  // namespace

Result<MountingFit> fit_mounting(const Rig& rig, const std::vector<Clamping>& clampings) {
  MDOF_TRY(MountingModel model, MountingModel::create(rig, clampings));
  if (model.readings().empty())
    return fail(ErrorCode::check,
                "no probe has a usable reading while the axis stands still; check the keys "
                "\"range_um\" and \"offset_um\" of the probes");
  Fit fit(std::move(model));
  MDOF_CHECK(fit.run(rig.uncertainty.encoder.u));
  MountingFit result = fit.result(rig, clampings);
  MDOF_CHECK(check_seen(result, median_u_m(fit.model())));
  MDOF_CHECK(check_places(rig, result));
  MDOF_CHECK(check_misfit(rig, result.found));
  return result;
}

}  // namespace mdof::algo
