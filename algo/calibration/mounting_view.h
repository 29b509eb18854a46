// Combinations of the unknowns of a mounting that the logs determine, and sentences about the
// combinations that they do not determine.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "algo/calibration/mounting_model.h"

namespace mdof::algo {

// The combinations are the singular vectors of the derivatives, after the unknowns of the clampings
// are eliminated.
struct MountingView {
  Eigen::MatrixXd seen, unseen;  // orthonormal columns, in units of MountingModel::scale()
  Eigen::VectorXd singular;      // singular values of the columns of `seen`

  Eigen::MatrixXd projector() const { return seen * seen.transpose(); }
};
// A combination is in `seen` if its standard uncertainty from the logs is at most 1/kSeenFactor of
// the prior uncertainty of the rig.
inline constexpr double kSeenFactor = 2;

struct Unseen {
  // Orthonormal basis of the unseen combinations that remain after two kinds are removed: a common
  // shift, and a common change of zero, of all probes that measure the same plane.
  Eigen::MatrixXd apart;
  Vec3 u_together_m{};  // u of the common shift along each machine axis; NaN: the rig does not
                        // declare this u
  std::vector<std::string> sentences;

  // Share of this unknown that the logs do not determine, without common shifts and zeros; 0 to 1.
  double share(Eigen::Index unknown) const { return apart.row(unknown).squaredNorm(); }
};
// An unknown with a larger share is reported as not determined.
inline constexpr double kUnseenShare = 0.05;

Unseen find_unseen(const MountingModel& model, const MountingView& view);

}  // namespace mdof::algo
