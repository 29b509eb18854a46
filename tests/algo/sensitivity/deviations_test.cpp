// Tests the effect of each name of a plan on the mounting of a trial. A name must change one
// deviation, in the unit of this deviation, and nothing else (PLAN.md).
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "algo/sensitivity/plan/axis.h"
#include "tests/algo/rigs.h"
#include "tests/algo/sensitivity/plan_text.h"

namespace mdof::algo {
namespace {

using Deviations = std::map<std::string, double>;

void add_three(Deviations& all, const std::string& name, const Eigen::Vector3d& v) {
  for (Eigen::Index i = 0; i < 3; ++i) all[name + "xyz"[i]] = v[i];
}

Deviations deviations_of(const Mounting& m, const PlanAxis::TrueErrors& truth) {
  Deviations all;
  for (std::size_t k = 0; k < m.probe.size(); ++k) {
    const std::string id = "probe " + std::to_string(k) + " ";
    const ProbeDeviation& p = m.probe[k];
    add_three(all, id + "shift ", p.shift);
    add_three(all, id + "turn ", p.turn);
    all[id + "circle"] = p.circle_m;
    all[id + "tilt"] = p.tilt_rad;
    all[id + "gain"] = p.gain - 1;
    all[id + "zero"] = p.zero_m;
    all[id + "drift"] = p.drift_m;
  }
  for (std::size_t part = 0; part < 3; ++part) {
    const std::string id = "part " + std::to_string(part) + " ";
    add_three(all, id + "shift ", m.part[part].shift);
    add_three(all, id + "turn ", m.part[part].turn);
    add_three(all, id + "plane ", m.plane[part].turn);
    all[id + "map"] = m.plane[part].map_scale - 1;
    all[id + "flatness"] = m.plane[part].flatness_m;
  }
  all["fixture"] = m.fixture_expansion;
  all["target"] = m.target_expansion;
  for (std::size_t k = 0; k < 5; ++k) all["truth " + std::to_string(k)] = truth.amplitude[k];
  return all;
}

// Deviations of a trial in which the quantity `name` has the constant value 3.
Deviations deviations_by(const std::string& name) {
  const auto plan = parse_study_plan(
      "name = \"t\"\nmodel = \"rigid\"\nrig = "
      "\"../five-probe/rig_X.toml\"\n[expansion]\nfixture_ppm_per_K = 10\n"
      "target_ppm_per_K = 20\n" +
          (name.empty() ? "" : quantity(name, "distribution = \"constant\"\nvalue = 3")),
      MDOF_TEST_DATA "/sensitivity/plan.toml");
  EXPECT_TRUE(plan) << plan.error().message;
  const Rig rig = test::rig_x_with("", "",
                                   "[[plane]]\nid = \"top\"\nnormal = \"+Z\"\nflatness_first_mm = "
                                   "[0, 9]\nflatness_second_mm = [0, 9]\nflatness_um = [[0, 1], "
                                   "[2, 0.5]]\n[[plane]]\nid = \"side\"\nnormal = \"+Y\"\n");
  std::vector<std::string> causes;
  const auto axis = PlanAxis::create(plan.value(), rig, "", true, false, causes);
  EXPECT_TRUE(axis) << axis.error().message;
  DrawRequest request;
  request.n = 2;
  DrawnNumbers numbers;
  axis->draws().fill(request, numbers);
  Mounting mounting = axis->nominal_mounting();
  PlanAxis::TrueErrors truth;
  axis->deviate(numbers, 1, mounting, truth);
  return deviations_of(mounting, truth);
}

TEST(PlanDeviations, EachNameChangesOneDeviation) {
  struct Case {
    const char *name, *changes;
    double by;
  };
  const Case cases[] = {{"probe.A.x_um", "probe 0 shift x", 3e-6},
                        {"probe.B.y_um", "probe 1 shift y", 3e-6},
                        {"probe.C.z_um", "probe 2 shift z", 3e-6},
                        {"probe.D.position_um", "probe 3 circle", 3e-6},
                        {"probe.E.tilt_mrad", "probe 4 tilt", 3e-3},
                        {"probe.A.tilt_x_mrad", "probe 0 turn x", 3e-3},
                        {"probe.B.tilt_y_mrad", "probe 1 turn y", 3e-3},
                        {"probe.C.tilt_z_mrad", "probe 2 turn z", 3e-3},
                        {"probe.D.sensitivity_percent", "probe 3 gain", 0.03},
                        {"probe.E.zero_nm", "probe 4 zero", 3e-9},
                        {"probe.A.drift_nm", "probe 0 drift", 3e-9},
                        {"installation.x_um", "part 0 shift x", 3e-6},
                        {"installation.pitch_mrad", "part 0 turn y", 3e-3},
                        {"installation.top.y_um", "part 1 shift y", 3e-6},
                        {"installation.top.roll_mrad", "part 1 turn x", 3e-3},
                        {"installation.side.z_um", "part 2 shift z", 3e-6},
                        {"installation.side.yaw_mrad", "part 2 turn z", 3e-3},
                        {"target.top.roll_mrad", "part 1 plane x", 3e-3},
                        {"target.top.pitch_mrad", "part 1 plane y", 3e-3},
                        {"target.top.flatness_um", "part 1 flatness", 3e-6},
                        {"target.top.map_percent", "part 1 map", 0.03},
                        {"target.side.yaw_mrad", "part 2 plane z", 3e-3},
                        {"target.side.flatness_um", "part 2 flatness", 3e-6},
                        {"temperature.fixture_K", "fixture", 30e-6},
                        {"temperature.target_K", "target", 60e-6}};
  const Deviations none = deviations_by("");
  for (const Case& c : cases)
    for (const auto& [what, value] : deviations_by(c.name)) {
      if (what.starts_with("truth")) continue;
      EXPECT_NEAR(value, what == c.changes ? c.by : none.at(what), 1e-15) << c.name << ": " << what;
    }
  for (const auto& [what, value] : none)
    EXPECT_TRUE(value == 0 || what.starts_with("truth")) << what;
}

TEST(PlanDeviations, TruthNamesSetTheErrorsOfTheAxis) {
  const char* const names[] = {"EYX_um", "EZX_um", "EAX_urad", "EBX_urad", "ECX_urad"};
  for (std::size_t k = 0; k < 5; ++k)
    EXPECT_NEAR(deviations_by("truth." + std::string(names[k])).at("truth " + std::to_string(k)),
                3e-6, 1e-18)
        << names[k];
}

}  // namespace
}  // namespace mdof::algo
