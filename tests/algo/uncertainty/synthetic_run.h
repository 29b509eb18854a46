// Runs with known true errors and known faults. The readings come from the rigid model of the real
// fixture, which may differ from the rig. The solver calculates the errors with the rig.
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "algo/model/fixture.h"
#include "algo/model/restate.h"
#include "algo/model/rigid.h"
#include "algo/model/solver.h"
#include "schema/run.h"

namespace mdof::algo {

struct SyntheticRun {
  Rig rig;  // the rig that the solver uses
  Model model = Model::rigid;
  std::vector<double> targets_m = {0, 5e-3, 10e-3, 15e-3, 20e-3, 25e-3, 30e-3, 35e-3, 40e-3};
  int runs = 3;
  double seconds_a_point = 10;
  StatedAt stated = kAtFixture;
  // True errors of the target in the local frame. Their reference point is the origin of the
  // carriage.
  std::function<Errors5(double travel_m)> truth = [](double) { return Errors5{}; };
  std::optional<Fixture> fixture = std::nullopt;  // the real fixture; none: as the rig
  // Change of the reading of a probe by a fault, m.
  std::function<double(std::size_t probe, double travel_m, double reading_m, double time_s)> added =
      [](std::size_t, double, double, double) { return 0.0; };
  double u_reading_m = 0;

  Run measure() const {
    const Solver solver = Solver::create(rig, model).value();
    const Fixture nominal = make_fixture(rig).value(), as_is = fixture.value_or(nominal);
    const Eigen::VectorXd zero =
        rigid_readings(as_is, 0, Errors5{}) - rigid_readings(nominal, 0, Errors5{});
    Run run;
    run.header.axis = rig.axis;
    run.header.sides = rig.sides;
    run.header.stated = stated;
    run.header.state = RunState::complete;
    run.header.provenance.model = to_string(model);
    double time_s = 0;
    for (int r = 1; r <= runs; ++r)
      for (const int direction : {1, -1})
        for (std::size_t i = 0; i < targets_m.size(); ++i) {
          const std::size_t t = direction > 0 ? i : targets_m.size() - 1 - i;
          run.points.push_back(point(solver, as_is, zero, static_cast<int>(t) + 1, r, direction,
                                     time_s += seconds_a_point));
        }
    return run;
  }

 private:
  MeasuredPoint point(const Solver& solver, const Fixture& as_is, const Eigen::VectorXd& zero,
                      int target, int run, int direction, double time_s) const {
    MeasuredPoint p;
    p.target = target;
    p.run = run;
    p.point.direction = direction;
    p.point.position_m = p.target_m = targets_m[static_cast<std::size_t>(target) - 1];
    p.point.begin_ns = p.point.end_ns = static_cast<std::int64_t>(time_s * 1e9);
    p.point.samples = 100;
    const double d = rig.sides.target_travel_m(p.target_m);
    const Eigen::VectorXd readings = rigid_readings(as_is, d, truth(d)) - zero;
    for (std::size_t k = 0; k < as_is.probes.size(); ++k) {
      const double reading_m = readings(static_cast<Eigen::Index>(k));
      p.point.probe_m.push_back(reading_m + added(k, d, reading_m, time_s));
      p.point.probe_u_m.push_back(u_reading_m);
    }
    p.errors = restate(solver.solve(d, p.point.probe_m, p.point.probe_u_m), model, {rig.axis, {}},
                       d, kAtCarriage, stated);
    return p;
  }
};

}  // namespace mdof::algo
