// Which combinations of a mounting's unknowns the logs determine, and sentences about the others.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "algo/calibration/mounting_model.h"

namespace mdof::algo {

// From the singular values of the derivatives, after the unknowns of the clampings are eliminated.
struct MountingView {
  Eigen::MatrixXd seen, unseen;  // orthonormal columns, in units of MountingModel::scale()
  Eigen::VectorXd singular;      // singular values of the columns of `seen`

  Eigen::MatrixXd projector() const { return seen * seen.transpose(); }
};
// A combination is seen if the logs determine it at least this many times as well as the rig.
inline constexpr double kSeenFactor = 2;

struct Unseen {
  // Unseen, without common shifts of the probes of a plane; orthonormal columns.
  Eigen::MatrixXd apart;
  Vec3 u_together_m{};  // common shift, machine axes; NaN: not declared
  std::vector<std::string> sentences;

  // Share of this unknown that is not seen, without common shifts; 0 to 1.
  double share(Eigen::Index unknown) const { return apart.row(unknown).squaredNorm(); }
};
inline constexpr double kUnseenShare = 0.05;  // an unknown with a larger share is not seen

Unseen find_unseen(const MountingModel& model, const MountingView& view);

}  // namespace mdof::algo
