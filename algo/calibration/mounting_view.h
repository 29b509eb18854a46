// Which combinations of a mounting's unknowns the logs show, and the names of the others.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "algo/calibration/mounting_model.h"

namespace mdof::algo {

// From the singular values of the derivatives, once the clampings' unknowns are eliminated.
struct MountingView {
  Eigen::MatrixXd seen, unseen;  // orthonormal columns, in units of MountingModel::scale()
  Eigen::VectorXd singular;      // of the seen ones

  Eigen::MatrixXd projector() const { return seen * seen.transpose(); }
};
// Seen: known by the logs at least this many times as well as before.
inline constexpr double kSeenFrom = 2;

struct Unseen {
  Eigen::MatrixXd apart;  // unseen but for the probes of a plane together, orthonormal columns
  Vec3 u_together_m{};    // machine axes; NaN: not declared
  std::vector<std::string> sentences;

  // Part of this unknown that is not seen, beside moving together; 0 to 1.
  double share(Eigen::Index unknown) const { return apart.row(unknown).squaredNorm(); }
};
inline constexpr double kUnseenShare = 0.05;  // from here an unknown is not seen

Unseen unseen_of(const MountingModel& model, const MountingView& view);

}  // namespace mdof::algo
