// The methods compensation.build, activate, deactivate, status, grid, at, list and table.
#include "daemon/paths.h"
#include "tests/daemon/methods/methods_fixture.h"

namespace mdof::daemon {
namespace {

#define EXPECT_SAID(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

class CompensationMethods : public MethodsTest {
 protected:
  // Adds a run of X, builds a table from it and activates the table. Returns the generation.
  std::string activate() {
    add_run();
    EXPECT_EQ(call("compensation.build", R"({"runs":[1],"keep_slope":true})").code(), 0);
    const Answer done = call("compensation.activate", R"({"table":1,"despite_warnings":true})");
    EXPECT_EQ(done.at("/result/changed"), "true") << done.text();
    return done.at("/result/generation");
  }
  Answer value_at(double mm, int direction) {
    return call("compensation.at", R"({"axis":"X","position_mm":)" + std::to_string(mm) +
                                       R"(,"direction":)" + std::to_string(direction) + "}");
  }
};

// The controller applied table 1 from its activation until its deactivation.
TEST_F(CompensationMethods, ARunMeasuredWhileATableWasActiveNeedsConfirmation) {
  const char* const code = R"("code":"measured_with_table")";
  activate();
  const auto refused = [&](const char* started_utc) {
    recorded_utc_ = started_utc;
    const std::string run = std::to_string(add_run());
    const Answer built = call("compensation.build", R"({"runs":[)" + run + "]}");
    EXPECT_EQ(built.code(), 0) << built.text();
    const std::string table = R"({"table":)" + built.at("/result/table");
    const Answer answer = call("compensation.activate", table + "}");
    const bool is_refused = answer.code() == rpc::kConflict;
    EXPECT_EQ(built.at("/result/notices").find(code) != std::string::npos, is_refused);
    EXPECT_EQ(built.at("/result/doubtful"), is_refused ? "true" : "false");
    EXPECT_EQ(answer.message().find("while table 1 was active") != std::string::npos, is_refused)
        << answer.text();
    if (is_refused) {
      EXPECT_EQ(call("compensation.activate", table + R"(,"despite_warnings":true})").code(), 0);
      EXPECT_EQ(call("compensation.activate", R"({"table":1,"despite_warnings":true})").code(), 0);
    }
    return is_refused;
  };
  EXPECT_FALSE(refused("2020-01-01T00:00:00.000Z"));
  EXPECT_EQ(call("compensation.activate", R"({"table":1,"despite_warnings":true})").code(), 0);
  const std::string during = utc_now();
  EXPECT_TRUE(refused(during.c_str()));
  EXPECT_EQ(call("compensation.deactivate", R"({"axis":"X"})").code(), 0);
  EXPECT_FALSE(refused("2099-01-01T00:00:00.000Z"));
  EXPECT_EQ(call("compensation.deactivate", R"({"axis":"X"})").code(), 0);
  EXPECT_TRUE(refused(during.c_str())) << "the table is not active any more, but it was";
}

TEST_F(CompensationMethods, ABuiltTableIsNotYetActive) {
  add_run();
  const Answer built = call("compensation.build", R"({"runs":[1]})");
  ASSERT_EQ(built.code(), 0) << built.text();
  EXPECT_EQ(built.at("/result/table"), "1");
  EXPECT_EQ(built.at("/result/axis"), "\"X\"");
  EXPECT_EQ(built.at("/result/reference"), "\"fixture\"");
  EXPECT_EQ(built.at("/result/sha256").size(), 66u);
  EXPECT_EQ(built.at("/result/notices").front(), '[') << built.text();
  const Answer status = call("compensation.status");
  EXPECT_EQ(status.at("/result/generation"), "0");
  EXPECT_EQ(status.at("/result/axes"), "{}");
  const Answer none = value_at(5, 1);
  EXPECT_EQ(none.code(), rpc::kNotFound);
  EXPECT_SAID(none.message(), "no compensation table is active for axis X");
  EXPECT_EQ(call("compensation.grid", R"({"axis":"X"})").code(), rpc::kNotFound);
}

TEST_F(CompensationMethods, RejectsInvalidBuilds) {
  add_run('X', "a"), add_run('Y', "b"), add_run('X', "c", false);
  EXPECT_EQ(call("compensation.build", R"({"runs":[9]})").code(), rpc::kNotFound);
  EXPECT_SAID(call("compensation.build", R"({"runs":[1,1]})").message(), "given twice");
  EXPECT_EQ(call("compensation.build", R"({"runs":[1,2]})").code(), rpc::kBadInput);
  EXPECT_NE(call("compensation.build", R"({"runs":[]})").code(), 0);
  EXPECT_SAID(call("compensation.build", R"({"runs":[3]})").message(), "partial");
  EXPECT_SAID(call("compensation.build", R"({"runs":["1"]})").message(), "runs");
  EXPECT_SAID(call("compensation.build", R"({"runs":[1],"reference":"bed"})").message(), "bed");
  EXPECT_SAID(call("compensation.build", R"({"runs":[1],"reference":"tool"})").message(),
              "tool_point_mm");
  EXPECT_EQ(call("compensation.build", R"({"runs":[3],"partial":true})").at("/result/table"), "1");
  const Answer carriage = call("compensation.build", R"({"runs":[1],"reference":"carriage"})");
  EXPECT_EQ(carriage.at("/result/reference"), "\"carriage\"") << carriage.text();
}

TEST_F(CompensationMethods, AnActiveTableIsServedWithItsGeneration) {
  const std::string generation = activate();
  EXPECT_NE(generation, "0");
  const Answer status = call("compensation.status");
  EXPECT_EQ(status.at("/result/generation"), generation);
  EXPECT_EQ(status.at("/result/axes/X/table"), "1");
  EXPECT_EQ(status.at("/result/axes/X/generation"), generation);
  EXPECT_SAID(status.at("/result/axes/X/activated_by"), "1234");
  EXPECT_EQ(call("server.info").at("/result/generation"), generation);
  const Answer at = value_at(5, 1);
  EXPECT_EQ(at.at("/result/generation"), generation);
  EXPECT_EQ(at.at("/result/table"), "1");
}

TEST_F(CompensationMethods, StoredTablesAreListedAndReadEvenIfNotActive) {
  const std::string generation = activate();
  ASSERT_EQ(call("compensation.build", R"({"runs":[1]})").at("/result/table"), "2");
  const Answer list = call("compensation.list", R"({"axis":"X"})");
  ASSERT_EQ(list.size("/result/tables"), 2u) << list.text();
  EXPECT_EQ(list.at("/result/generation"), generation);
  EXPECT_EQ(list.at("/result/tables/0/table"), "2");
  EXPECT_EQ(list.at("/result/tables/0/active"), "false");
  EXPECT_EQ(list.at("/result/tables/0/generation"), "0");
  EXPECT_EQ(list.at("/result/tables/1/active"), "true");
  EXPECT_EQ(list.at("/result/tables/1/generation"), generation);
  EXPECT_EQ(call("compensation.list", R"({"axis":"Y"})").size("/result/tables"), 0u);
  EXPECT_EQ(call("compensation.list", R"({"axis":"volume"})").size("/result/tables"), 0u);
  EXPECT_EQ(call("compensation.list", R"({"offset":1})").at("/result/tables/0/table"), "1");
  const Answer grid = call("compensation.grid", R"({"axis":"X","offset":1,"count":2})");
  const Answer table = call("compensation.table", R"({"table":1,"offset":1,"count":2})");
  EXPECT_EQ(table.at("/result/points"), grid.at("/result/points"));
  EXPECT_EQ(table.at("/result/doubtful"), grid.at("/result/doubtful"));
  EXPECT_EQ(table.at("/result/active"), "true");
  const Answer other = call("compensation.table", R"({"table":2})");
  EXPECT_EQ(other.at("/result/active"), "false");
  // table 2 was built without its slope
  EXPECT_NE(other.at("/result/points/1"), table.at("/result/points/0"));
  EXPECT_EQ(call("compensation.table", R"({"table":9})").code(), rpc::kNotFound);
}

TEST_F(CompensationMethods, HistoryContainsReasonsOfActivationAndDeactivation) {
  add_run();
  ASSERT_EQ(call("compensation.build", R"({"runs":[1]})").code(), 0);
  call("compensation.activate", R"({"table":1,"despite_warnings":true,"reason":"new guide"})");
  call("compensation.deactivate", R"({"axis":"X","reason":"scraped"})");
  const Answer history = call("history.list", R"({"count":3})");
  EXPECT_EQ(history.at("/result/history/0/detail"), "\"table 1 of X: scraped\"") << history.text();
  EXPECT_EQ(history.at("/result/history/1/detail"), "\"table 1 of X: new guide\"");
  EXPECT_EQ(history.at("/result/history/2/detail"), "");
}

TEST_F(CompensationMethods, ReturnsTheErrorsForPositionAndApproach) {
  activate();
  const TrueErrors first = TrueErrors::at(0), truth = TrueErrors::at(15);
  for (const int direction : {-1, 0, 1}) {
    const Answer at = value_at(15, direction);
    EXPECT_NEAR(at.number("/result/error/EYX_um"), 1e6 * truth.at_fixture(15)[0], 1e-2)
        << at.text();
    // Angles are relative to the angle at the first position.
    EXPECT_NEAR(at.number("/result/error/EAX_urad"), truth.ex_urad - first.ex_urad, 1e-2);
    EXPECT_NEAR(at.number("/result/error/EBX_urad"), truth.ey_urad - first.ey_urad, 1e-2);
    EXPECT_EQ(at.number("/result/direction"), direction);
    EXPECT_NEAR(at.number("/result/position_mm"), 15, 1e-9);
  }
  EXPECT_EQ(value_at(15, 1).at("/result/inside"), "true");
  EXPECT_EQ(value_at(25, 1).at("/result/inside"), "false");
  EXPECT_EQ(value_at(-5, 1).at("/result/inside"), "false");
  // Between two grid points. The true angle is proportional to the position here.
  EXPECT_NEAR(value_at(7.5, 1).number("/result/error/EAX_urad"), 7.5, 1e-2);
  EXPECT_GT(value_at(5, 1).number("/result/u/EYX_um"), 0);
}

TEST_F(CompensationMethods, AMeanStatesTheReversalThatItLeaves) {
  activate();
  const Answer forward = value_at(5, 1), reverse = value_at(5, -1), mean = value_at(5, 0);
  const std::string error = "/result/error/EYX_um", left = "/result/reversal_left/EYX_um";
  const double half = std::abs(forward.number(error) - reverse.number(error)) / 2;
  EXPECT_GT(half, 0);
  EXPECT_NEAR(mean.number(left), half, 1e-9 * half);
  EXPECT_EQ(forward.number(left), 0);
  EXPECT_SAID(mean.at("/result/u_covers"), "(reversal_left)");
  EXPECT_EQ(forward.at("/result/u_covers").find("reversal_left"), std::string::npos);
  EXPECT_EQ(value_at(25, 0).at(left), "null");
}

TEST_F(CompensationMethods, WithoutAChainTheCorrectionIsNullWithAReason) {
  activate();
  const Answer at = value_at(5, 1);
  EXPECT_EQ(at.at("/result/correction"), "null") << at.text();
  EXPECT_SAID(at.at("/result/correction_reason"), "chain");
}

TEST_F(CompensationMethods, RejectsInvalidDirectionsAndParameters) {
  activate();
  for (const int direction : {-2, 2}) {
    EXPECT_EQ(value_at(5, direction).code(), rpc::kInvalidParams);
    EXPECT_SAID(value_at(5, direction).message(), "direction must be 1");
  }
  EXPECT_EQ(call("compensation.at", R"({"axis":"X"})").code(), rpc::kInvalidParams);
  EXPECT_EQ(call("compensation.at", R"({"axis":"Q","position_mm":1})").code(), rpc::kInvalidParams);
  // A parameter that belongs to the other kind of table is rejected and not ignored.
  for (const char* params :
       {R"({"axis":"volume","direction":1})", R"({"axis":"volume","position_mm":1})",
        R"({"axis":"X","position_mm":1,"Y_mm":7})"})
    EXPECT_EQ(call("compensation.at", params).code(), rpc::kInvalidParams) << params;
  EXPECT_EQ(call("compensation.grid", R"({"axis":"X","u_parts":true})").code(),
            rpc::kInvalidParams);
  EXPECT_EQ(call("compensation.at", R"({"axis":"Y","position_mm":1})").code(), rpc::kNotFound);
}

TEST_F(CompensationMethods, AGridIsPagedAndRejectsAnotherGeneration) {
  const std::string generation = activate();
  const Answer page = call("compensation.grid", R"({"axis":"X","offset":3,"count":1})");
  ASSERT_EQ(page.size("/result/points"), 1u) << page.text();
  EXPECT_EQ(page.number("/result/offset"), 3);
  EXPECT_NEAR(page.number("/result/points/0/position_mm"), 15, 1e-6);
  EXPECT_NEAR(page.number("/result/points/0/forward/EAX_urad"), 15, 1e-2);
  EXPECT_EQ(call("compensation.grid", R"({"axis":"X","generation":)" + generation + "}")
                .size("/result/points"),
            5u);
  EXPECT_EQ(call("compensation.grid", R"({"axis":"X","offset":5})").size("/result/points"), 0u);
  const Answer changed = call("compensation.grid", R"({"axis":"X","generation":7})");
  EXPECT_EQ(changed.code(), rpc::kChanged);
  EXPECT_SAID(changed.message(), "generation is now " + generation);
}

TEST_F(CompensationMethods, ADeactivatedTableIsNotServed) {
  const std::string generation = activate();
  const Answer out = call("compensation.deactivate", R"({"axis":"X"})");
  EXPECT_EQ(out.at("/result/changed"), "true") << out.text();
  EXPECT_GT(out.number("/result/generation"), std::stod(generation));
  EXPECT_EQ(value_at(5, 1).code(), rpc::kNotFound);
  EXPECT_EQ(call("compensation.status").at("/result/axes"), "{}");
  EXPECT_EQ(call("compensation.deactivate", R"({"axis":"X"})").at("/result/changed"), "false");
  const auto history = call("history.list");
  EXPECT_EQ(history.at("/result/history/0/deed"), "\"compensation.deactivate\"") << history.text();
}

TEST_F(CompensationMethods, RejectsARequestForAnotherGeneration) {
  const std::string generation = activate();
  const std::string shown = R"("expected_generation":)" + generation;
  ASSERT_EQ(call("compensation.build", R"({"runs":[1]})").at("/result/table"), "2");
  const std::string table = R"({"table":2,"despite_warnings":true,)";
  const Answer before = call("compensation.activate", table + R"("expected_generation":0})");
  EXPECT_EQ(before.code(), rpc::kChanged) << before.text();
  EXPECT_SAID(before.message(), "axis X table 1");
  EXPECT_SAID(before.message(), generation);
  EXPECT_EQ(call("compensation.status").at("/result/axes/X/table"), "1");
  const Answer done = call("compensation.activate", table + shown + "}");
  EXPECT_EQ(done.at("/result/changed"), "true") << done.text();
  for (const char* of : {"X", "volume"})
    EXPECT_EQ(
        call("compensation.deactivate", std::string(R"({"axis":")") + of + "\"," + shown + "}")
            .code(),
        rpc::kChanged);
  EXPECT_EQ(call("compensation.status").at("/result/axes/X/table"), "2");
  EXPECT_EQ(call("compensation.deactivate",
                 R"({"axis":"X","expected_generation":)" + done.at("/result/generation") + "}")
                .at("/result/changed"),
            "true");
}

// A simulated table replaces an active measured table only if the client requests it. Every reply
// then states that the table is simulated.
TEST_F(CompensationMethods, ASimulatedTableIsActivatedOnlyOnRequest) {
  activate();
  simulated_ = true;
  const std::string run = std::to_string(add_run());
  ASSERT_EQ(call("compensation.build", R"({"runs":[)" + run + "]}").at("/result/simulated"),
            "true");
  const Answer refused = call("compensation.activate", R"({"table":2,"despite_warnings":true})");
  EXPECT_EQ(refused.code(), rpc::kConflict) << refused.text();
  EXPECT_SAID(refused.message(), "is simulated");
  EXPECT_SAID(refused.message(), R"(\"simulated\": true)");
  EXPECT_EQ(call("compensation.status").at("/result/axes/X/table"), "1");
  const Answer done =
      call("compensation.activate", R"({"table":2,"simulated":true,"despite_warnings":true})");
  EXPECT_EQ(done.at("/result/simulated"), "true") << done.text();
  EXPECT_EQ(value_at(5, 1).at("/result/simulated"), "true");
  EXPECT_EQ(call("compensation.status").at("/result/axes/X/simulated"), "true");
}

TEST_F(CompensationMethods, ADoubtfulActiveTableIsMarkedInEveryReply) {
  for (const bool whole : {true, false}) {
    const std::string run = std::to_string(add_run('X', whole ? "a" : "b", whole));
    const Answer built = call("compensation.build", R"({"partial":true,"runs":[)" + run + "]}");
    const std::string doubtful = built.at("/result/doubtful");
    EXPECT_TRUE(whole || doubtful == "true") << built.text();
    const Answer done = call("compensation.activate", R"({"despite_warnings":true,"table":)" +
                                                          built.at("/result/table") + "}");
    EXPECT_EQ(done.at("/result/doubtful"), doubtful) << done.text();
    EXPECT_EQ(value_at(5, 1).at("/result/doubtful"), doubtful);
    EXPECT_EQ(call("compensation.status").at("/result/axes/X/doubtful"), doubtful);
    EXPECT_EQ(call("compensation.grid", R"({"axis":"X"})").at("/result/doubtful"), doubtful);
  }
}

TEST_F(CompensationMethods, ResultsOfASupersededRunHaveANotice) {
  const char* const code = R"("code":"made_from_superseded")";
  add_run('X'), add_run('Y');
  const auto notices = [&](const char* method, const char* params) {
    return call(method, params).at("/result/notices");
  };
  const char* const runs = R"({"runs":[1]})";
  const char* const pair = R"({"run_x":1,"run_y":2})";
  EXPECT_EQ(notices("compensation.build", runs).find(code), std::string::npos);
  EXPECT_EQ(notices("squareness.fit", pair).find(code), std::string::npos);
  ASSERT_EQ(call("compensation.table", R"({"table":1})").at("/result/doubtful"), "false");
  supersedes_ = 1;
  ASSERT_EQ(add_run('X', "again"), 3);
  EXPECT_SAID(notices("compensation.build", runs), code);
  EXPECT_SAID(notices("squareness.fit", pair), code);
  EXPECT_EQ(notices("compensation.build", R"({"runs":[3]})").find(code), std::string::npos);
  EXPECT_EQ(call("compensation.table", R"({"table":1})").at("/result/doubtful"), "true");
  const Answer refused = call("compensation.activate", R"({"table":2})");
  EXPECT_EQ(refused.code(), rpc::kConflict) << refused.text();
  EXPECT_SAID(refused.message(), "run 3");
  EXPECT_EQ(call("compensation.activate", R"({"table":3})").code(), 0);
}

TEST_F(CompensationMethods, RejectsATableBeyondItsLimits) {
  add_run();
  const Answer refused = call("compensation.build", R"({"runs":[1],"limit_um":0.01})");
  EXPECT_EQ(refused.code(), rpc::kBadInput) << refused.text();
  EXPECT_SAID(refused.message(), "the limit of 0.01 um");
  EXPECT_SAID(refused.message(), "limit_um");
  EXPECT_EQ(call("compensation.build", R"({"runs":[1],"limit_um":1e9})").code(),
            rpc::kInvalidParams);
  EXPECT_EQ(call("compensation.build", R"({"runs":[1]})").code(), 0);
}

TEST_F(CompensationMethods, ATableWithWarningsIsActivatedOnlyOnRequest) {
  add_run('X', "", false);
  call("compensation.build", R"({"runs":[1],"partial":true})");
  EXPECT_EQ(call("compensation.activate", R"({"table":9})").code(), rpc::kNotFound);
  const Answer refused = call("compensation.activate", R"({"table":1})");
  EXPECT_EQ(refused.code(), rpc::kConflict) << refused.text();
  EXPECT_SAID(refused.message(), "despite_warnings");
  EXPECT_EQ(call("compensation.status").at("/result/axes"), "{}");
  const auto done = call("compensation.activate", R"({"table":1,"despite_warnings":true})");
  EXPECT_EQ(done.at("/result/changed"), "true");
  const auto again = call("compensation.activate", R"({"table":1})");
  EXPECT_EQ(again.at("/result/changed"), "false") << "it is in force: no refusal " << again.text();
  EXPECT_EQ(again.at("/result/generation"), done.at("/result/generation"));
}

}  // namespace
}  // namespace mdof::daemon
