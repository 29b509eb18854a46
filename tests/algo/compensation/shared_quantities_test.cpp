// u of the position of a tool if the same probes measured two axes. Expected values: tables are
// built from readings of a probe with a scale error, and the machine model calculates the tool
// position from these tables.
#include "algo/compensation/shared_quantities.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "algo/compensation/declared_uncertainty.h"
#include "algo/machine/budget/budget.h"
#include "algo/part/machine_causes.h"
#include "tests/algo/compensation/table_lever.h"
#include "tests/algo/rigs.h"
#include "tests/algo/uncertainty/synthetic_run.h"

namespace mdof::algo {
namespace {

const Eigen::Vector3d kToolPlace_m(5e-3, -3e-3, -30e-3);
constexpr std::size_t kRow = 6;

// A rig with the same fixture for X or Y. A run along Y has the local axes x = +Y and y = -X.
Rig axis_rig(Axis axis, const std::string& certificate) {
  const bool y = axis == Axis::y;
  std::string toml = std::string("name = \"test\"\naxis = \"") + letter(axis) + "\"\n";
  const auto probe = [&](const char* id, double along, double across, double up, bool top) {
    toml += std::string("[[probe]]\nid = \"") + id + "\"\nposition_mm = [" +
            std::to_string(y ? -across : along) + ", " + std::to_string(y ? along : across) + ", " +
            std::to_string(up) + "]\nmeasures = \"" +
            (top ? "+Z"
             : y ? "-X"
                 : "+Y") +
            "\"\nrange_um = 200\n";
    if (*id == 'B') toml += "u_sensitivity_ppm = 1000\ncertificate = \"" + certificate + "\"\n";
  };
  probe("A", 10, 0, 0, true);
  probe("B", 0, 10, 0, true);
  probe("C", 0, -10, 0, true);
  probe("D", 0, 15, 20, false);
  probe("E", 10, 15, 20, false);
  return parse_rig(toml, "rig.toml").value();
}

// Builds a table; the readings of B are too large by the fraction `off`.
BuiltFrom built(Axis axis, double off, const std::string& certificate = "1") {
  const Rig rig = axis_rig(axis, certificate);
  SyntheticRun synthetic{.rig = rig, .model = Model::simplified};
  const double size = axis == Axis::x ? 1 : 0.6;
  synthetic.truth = [size](double d) {
    return Errors5{0, size * 5e-3 * d * d, size * 2e-2 * d * d, -size * 1e-2 * d * d, 0};
  };
  synthetic.added = [off](std::size_t k, double, double reading_m, double) {
    return k == 1 ? off * reading_m : 0;
  };
  BuiltFrom of{{}, {rig}, {synthetic.measure()}, {}};
  of.options.remove_slope = false;
  of.options.stated = kAtFixture;
  of.table = build_table(of.runs, of.options).value();
  for (auto* side : {&of.table.u_forward, &of.table.u_reverse})
    for (auto& u : *side) u.assign(of.table.position_m.size(), 0);
  EXPECT_TRUE(add_declared_uncertainty(of.table, of.rigs, of.runs, of.options));
  return of;
}

Machine both_axes(const std::vector<BuiltFrom>& tables) {
  Machine machine;
  for (const BuiltFrom& of : tables) {
    const auto together = error_covariances(of.table, of.rigs, of.runs, of.options).value();
    const Machine one = test::machine_of(of.table, kToolPlace_m, together);
    machine.tool_m = one.tool_m;
    machine.frames.push_back(one.frames.front());
  }
  const auto shared = shared_quantities(tables).value();
  for (const SharedQuantity& quantity : shared)
    for (std::size_t t = 0; t < tables.size(); ++t) {
      ErrorCovariance& all = machine.frames[t].covariance;
      auto& part = all.shared.emplace_back();
      part.name = contributor_text(quantity.name);
      for (std::size_t row = 0; row < quantity.by_table[t].size(); ++row) {
        auto& at = part.at.emplace_back();
        for (std::size_t k = 0; k < kErrorCount; ++k)
          at[std::string_view("XYZABC").find(error_names(tables[t].table.axis)[k].name[1])] =
              quantity.by_table[t][row][k];
        all.declared[row] = {};  // no other declared uncertainties, and no noise
      }
    }
  return machine;
}

Command command_at_row(const std::vector<BuiltFrom>& tables) {
  return {tables[0].table.position_m[kRow], tables[1].table.position_m[kRow]};
}

Eigen::Vector3d tool_error_at_row(const std::vector<BuiltFrom>& tables) {
  const Machine machine = both_axes(tables);
  return tool_error(machine, command_at_row(tables), MachineApproach::forward).exact.head<3>();
}

TEST(SharedQuantities, CommonProbeMovesTheToolThroughBothAxes) {
  const std::vector<BuiltFrom> tables = {built(Axis::x, 0), built(Axis::y, 0)};
  const Eigen::Vector3d moved =
      (tool_error_at_row({built(Axis::x, 1e-3), built(Axis::y, 1e-3)}) - tool_error_at_row(tables))
          .cwiseAbs();
  Machine machine = both_axes(tables);
  ASSERT_EQ(machine.frames[0].covariance.shared.size(), 1u);
  EXPECT_EQ(machine.frames[1].covariance.shared[0].name, "probe B: sensitivity");
  const Command at = command_at_row(tables);
  const Eigen::Vector3d u = tool_error(machine, at, MachineApproach::forward).u.head<3>();
  const auto budget =
      budget_model(machine, at, MachineApproach::forward, BudgetStage::measured).value();
  // Causes of u at one point of a part.
  const auto causes = machine_causes(machine, {Eigen::Vector3d(at[0], at[1], 0)}).axes;
  for (int c = 0; c < 3; ++c) {
    ASSERT_GT(moved(c), 1e-10);
    EXPECT_NEAR(u(c), moved(c), 2e-3 * moved(c)) << c;
    EXPECT_NEAR(budget_u_m(budget)(c), moved(c), 2e-3 * moved(c)) << c;
    double square = 0;
    std::map<std::size_t, double> common;  // the parts of one number are fully correlated
    for (const PartCause& cause : causes) {
      square += cause.u_m[0](c) * cause.u_m[0](c);
      for (const CommonPart& part : cause.common) common[part.number] += part.u_m[0](c);
    }
    for (const auto& [number, u_m] : common) square += u_m * u_m;
    EXPECT_NEAR(std::sqrt(square), moved(c), 2e-3 * moved(c)) << c;
  }
  // Control: the probe is treated as two independent probes.
  for (std::size_t t = 0; t < tables.size(); ++t) {
    const auto alone =
        error_covariances(tables[t].table, tables[t].rigs, tables[t].runs, tables[t].options);
    machine.frames[t].covariance =
        test::machine_of(tables[t].table, kToolPlace_m, *alone).frames.front().covariance;
  }
  const Eigen::Vector3d apart = tool_error(machine, at, MachineApproach::forward).u.head<3>();
  EXPECT_GT(std::abs(apart.z() / moved.z() - 1), 0.1);
}

TEST(SharedQuantities, DifferentCertificatesAreDifferentProbes) {
  const auto shared = shared_quantities({built(Axis::x, 0), built(Axis::y, 0, "2")}).value();
  EXPECT_TRUE(shared.empty());
}

}  // namespace
}  // namespace mdof::algo
