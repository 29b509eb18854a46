// Calculates the five errors and their covariance from the probe readings of one instant or one
// dwell, with any of the three models.
#pragma once

#include <optional>
#include <vector>

#include "algo/model/fixture.h"
#include "algo/model/small_angle/small_angle.h"
#include "algo/model/visibility.h"
#include "schema/point.h"
#include "schema/rig/rig.h"

namespace mdof::algo {

class Solver {
 public:
  // Errors: the probes of the rig do not determine all five errors (the message states the errors
  // that are not determined); for a small-angle model, the errors of make_small_angle_fixture().
  static Result<Solver> create(const Rig& rig, Model model);

  // `readings_m`: displacement at each probe in the order of the rig; NaN for a lost probe. `u_m`:
  // standard uncertainty of each reading; empty or 0 if unknown (then the covariance is 0). If the
  // probes that are not lost do not determine all five errors, the errors are not solved and the
  // reason is set.
  AxisErrors solve(double travel_m, const std::vector<double>& readings_m,
                   const std::vector<double>& u_m) const;

  // As solve(), but without the covariance, in a quarter of the time.
  AxisErrors solve_without_covariance(double travel_m, const std::vector<double>& readings_m,
                                      const std::vector<double>& u_m) const;

  // Returns the change of the local errors (reference point: the origin of the carriage) per 1 m of
  // each probe's reading: 5 x probes, 0 for a lost probe. This is the weighted pseudo-inverse of
  // the Jacobian (first order, GUM 5.1.3). The Jacobian is calculated at `errors` for the rigid
  // model. For the small-angle models the Jacobian is calculated at zero errors, which is accurate
  // to 1e-3.
  Eigen::MatrixXd gain(double travel_m, const AxisErrors& errors,
                       const std::vector<double>& readings_m, const std::vector<double>& u_m) const;

  Model model() const { return model_; }
  const Fixture& fixture() const { return fixture_; }
  const Visibility& seen() const { return seen_; }
  // Only set for the small-angle models; used for solve_batch().
  const std::optional<SmallAngleFixture>& small_angle() const { return small_angle_; }

 private:
  Solver() = default;
  Covariance5 covariance(double travel_m, const AxisErrors& errors, const std::vector<bool>& use,
                         const std::vector<double>& weights, const std::vector<double>& u_m) const;
  Eigen::MatrixXd gain(double travel_m, const AxisErrors& errors,
                       const std::vector<double>& weights) const;

  Model model_ = Model::exact;
  Fixture fixture_;
  Visibility seen_;
  std::optional<SmallAngleFixture> small_angle_;
};

}  // namespace mdof::algo
