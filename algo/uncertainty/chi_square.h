// Tests whether the readings of more than five probes agree within their uncertainties.
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
  int freedom = 0;  // number of probes in use - 5; 0: no test is possible
  double chi_square = 0;
  bool explained() const;
};

// `covariance`: of the readings, m². `errors`: solution of the rigid model, with the origin of the
// carriage as reference point. χ² is calculated from the part of the readings that five errors
// cannot explain. The model is linearised at `travel_m` and `errors`.
Agreement agreement(const Solver& solver, double travel_m, const std::vector<double>& readings_m,
                    const Eigen::MatrixXd& covariance, const AxisErrors& errors);

// Sets the flag "residual" of points whose readings do not agree, and reports these points in one
// notice. The notice also names the most suspect probe, if one probe is clearly the most suspect.
// Without this probe the other readings agree, and the errors are closest to the errors of the
// unflagged points of the same target. The test includes the noise of each probe, a linearity of
// 1e-4 of the range of the probe (rectangular), and the uncertainties that the rig declares. Only
// for the rigid model, because the other models use five probes.
class Residuals {
 public:
  Residuals(const Solver& solver, const std::vector<double>& range_m, const Sides& sides = {});
  // `start_ns`: time of the first point of the run, where the drift begins. Keeps references to
  // `solver` and `rig`.
  Residuals(const Solver& solver, const std::vector<double>& range_m, const Rig& rig,
            std::int64_t start_ns);
  // Call this directly after a point is solved, while the reference point of its errors is still
  // the origin of the carriage.
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
  const Rig* rig_ = nullptr;  // null if the rig declares no uncertainty
  std::int64_t start_ns_ = 0;
};

}  // namespace mdof::algo
