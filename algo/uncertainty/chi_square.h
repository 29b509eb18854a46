// Do more probes than five agree with each other as well as their uncertainties say?
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "algo/model/solver.h"
#include "schema/notice/notice.h"
#include "schema/point.h"
#include "schema/rig/rig.h"
#include "schema/uncertainty/chi_square_limit.h"

namespace mdof::algo {

struct Agreement {
  int freedom = 0;        // probes in use - 5; 0: nothing to test
  double chi_square = 0;  // sum of (what the model leaves / u)²
  bool explained() const;
};

// `u_m` of each reading, not 0; `errors` as the rigid model has solved them, those of the carriage.
Agreement agreement(const Solver& solver, double travel_m, const std::vector<double>& readings_m,
                    const std::vector<double>& u_m, const AxisErrors& errors);

// The same with a covariance of the readings, m², which may tie probes together: χ² of what of the
// readings no five errors could explain. `travel_m` and `errors` are where the model is made
// linear.
Agreement agreement(const Solver& solver, double travel_m, const std::vector<double>& readings_m,
                    const Eigen::MatrixXd& covariance, const AxisErrors& errors);

// Flags the points whose residual is not explained ("residual") and says so in one sentence that
// names the most suspect probe: the one without which χ² is least or, where six probes leave
// nothing to test without one, without which the errors come nearest to those of the other points
// of the target. Beside its noise each probe is allowed a linearity of 1e-4 of its range
// (rectangular), and all of them what the rig declares not to know. Only for the rigid model: the
// others use five probes.
class Residuals {
 public:
  Residuals(const Solver& solver, const std::vector<double>& range_m, const Sides& sides = {});
  // `start_ns`: of the run's first point, from which its drift counts. Keeps references.
  Residuals(const Solver& solver, const std::vector<double>& range_m, const Rig& rig,
            std::int64_t start_ns);
  // Right after a point was solved, its errors still those of the carriage.
  void test(MeasuredPoint& point) const;
  std::optional<Notice> contradiction(const std::vector<MeasuredPoint>& points) const;

 private:
  bool explained(const MeasuredPoint& point, const std::vector<double>& readings_m,
                 const AxisErrors& errors) const;
  std::vector<double> allowed(const std::vector<double>& u_m) const;
  std::optional<std::size_t> suspect(const std::vector<const MeasuredPoint*>& bad,
                                     const std::vector<MeasuredPoint>& all) const;
  double misfit_without(std::size_t probe, const MeasuredPoint& point,
                        const std::vector<MeasuredPoint>& all) const;

  const Solver& solver_;
  Sides sides_;
  std::vector<double> linearity_m_;
  const Rig* rig_ = nullptr;  // that declares something
  std::int64_t start_ns_ = 0;
};

}  // namespace mdof::algo
