// The method compensation.build_volume, and the methods compensation.* for the volume.
#include "schema/units.h"
#include "tests/daemon/methods/methods_fixture.h"

namespace mdof::daemon {
namespace {

#define EXPECT_SAYS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

// A machine as JSON text. All errors of X and Y are 0 except EXX, EBX and EC0Y. X moves the
// workpiece. `more`: further lines of TOML.
std::string a_machine(const std::string& more = "") {
  std::string text =
      R"(name = \"mill\"\nmachine = {chain = \"w-X-b-Y-t\"}\ntool = {point_mm = [0, 0, 20]}\n)" +
      more;
  for (const char axis : std::string("XY")) {
    text += std::string(R"([[axis]]\nid = \")") + axis +
            R"(\"\nholds_at_mm = [0, 0, 0]\npoint = \"standing\"\nrange_mm = [0, 20]\n)";
    for (const char direction : std::string("XYZABC")) {
      const std::string name = std::string("E") + direction + axis;
      const bool angle = direction < 'D';
      const std::string value = name == "EXX"   ? "[[0, 0], [20, 2]]"
                                : name == "EBX" ? "[[0, 0], [20, 100]]"
                                                : "0";
      text += name + (angle ? "_urad = " : "_um = ") + value + R"(\nu_)" + name +
              (angle ? "_urad = 1" : "_um = 0.01") + R"(\n)";
    }
  }
  return text + R"(EC0Y_urad = 50\nu_EC0Y_urad = 0.5\n)";
}

class VolumeMethods : public MethodsTest {
 protected:
  Answer build(const std::string& more = R"("axes": "XY", "step_mm": 5)",
               const std::string& machine = a_machine()) {
    return call("compensation.build_volume", R"({"machine": ")" + machine + R"(", )" + more + "}");
  }
  Answer activate(int table) {
    return call("compensation.activate", R"({"table":)" + std::to_string(table) + "}");
  }
  Answer value_at(const std::string& place) {
    return call("compensation.at", R"({"axis":"volume")" + place + "}");
  }
};

TEST_F(VolumeMethods, ATableIsBuiltActivatedServedAndDeactivated) {
  const Answer none = value_at("");
  EXPECT_EQ(none.code(), rpc::kNotFound);
  EXPECT_SAYS(none.message(), "no volumetric table is active");
  const Answer table = build();
  ASSERT_EQ(table.code(), 0) << table.text();
  EXPECT_EQ(table.at("/result/table"), "1");
  EXPECT_EQ(table.at("/result/nodes"), "25");
  EXPECT_EQ(table.at("/result/doubtful"), "false");
  EXPECT_EQ(table.at("/result/not_measured"), "[]");
  EXPECT_EQ(call("compensation.status").at("/result/volume"), "null");
  std::int64_t announced = 0;
  bench_->methods.announce = [&](std::int64_t generation) { announced = generation; };
  const Answer done = activate(1);
  EXPECT_EQ(done.at("/result/changed"), "true") << done.text();
  const std::string generation = done.at("/result/generation");
  EXPECT_EQ(std::to_string(announced), generation);
  const Answer status = call("compensation.status");
  EXPECT_EQ(status.at("/result/volume/table"), "1");
  EXPECT_EQ(status.at("/result/volume/generation"), generation);
  EXPECT_EQ(status.at("/result/generation"), generation);

  // compensation.table returns a stored table in pages, whether or not the table is active.
  const Answer stored = call("compensation.table", R"({"table":1,"offset":24,"count":9})");
  EXPECT_EQ(stored.at("/result/nodes"), "25") << stored.text();
  EXPECT_EQ(stored.at("/result/active"), "true");
  ASSERT_EQ(stored.size("/result/points"), 1u);
  EXPECT_EQ(stored.at("/result/points/0/0"), "20");
  EXPECT_EQ(stored.size("/result/points/0"), 15u);
  EXPECT_EQ(table.size("/result/points"), 25u);
  const Answer list = call("compensation.list");
  EXPECT_EQ(list.at("/result/tables"), "[]");
  EXPECT_EQ(list.at("/result/volumes/0/table"), "1");
  EXPECT_EQ(call("compensation.list", R"({"axis":"X"})").at("/result/volumes"), "[]");
  EXPECT_EQ(call("compensation.list", R"({"axis":"volume"})").at("/result/tables/0/table"), "1");

  // Expected correction at X = 20 mm, Y = 20 mm:
  // - The workpiece moves 2 µm too far (EXX).
  // - The workpiece rotates by 100 µrad about Y (EBX). At the tool, 20 mm higher, this displaces
  //   the material by another 2 µm.
  // - At 20 mm of Y the tool is displaced by 1 µm towards -X (EC0Y). X moves the workpiece and
  //   corrects this displacement too.
  const Answer at = value_at(R"(,"X_mm":20,"Y_mm":20)");
  EXPECT_NEAR(at.number("/result/correction/X_um"), -(2 + 2 + 1), 1e-3) << at.text();
  EXPECT_NEAR(at.number("/result/correction/Y_um"), 0, 1e-3);
  EXPECT_EQ(at.at("/result/inside"), "true");
  EXPECT_EQ(at.at("/result/generation"), generation);
  EXPECT_GT(at.number("/result/u/X_um"), 0.01);
  EXPECT_NEAR(value_at(R"(,"X_mm":10,"Y_mm":7)").number("/result/correction/X_um"), -(1 + 1 + 0.35),
              1e-3);
  const Answer outside = value_at(R"(,"X_mm":10,"Y_mm":7,"Z_mm":3)");
  EXPECT_EQ(outside.at("/result/inside"), "false");
  EXPECT_EQ(outside.at("/result/u/X_um"), "null");
  // a missing coordinate is an error, not 0
  EXPECT_SAYS(value_at(R"(,"X_mm":10)").message(), "Y_mm is missing");

  EXPECT_EQ(activate(1).at("/result/changed"), "false");
  EXPECT_EQ(call("compensation.deactivate", R"({"axis":"volume"})").at("/result/changed"), "true");
  EXPECT_EQ(call("compensation.status").at("/result/volume"), "null");
  EXPECT_EQ(value_at("").code(), rpc::kNotFound);
  EXPECT_EQ(call("compensation.deactivate", R"({"axis":"volume"})").at("/result/changed"), "false");
  EXPECT_EQ(call("history.list").at("/result/total"), "3");
}

TEST_F(VolumeMethods, PagesOfTheGridEqualCompensationAt) {
  ASSERT_EQ(build(R"("axes": "XY", "step_mm": 0.5)").at("/result/nodes"), "1681");
  const std::string generation = activate(1).at("/result/generation");
  std::size_t nodes = 0;
  for (int pages = 0; nodes < 1681; ++pages) {
    ASSERT_LT(pages, 20);
    const Answer page = call("compensation.grid", R"({"axis":"volume","count":1000,"offset":)" +
                                                      std::to_string(nodes) + R"(,"generation":)" +
                                                      generation + "}");
    ASSERT_LT(page.text().size(), 48u * 1024);
    const std::size_t here = page.size("/result/points");
    ASSERT_GT(here, 0u) << page.text().substr(0, 300);
    const std::string x = page.at("/result/points/0/0"), y = page.at("/result/points/0/1");
    const Answer at = value_at(R"(,"X_mm":)" + x + R"(,"Y_mm":)" + y);
    EXPECT_EQ(at.at("/result/correction/X_um"), page.at("/result/points/0/3"));
    EXPECT_EQ(at.at("/result/u/X_um"), page.at("/result/points/0/6"));
    nodes += here;
  }
  EXPECT_EQ(nodes, 1681u);
  EXPECT_EQ(call("compensation.grid", R"({"axis":"volume","offset":1681})").size("/result/points"),
            0u);
  // If errors are from files, the parts of their u are unknown.
  const Answer parts = call("compensation.grid", R"({"axis":"volume","count":1,"u_parts":true})");
  EXPECT_EQ(parts.size("/result/points/0"), 15u);
  EXPECT_EQ(parts.at("/result/points/0/14"), "null");
  EXPECT_EQ(value_at(R"(,"X_mm":0,"Y_mm":0)").at("/result/u_common/X_um"), "null");
  const Answer other = call("compensation.grid", R"({"axis":"volume","generation":1})");
  EXPECT_EQ(other.code(), rpc::kChanged);
}

TEST_F(VolumeMethods, TheLargestTableStaysWithinAReply) {
  std::string wide = a_machine();  // its positions have many digits
  for (const char* from : {"[0, 20]\\nEXX", "[0, 20]\\nEXY"})
    wide.replace(wide.find(from), 7, from[11] == 'X' ? "[0.1, 19.966666666666665]" : "[0.1, 8]");
  const Answer table = build(R"("axes": "XY", "step_mm": 0.04)", wide);
  ASSERT_EQ(table.code(), 0) << table.text();
  EXPECT_EQ(table.at("/result/nodes"), std::to_string(498 * 199));
  ASSERT_EQ(activate(1).at("/result/changed"), "true");
  EXPECT_EQ(call("compensation.status").code(), 0);
  EXPECT_LT(call("compensation.status").text().size(), 40u * 1024);
  EXPECT_GT(call("compensation.grid", R"({"axis":"volume"})").size("/result/points"), 50u);
  EXPECT_LT(table.text().size(), 48u * 1024);
}

TEST_F(VolumeMethods, AnAxisAndTheVolumeAreNotActiveTogether) {
  add_run();
  ASSERT_EQ(call("compensation.build", R"({"runs":[1]})").at("/result/table"), "1");
  ASSERT_EQ(build().at("/result/table"), "2");
  const std::string of_axis = R"({"table":1,"despite_warnings":true})";
  ASSERT_EQ(call("compensation.activate", of_axis).at("/result/changed"), "true");
  const Answer refused = activate(2);
  EXPECT_EQ(refused.code(), rpc::kConflict);
  EXPECT_SAYS(refused.message(), "would correct the errors twice");
  EXPECT_SAYS(refused.message(), "--axis X");
  ASSERT_EQ(call("compensation.deactivate", R"({"axis":"X"})").code(), 0);
  ASSERT_EQ(activate(2).at("/result/changed"), "true");
  EXPECT_SAYS(call("compensation.activate", of_axis).message(), "would correct the errors twice");
}

TEST_F(VolumeMethods, RejectsInvalidBuilds) {
  const auto says = [&](const std::string& more, const std::string& part,
                        const std::string& machine = a_machine()) {
    EXPECT_SAYS(build(more, machine).message(), part);
  };
  says(R"("axes": "XQ", "step_mm": 5)", "axes");
  says(R"("axes": "XX", "step_mm": 5)", "must be XYZ");
  says(R"("axes": "X", "step_mm": 5)", "two or three");
  says(R"("axes": "XYZ", "step_mm": 5)", "no axis Z");
  says(R"("axes": "XY", "step_mm": 0)", "step_mm");
  says(R"("axes": "XY", "step_mm": 0.05)", "larger step");
  says(R"("axes": "XY", "step_mm": 5, "approach": "up")", "approach");
  says(R"("axes": "XY", "step_mm": 5, "limit_um": 4)", "limit");
  says(R"("axes": "XY", "step_mm": 5, "Z_mm": 4)", "no axis Z");
  const std::string named = a_machine(R"(squareness = 7\n)");
  says(R"("axes": "XY", "step_mm": 5)", "no squareness 7", named);
  EXPECT_NE(build(R"("axes": "XY", "step_mm": 5)", "x = ").code(), 0);
  EXPECT_EQ(call("compensation.status").at("/result/volume"), "null");
}

TEST_F(VolumeMethods, SimulatedAndIncompleteTablesNeedConfirmation) {
  ASSERT_EQ(build(R"("axes": "XY", "step_mm": 5)", a_machine(R"(simulated = true\n)"))
                .at("/result/simulated"),
            "true");
  EXPECT_SAYS(activate(1).message(), "simulated");
  std::string without = a_machine();
  without.replace(without.find("EZY_um = 0"), 10, "");
  without.replace(without.find("u_EZY_um = 0.01"), 15, "");
  EXPECT_SAYS(build(R"("axes": "XY", "step_mm": 5)", without).message(), "EZY");
  const Answer incomplete = build(R"("axes": "XY", "step_mm": 5, "incomplete": true)", without);
  EXPECT_EQ(incomplete.at("/result/doubtful"), "true") << incomplete.text();
  EXPECT_SAYS(incomplete.at("/result/notices"), "volume_incomplete");
  EXPECT_SAYS(activate(2).message(), "EZY");
  EXPECT_EQ(call("compensation.activate", R"({"table":2,"despite_warnings":true})")
                .at("/result/doubtful"),
            "true");
}

}  // namespace
}  // namespace mdof::daemon
