// Tests whether more than five probes agree with each other within their uncertainties.
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
  double chi_square = 0;  // sum of (residual / u)²
  bool explained() const;
};

// `u_m`: standard uncertainty of each reading, not 0; `errors`: solution of the rigid model, stated
// at the carriage.
Agreement agreement(const Solver& solver, double travel_m, const std::vector<double>& readings_m,
                    const std::vector<double>& u_m, const AxisErrors& errors);

// The same with a covariance of the readings, m², which may correlate probes. χ² is that of the
// part of the readings that no set of five errors explains. The model is linearised at `travel_m`
// and `errors`.
Agreement agreement(const Solver& solver, double travel_m, const std::vector<double>& readings_m,
                    const Eigen::MatrixXd& covariance, const AxisErrors& errors);

// Flags the points whose residual is not explained ("residual") and reports them in one notice that
// names the most suspect probe. Without this probe the other readings agree, and the errors are
// closest to those of the unflagged points of the same target. The test allows for the noise of
// each probe, for a linearity of 1e-4 of its range (rectangular), and for the uncertainties that
// the rig declares. Only for the rigid model: the other models use five probes.
class Residuals {
 public:
  Residuals(const Solver& solver, const std::vector<double>& range_m, const Sides& sides = {});
  // `start_ns`: time of the run's first point, where its drift begins. Keeps references.
  Residuals(const Solver& solver, const std::vector<double>& range_m, const Rig& rig,
            std::int64_t start_ns);
  // Call this right after a point is solved, while its errors are still those of the carriage.
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
  const Rig* rig_ = nullptr;  // only if it declares an uncertainty
  std::int64_t start_ns_ = 0;
};

}  // namespace mdof::algo
