#include "algo/calibration/mounting_view.h"

#include <algorithm>
#include <cmath>

#include "algo/linear_algebra/spectra.h"
#include "schema/base/number/number_text.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

// A combination is undetermined if at least this share of its square is in MountingView::unseen.
constexpr double kEntirelyUnseen = 0.99;
constexpr double kSamePlane = 1e-9;  // 1 - cosine
// A combination is added only if its part that is orthogonal to the others has at least this
// length.
constexpr double kIndependent = 0.1;

// Indices of the probes that measure the same plane of the target.
using Group = std::vector<std::size_t>;

std::vector<Group> groups_of(const Fixture& fixture) {
  std::vector<Group> groups;
  for (std::size_t k = 0; k < fixture.probes.size(); ++k) {
    bool placed = false;
    for (Group& group : groups) {
      const double same = fixture.probes[group[0]].n_C.dot(fixture.probes[k].n_C);
      if (placed || std::abs(same) < 1 - kSamePlane) continue;
      group.push_back(k);
      placed = true;
    }
    if (!placed) groups.push_back({k});
  }
  return groups;
}

std::string ids_of(const MountingModel& model, const Group& group) {
  std::string ids;
  for (const std::size_t k : group) ids += (ids.empty() ? "" : ", ") + model.nominal().probes[k].id;
  return ids;
}

// Converts a local vector to machine axes.
Vec3 machine(const MountingModel& model, const Eigen::Vector3d& local) {
  const auto axes = local_axes(model.nominal().axis);
  Vec3 v{};
  for (std::size_t m = 0; m < 3; ++m)
    for (std::size_t l = 0; l < 3; ++l) v[m] += axes[m][l] * local(static_cast<Eigen::Index>(l));
  return v;
}

std::size_t largest(const Vec3& v) {
  std::size_t at = 0;
  for (std::size_t m = 1; m < 3; ++m)
    if (std::abs(v[m]) > std::abs(v[at])) at = m;
  return at;
}

class UnseenReporter {
 public:
  UnseenReporter(const MountingModel& model, const MountingView& view)
      : model_(model), view_(view) {
    together_ = Eigen::MatrixXd(model.unknowns(), 0);
    for (const Group& group : groups_of(model.nominal())) {
      for (std::size_t j = 0; j < 2; ++j) add_common_shift(group, j);
      add_common_zero(group);
    }
    find_other_unseen();
    for (std::size_t k = 0; k < model.probes(); ++k) single(k);
  }
  Unseen take() { return std::move(out_); }

 private:
  // Returns true if the combination `v` (m, rad, 1) is unseen, and then adds it to together_. Sets
  // `length` to the length of `v` in units of scale().
  bool is_unseen(const Eigen::VectorXd& v, double& length) {
    Eigen::VectorXd scaled = v;
    for (Eigen::Index i = 0; i < v.size(); ++i)
      scaled(i) = v(i) == 0 ? 0 : v(i) / model_.scale()(i);
    length = scaled.norm();
    scaled /= length;
    if ((view_.unseen.transpose() * scaled).squaredNorm() < kEntirelyUnseen) return false;
    scaled -= together_ * (together_.transpose() * scaled);
    if (scaled.norm() < kIndependent) return true;
    together_.conservativeResize(Eigen::NoChange, together_.cols() + 1);
    together_.col(together_.cols() - 1) = scaled.normalized();
    return true;
  }

  void add_common_shift(const Group& group, std::size_t which) {
    const Eigen::Vector3d way = model_.along(group[0], which);
    Eigen::VectorXd shift = Eigen::VectorXd::Zero(model_.unknowns());
    bool declared = true;
    for (const std::size_t k : group) {
      shift(unknown_of(k, kPlace1)) = way.dot(model_.along(k, 0));
      shift(unknown_of(k, kPlace2)) = way.dot(model_.along(k, 1));
      declared = declared && model_.declared(unknown_of(k, which == 0 ? kPlace1 : kPlace2));
    }
    double length = 0;
    if (!is_unseen(shift, length)) return;
    const std::size_t axis = largest(machine(model_, way));
    const double u_m = declared ? 1 / length : std::nan("");
    double& u_axis = out_.u_together_m[axis];
    u_axis = std::isnan(u_m) || std::isnan(u_axis) ? std::nan("") : std::max(u_axis, u_m);
    out_.sentences.push_back("the common position of " + ids_of(model_, group) + " along " +
                             std::string(1, "XYZ"[axis]) +
                             ", because each clamping also shifts the target. The calibration does "
                             "not change the mean of position_mm of these probes in the rig; " +
                             (declared
                                  ? "the u of this mean is " + plain_number(to_um(u_m), 3) + " um"
                                  : "the rig does not declare the u of this mean (u_position_mm)"));
  }

  void add_common_zero(const Group& group) {
    Eigen::VectorXd zero = Eigen::VectorXd::Zero(model_.unknowns());
    for (const std::size_t k : group) {
      const FixtureProbe& p = model_.nominal().probes[k];
      const FixtureProbe& first = model_.nominal().probes[group[0]];
      zero(unknown_of(k, kZero)) = (p.n_C.dot(first.n_C) > 0 ? 1 : -1) / p.n_C.dot(p.u_M);
    }
    double length = 0;
    if (is_unseen(zero, length))
      out_.sentences.push_back(
          "the common zero offset of " + ids_of(model_, group) +
          ". The calibration does not change the mean of offset_um of these probes in the rig");
  }

  void find_other_unseen() {
    // The length of each remaining combination is about 1 or about 0, within the tolerance of
    // kEntirelyUnseen.
    const Eigen::MatrixXd left =
        view_.unseen - together_ * (together_.transpose() * view_.unseen).eval();
    const SingularValues svd = singular_values(left);
    const auto& length = svd.values;
    const auto n = std::count_if(length.begin(), length.end(), [](double x) { return x > 0.5; });
    out_.apart = svd.U.leftCols(n);
  }

  bool unseen(Eigen::Index unknown) const {
    return model_.scale()(unknown) > 0 && out_.share(unknown) > kUnseenShare;
  }

  void single(std::size_t k) {
    const std::string& id = model_.nominal().probes[k].id;
    for (std::size_t j = 0; j < 2; ++j)
      if (unseen(unknown_of(k, j == 0 ? kPlace1 : kPlace2)))
        out_.sentences.push_back(
            "the position of " + id + " along " +
            std::string(1, "XYZ"[largest(machine(model_, model_.along(k, j)))]) +
            " relative to the other probes. To determine the position, clamp the target at more "
            "tilts, with larger differences between the tilts");
    if (unseen(unknown_of(k, kZero)))
      out_.sentences.push_back("the zero offset of " + id + " relative to the other probes");
    if (unseen(unknown_of(k, kTowards1)) || unseen(unknown_of(k, kTowards2)))
      out_.sentences.push_back(
          "the direction of " + id +
          ", because the tilts of the target and the readings of the probe are too small");
    if (unseen(unknown_of(k, kScale)))
      out_.sentences.push_back("the sensitivity of " + id +
                               ", because a calibration of the mounting does not determine it; "
                               "calibrate the sensitivity separately");
  }

  const MountingModel& model_;
  const MountingView& view_;
  Eigen::MatrixXd together_;
  Unseen out_;
};

}  // namespace

Unseen find_unseen(const MountingModel& model, const MountingView& view) {
  return UnseenReporter(model, view).take();
}

}  // namespace mdof::algo
