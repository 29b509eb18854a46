#include "algo/sensitivity/simulation.h"

#include <cassert>
#include <cmath>
#include <string>
#include <utility>

#include "algo/sensitivity/kernels/kernels.h"
#include "schema/study/plan.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr double from_mrad(double x_mrad) {
  return x_mrad / 1e3;
}

tl::unexpected<Error> refused(const std::string& option, const std::string& why) {
  return fail(ErrorCode::usage, option + ": " + why);
}

Status check(const SimulationOptions& o) {
  const std::pair<const char*, double> not_negative[] = {{"angle_range_urad", o.angle_range_urad},
                                                         {"offset_range_um", o.offset_range_um},
                                                         {"radius_um", o.radius_um}};
  const std::pair<const char*, double> any[] = {{"travel_from_mm", o.travel_from_mm},
                                                {"travel_to_mm", o.travel_to_mm},
                                                {"l_mm", o.l_mm},
                                                {"side_plane_mm", o.side_plane_mm},
                                                {"side_height_mm", o.side_height_mm},
                                                {"theta_y_mrad", o.theta_y_mrad},
                                                {"theta_p_mrad", o.theta_p_mrad},
                                                {"theta_r_mrad", o.theta_r_mrad},
                                                {"sigma_x_um", o.sigma_x_um},
                                                {"sigma_y_um", o.sigma_y_um},
                                                {"sigma_z_um", o.sigma_z_um}};
  for (const auto& [name, value] : not_negative) {
    if (!std::isfinite(value) || value < 0)
      return refused(name, "must be a number of 0 or greater");
  }
  for (const auto& [name, value] : any) {
    if (!std::isfinite(value)) return refused(name, "must be a number");
  }
  if (o.angle_range_urad > 100'000) {
    return refused("angle_range_urad",
                   "must be at most 100 000 µrad, the limit of the small-angle model");
  }
  if (!(o.l_mm > 0)) return refused("l_mm", "must be above 0");
  if (o.travel_to_mm < o.travel_from_mm) {
    return refused("travel_to_mm", "must be at least travel_from_mm");
  }
  if (o.travel_bins < 1 || o.travel_bins > kMostStudyBins)
    return refused("travel_bins", "must be from 1 to " + std::to_string(kMostStudyBins));
  return {};
}

Result<SmallAngleFixture> nominal_fixture(const SimulationOptions& o) {
  const double l = from_mm(o.l_mm), h = from_mm(o.side_plane_mm), up = from_mm(o.side_height_mm);
  Rig rig;
  rig.name = "nominal";
  const auto add = [&rig](const char* id, Vec3 position_m, Vec3 direction) {
    rig.probes.push_back({id, position_m, direction, {}, 1.0, {}});
  };
  add("A", {l, 0, 0}, {0, 0, 1});
  add("B", {0, l, 0}, {0, 0, 1});
  add("C", {0, -l, 0}, {0, 0, 1});
  add("D", {0, h, up}, {0, 1, 0});
  add("E", {l, h, up}, {0, 1, 0});
  MDOF_TRY(const Fixture fixture, make_fixture(rig));
  return make_small_angle_fixture(fixture);
}

// Moves the probes by the small rotations and offsets of their unit, as in the paper. The place of
// a probe has z = 0 for the top probes and y = h for the side probes.
void install(const SimulationOptions& o, SimulationConstants& s) {
  const double theta_y = from_mrad(o.theta_y_mrad), theta_p = from_mrad(o.theta_p_mrad);
  const double theta_r = from_mrad(o.theta_r_mrad);
  for (std::size_t k = 0; k < 5; ++k) {
    const double x = s.nominal.x[k], across = s.nominal.across[k];
    if (k < 3) {
      s.skew[k] = -theta_y;
      s.x[k] = x - theta_y * across + from_um(o.sigma_x_um);
      s.across[k] = across + theta_y * x + from_um(o.sigma_y_um);
    } else {
      s.skew[k] = theta_p;
      s.x[k] = x - theta_y * s.nominal.h + theta_p * across + from_um(o.sigma_x_um);
      s.across[k] = across + theta_r * s.nominal.h - theta_p * x + from_um(o.sigma_z_um);
    }
  }
}

Result<SimulationConstants> constants_of(const SimulationOptions& o) {
  MDOF_CHECK(check(o));
  SimulationConstants s{};
  MDOF_TRY(s.nominal, nominal_fixture(o));
  install(o, s);
  s.stream = {o.seed, 0};
  s.bins = o.travel_bins;
  s.travel_from = from_mm(o.travel_from_mm);
  s.travel_per_bin = from_mm(o.travel_to_mm - o.travel_from_mm) / static_cast<double>(s.bins);
  s.angle_range = from_urad(o.angle_range_urad);
  s.offset_range = from_um(o.offset_range_um);
  s.h = s.nominal.h;
  s.radius = from_um(o.radius_um);
  return s;
}

class Simulation : public Experiment {
 public:
  Simulation(const SimulationOptions& options, const SimulationConstants& constants,
             InstructionSet set)
      : constants_(constants), simulate_(kernels(set).simulate) {
    outputs_ = {"EYX_um", "EZX_um", "EAX_urad", "EBX_urad", "ECX_urad"};
    binned_ = {"travel_mm", options.travel_from_mm, options.travel_to_mm, options.travel_bins};
  }

  void run(std::uint64_t first, std::uint64_t step, std::size_t n,
           std::span<double* const> out) const override {
    assert(out.size() == outputs_.size());
    simulate_(constants_, first, step, n, out.data(), nullptr);
  }

 private:
  SimulationConstants constants_;
  decltype(Kernels::simulate) simulate_;
};

}  // namespace

SimulationOptions simulation_1_defaults() {
  return {};
}

SimulationOptions simulation_2_defaults() {
  SimulationOptions o;
  o.travel_to_mm = 10;
  o.radius_um = 10;
  o.theta_y_mrad = o.theta_p_mrad = 2;
  o.sigma_x_um = o.sigma_y_um = o.sigma_z_um = 50;
  return o;
}

Result<std::unique_ptr<Experiment>> make_simulation(const SimulationOptions& options,
                                                    InstructionSet set) {
  MDOF_TRY(const SimulationConstants constants, constants_of(options));
  return std::make_unique<Simulation>(options, constants, set);
}

Result<SimulationTrial> simulation_trial(const SimulationOptions& options, std::uint64_t trial) {
  MDOF_TRY(const SimulationConstants constants, constants_of(options));
  SimulationTrial t;
  double* error[5];
  SimulationDraws draws{&t.travel_mm, {}, {}};
  for (std::size_t k = 0; k < 5; ++k) {
    error[k] = &t.error[k];
    draws.truth[k] = &t.truth[k];
    draws.turns[k] = &t.probe_turns[k];
  }
  kernels_baseline().simulate(constants, trial, 1, 1, error, &draws);
  t.travel_mm = to_mm(t.travel_mm);
  for (double& truth : t.truth) truth *= 1e6;  // converts m to µm and rad to µrad
  return t;
}

}  // namespace mdof::algo
