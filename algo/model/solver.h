// Calculates five errors with covariance from the readings of one instant or dwell, with any of the
// three models.
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
  // Error: the probes of the rig do not determine all five errors (the error names those they do
  // not determine); or, for a small-angle model, the fixture is not of the paper's kind.
  static Result<Solver> create(const Rig& rig, Model model);

  // `readings_m`: displacement of each probe in the order of the rig, NaN if it is lost. `u_m`:
  // standard uncertainty of each, empty or 0 if unknown (then the covariance is 0). With a lost
  // probe the errors are not solved, and the reason is set, unless the others determine all five.
  AxisErrors solve(double travel_m, const std::vector<double>& readings_m,
                   const std::vector<double>& u_m) const;

  // The same without the covariance, in a quarter of the time.
  AxisErrors solve_without_covariance(double travel_m, const std::vector<double>& readings_m,
                                      const std::vector<double>& u_m) const;

  // Change of the local errors, stated at the carriage, per 1 m of each probe's reading: 5 x
  // probes, 0 for a lost probe. First order (GUM 5.1.3): the weighted pseudo-inverse of the
  // Jacobian, at `errors` for the rigid model and at zero error for the small-angle models, which
  // is accurate to 1e-3.
  Eigen::MatrixXd gain(double travel_m, const AxisErrors& errors,
                       const std::vector<double>& readings_m, const std::vector<double>& u_m) const;

  Model model() const { return model_; }
  const Fixture& fixture() const { return fixture_; }
  const Visibility& seen() const { return seen_; }
  // Set for the small-angle models: for solve_batch().
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
