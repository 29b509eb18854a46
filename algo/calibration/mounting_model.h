// The unknowns of a mounting, and the model of the readings.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "algo/calibration/mounting.h"
#include "algo/model/fixture.h"

namespace mdof::algo {

enum MountingUnknown { kPlace1, kPlace2, kZero, kTowards1, kTowards2, kScale };
inline Eigen::Index unknown_of(std::size_t probe, MountingUnknown which) {
  return static_cast<Eigen::Index>(probe) * kMountingUnknowns + which;
}

// One reading that is used.
struct TraverseReading {
  std::size_t clamping, traverse;  // traverse: number of the traverse, counted over all clampings
  std::size_t probe;
  Eigen::Vector3d axis_direction_M;  // unit vector of the axis, local frame
  double travel_m;
  double reading_m, u_m;

  Eigen::Vector3d travel_M() const { return travel_m * axis_direction_M; }
};

class MountingModel {
 public:
  static Result<MountingModel> create(const Rig& rig, const std::vector<Clamping>& clampings);

  const Fixture& nominal() const { return nominal_; }
  const std::vector<TraverseReading>& readings() const { return readings_; }
  std::size_t probes() const { return nominal_.probes.size(); }
  Eigen::Index unknowns() const;  // number of unknowns of the probes
  // Number of unknowns of the poses: three angles of each clamping, δy and δz of each traverse.
  Eigen::Index pose_unknowns() const;

  // Local frame. along(): two unit vectors in the plane of the target that the probe measures.
  // towards(): two unit vectors perpendicular to the direction of the probe.
  const Eigen::Vector3d& along(std::size_t probe, std::size_t which) const;
  const Eigen::Vector3d& towards(std::size_t probe, std::size_t which) const;
  Eigen::Vector3d rotated_direction(std::size_t probe, double towards1, double towards2) const;

  // Prior standard uncertainty of each unknown, see declared(); 0: the unknown is exact.
  const Eigen::VectorXd& scale() const { return scale_; }
  // True: the rig declares the prior uncertainty. False: the prior uncertainty is a typical value
  // for clamping by hand.
  bool declared(Eigen::Index unknown) const;

  // misfit: residual (reading - model) divided by u, for each reading. by_pose, by_probe:
  // derivatives of (model reading / u) by the unknowns of the poses and of the probes. Unit of the
  // angles of a pose: 0.01 rad, so that the columns are comparable. Unit of the unknowns of the
  // probes: scale().
  struct Linearised {
    Eigen::VectorXd misfit;
    Eigen::MatrixXd by_pose, by_probe;
  };
  Linearised linearised(const Eigen::VectorXd& pose, const Eigen::VectorXd& probe) const;

  // Adds the effect of the encoder's uncertainty on the readings of a tilted target to u of the
  // readings.
  void add_encoder_uncertainty(const Eigen::VectorXd& pose, double u_encoder_m);
  Errors5 clamping_angles(const Eigen::VectorXd& pose, std::size_t clamping) const;

 private:
  void take(const std::vector<Clamping>& clampings);
  void set_scales(const Rig& rig);
  Errors5 pose_of(const Eigen::VectorXd& pose, const TraverseReading& at) const;
  FixtureProbe mounted(const Eigen::VectorXd& probe, std::size_t k) const;

  Fixture nominal_;
  std::vector<std::array<Eigen::Vector3d, 2>> along_, towards_;  // [probe]
  std::vector<TraverseReading> readings_;
  std::size_t clampings_ = 0, traverses_ = 0;
  Eigen::VectorXd scale_;
  std::vector<bool> declared_;
};

}  // namespace mdof::algo
