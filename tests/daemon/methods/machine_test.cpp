#include "tests/daemon/methods/methods_fixture.h"

namespace mdof::daemon {
namespace {

class MachineMethodTest : public MethodsTest {};

std::string at(const std::string& frame, const std::string& more) {
  return R"({"machine":"name = \"m\"\nmachine = {chain = \"w-X-b-t\"}\n[[axis]]\nid = \"X\"\n)"
         R"(holds_at_mm = [0, 0, 0]\npoint = \"moving\"\n)" +
         frame + R"(\n","machine_source":"m.toml")" + more + "}";
}

TEST_F(MachineMethodTest, GivesTheErrorAtACommandWithItsU) {
  const Answer answer =
      call("machine.at", at(R"(EXX_um = [[0, 0], [20, 4]]\nu_EXX_um = 0.1)", R"(,"X_mm":10)"));
  ASSERT_EQ(answer.code(), 0) << answer.text();
  EXPECT_NEAR(answer.number("/result/error/x_um"), -2, 1e-9);  // the workpiece moves 2 µm too far
  EXPECT_NEAR(answer.number("/result/u/x_um"), 0.1, 1e-12);
}

TEST_F(MachineMethodTest, AnUndeclaredUIsNullWithAReason) {
  const Answer answer = call("machine.at", at("EXX_um = 3", ""));
  ASSERT_EQ(answer.code(), 0) << answer.text();
  EXPECT_NE(answer.text().find(R"("u":{"x_um":null)"), std::string::npos) << answer.text();
  EXPECT_NE(answer.text().find("u_reason"), std::string::npos);
  EXPECT_NE(answer.text().find(R"("EBX")"), std::string::npos);  // EBX was not measured
}

// EYX has a value but no u. The reply must not contain u = 0, because this would mean an exactly
// known value.
TEST_F(MachineMethodTest, UOfAComponentWithoutKnownUIsNull) {
  const Answer answer = call("machine.at", at(R"(EXX_um = 3\nu_EXX_um = 0.1\nEYX_um = 1)", ""));
  ASSERT_EQ(answer.code(), 0) << answer.text();
  EXPECT_NEAR(answer.number("/result/u/x_um"), 0.1, 1e-12);
  EXPECT_NE(answer.text().find(R"("y_um":null,"z_um":null})"), std::string::npos) << answer.text();
  EXPECT_NE(answer.text().find(R"("not_declared":["EYX"])"), std::string::npos) << answer.text();
}

TEST_F(MachineMethodTest, RejectsInvalidMachines) {
  for (const auto& [frame, more, says] : {std::tuple{"EXX_um = nan", "", "m.toml"},
                                          {"EXXX_um = 1", "", "EXX"},
                                          {R"(EXX_file = \"/etc/passwd\")", "", "not read files"},
                                          {"", R"(,"C_deg":1)", "C_deg"}}) {
    const Answer answer = call("machine.at", at(frame, more));
    EXPECT_NE(answer.code(), 0) << frame;
    EXPECT_NE(answer.message().find(says), std::string::npos) << answer.text();
  }
}

}  // namespace
}  // namespace mdof::daemon
