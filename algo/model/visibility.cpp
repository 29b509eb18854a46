#include "algo/model/visibility.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "algo/linear_algebra/spectra.h"

namespace mdof::algo {
namespace {

// Angles are scaled with an arm of 10 mm, so that the columns of the Jacobian are comparable.
constexpr double kAngleScale_m = 0.01;
constexpr double kTravel_m = 0.0173;  // travel for the rank; a probe at this position is unlikely
constexpr double kRankTolerance = 1e-6;
// Smallest coefficient of an error that counts as part of an undetermined combination.
constexpr double kNamedShare = 1e-3;

}  // namespace

Eigen::MatrixXd first_order_jacobian(const Fixture& fixture, double travel_m,
                                     const std::vector<bool>& use) {
  const auto rows = std::count(use.begin(), use.end(), true);
  Eigen::MatrixXd J(rows, kErrorCount);
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < fixture.probes.size(); ++i) {
    if (!use[i]) continue;
    const auto& probe = fixture.probes[i];
    // s = (offset - n·(p - t)) / (n·u) with n = R n_C: ∂s/∂t = n/(n·u); to first order
    // ∂s/∂ε · ω = -(ω × n)·(p - t)/(n·u) = ω · ((p - t) × n)/(n·u)
    const double across = probe.n_C.dot(probe.u_M);
    const Eigen::Vector3d arm = probe.p_MP - Eigen::Vector3d(travel_m, 0, 0);
    const Eigen::Vector3d by_angle = arm.cross(probe.n_C) / across;
    J.row(row) << probe.n_C.y() / across, probe.n_C.z() / across, by_angle.x(), by_angle.y(),
        by_angle.z();
    ++row;
  }
  return J;
}

Visibility visibility(const Fixture& fixture, const std::vector<bool>& use) {
  // The rank is the same at any travel. An undetermined angle is listed together with the
  // straightness error that this angle causes by its lever arm.
  Eigen::MatrixXd J = first_order_jacobian(fixture, kTravel_m, use);
  J.rightCols(3) /= kAngleScale_m;
  Visibility result;
  if (J.rows() == 0) {
    for (const auto& name : error_names(fixture.axis)) result.unseen.emplace_back(name.name);
    return result;
  }
  const SingularValues svd = singular_values(J);
  const auto& singular = svd.values;
  Errors5 share{};
  for (Eigen::Index k = 0; k < kErrorCount; ++k) {
    const bool seen = k < singular.size() && singular(k) > kRankTolerance * singular(0);
    if (seen) {
      ++result.rank;
      result.condition = singular(0) / singular(k);
      continue;
    }
    for (std::size_t e = 0; e < share.size(); ++e) {
      share[e] = std::max(share[e], std::abs(svd.V(static_cast<Eigen::Index>(e), k)));
    }
  }
  for (const auto& name : error_names(fixture.axis)) {
    if (share[name.local] > kNamedShare) result.unseen.emplace_back(name.name);
  }
  return result;
}

std::string describe_unseen(const Fixture& fixture, const std::vector<bool>& use,
                            const Visibility& seen) {
  if (std::none_of(use.begin(), use.end(), [](bool used) { return used; }))
    return "no probe has a usable reading; five probes are needed";
  std::string text = "probes";
  for (std::size_t i = 0; i < fixture.probes.size(); ++i) {
    if (use[i]) text += " " + fixture.probes[i].id;
  }
  text += seen.unseen.size() == 1 ? " cannot measure " : " cannot separate ";
  for (std::size_t i = 0; i < seen.unseen.size(); ++i) {
    if (i > 0) text += i + 1 == seen.unseen.size() ? " and " : ", ";
    text += seen.unseen[i];
  }
  return text + " (their readings determine " + std::to_string(seen.rank) +
         " of 5 unknowns); five probes are needed: three on one plane, not in a line, and two on a "
         "second plane, at different positions along the motion";
}

}  // namespace mdof::algo
