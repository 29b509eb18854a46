#include "daemon/measure/forward_model.h"

#include <Eigen/Core>

#include "algo/model/fixture.h"
#include "algo/model/rigid.h"

namespace mdof::daemon {

Result<drivers::ForwardModel> forward_model(const Rig& rig) {
  MDOF_TRY(const auto fixture, algo::make_fixture(rig));
  return [fixture](double travel_m, const Errors5& local, std::span<double> probe_m) {
    const Eigen::VectorXd readings = algo::rigid_readings(fixture, travel_m, local);
    for (std::size_t i = 0; i < probe_m.size(); ++i)
      probe_m[i] = readings(static_cast<Eigen::Index>(i));
  };
}

}  // namespace mdof::daemon
