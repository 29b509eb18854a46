// The methods run.start, run.stop, run.resume, run.list, run.get, run.points, squareness.fit and
// history.list.
#include "tests/daemon/methods/methods_fixture.h"

namespace mdof::daemon {
namespace {

#define EXPECT_TEXT(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

class RunMethods : public MethodsTest {
 protected:
  std::string refused_start(const std::string& params) {
    const Answer answer = call("run.start", R"({"axis":"X",)" + params + "}");
    EXPECT_EQ(answer.code(), rpc::kInvalidParams) << answer.text();
    EXPECT_EQ(bench_->stations[0]->run(), 0) << "a refused run has begun";
    return answer.message();
  }
};

TEST_F(RunMethods, ARunIsStartedAsRequestedAndStopped) {
  add_axis();
  const Answer begun = call("run.start", R"({"axis":"X","targets_mm":[0,5,10],"repeats":1,)"
                                         R"("note":"after scraping"})");
  ASSERT_EQ(begun.at("/result/run"), "1") << begun.text();
  EXPECT_EQ(begun.at("/result/axis"), "\"X\"");
  EXPECT_EQ(begun.at("/result/targets_mm"), "[0,5,10]");
  EXPECT_EQ(begun.at("/result/notices/0/code"), "\"datum_missing\"");
  EXPECT_EQ(begun.at("/result/notices/0/subject"), "\"daq\"");
  EXPECT_EQ(call("server.info").at("/result/axes/0/run"), "1");
  TestAxis axis;
  axis.pass_both_ways({0, 5, 10});
  feed_->give(axis.block(0, 1700));
  feed_->wait_until_read();
  const Answer ended = call("run.stop", R"({"run":1})");
  EXPECT_EQ(ended.at("/result/run"), "1");
  EXPECT_EQ(ended.at("/result/axis"), "\"X\"");
  EXPECT_EQ(ended.at("/result/state"), "\"partial\"") << ended.text();
  EXPECT_EQ(ended.at("/result/supersedes"), "null");
  EXPECT_EQ(ended.at("/result/targets_mm"), "");
  const Answer run = call("run.get", R"({"run":1})");
  EXPECT_EQ(ended.at("/result/notices"), run.at("/result/notices"));
  EXPECT_TEXT(ended.at("/result/notices"), R"("code":"datum_missing")");
  EXPECT_EQ(run.at("/result/state"), "\"partial\"") << run.text();
  EXPECT_EQ(run.at("/result/note"), "\"after scraping\"");
  EXPECT_EQ(run.number("/result/points_total"), 3);
  const Answer history = call("history.list");
  EXPECT_EQ(history.number("/result/total"), 2);
  EXPECT_EQ(history.at("/result/history/0/deed"), "\"run.stop\"");
  EXPECT_EQ(history.at("/result/history/1/deed"), "\"run.start\"");
  EXPECT_EQ(history.at("/result/history/1/uid"), "1234");
  EXPECT_EQ(history.at("/result/history/1/gid"), "5678");
  EXPECT_EQ(history.at("/result/history/1/pid"), "42");

  const Answer next = call("run.resume", R"({"run":1})");
  EXPECT_EQ(next.at("/result/run"), "2") << next.text();
  EXPECT_EQ(next.at("/result/targets_mm"), "[0,5,10]");
  EXPECT_TEXT(next.at("/result/notices"), R"("code":"run_goes_on")");
  EXPECT_EQ(call("run.stop", R"({"run":2,"abort":true})").at("/result/run"), "2");
  EXPECT_EQ(call("run.get", R"({"run":2})").at("/result/state"), "\"aborted\"");
  EXPECT_EQ(call("run.get", R"({"run":2})").at("/result/supersedes"), "1");
  EXPECT_EQ(call("history.list").at("/result/history/0/deed"), "\"run.abort\"");
  EXPECT_EQ(call("history.list").at("/result/history/1/deed"), "\"run.resume\"");
}

// One fixture with its probes is moved from axis to axis.
TEST_F(RunMethods, TheProbesOfADeviceMeasureOneAxisAtATime) {
  feed_ = std::make_shared<Feed>();
  SharedDevices devices;
  for (const char axis : {'X', 'Y'}) {
    drivers::DriverSpec spec = fed_by(feed_);
    for (const char* id : TestAxis::kProbes) spec.part[id] = id;
    spec.part[axis == 'X' ? "encoder" : "encoder_Y"] = "encoder";
    bench_->stations.push_back(std::make_unique<Station>(
        AxisConfig{five_probe_rig(axis), {spec}}, PipelineOptions(), "", folder_ / "recordings",
        *bench_->keeper, events_.sink(), std::nullopt, &devices));
  }
  ASSERT_EQ(call("run.start", R"({"axis":"X"})").at("/result/run"), "1");
  const Answer refused = call("run.start", R"({"axis":"Y"})");
  EXPECT_EQ(refused.code(), rpc::kConflict) << refused.text();
  EXPECT_TEXT(refused.message(), "device \\\"daq\\\" are in use for axis X: run 1 is under way");
  EXPECT_EQ(bench_->stations[1]->run(), 0);
  ASSERT_EQ(call("run.stop", R"({"run":1})").at("/result/run"), "1");
  EXPECT_EQ(call("run.start", R"({"axis":"Y"})").at("/result/run"), "2");
  EXPECT_EQ(call("run.resume", R"({"run":1})").code(), rpc::kConflict);
  EXPECT_EQ(call("run.stop", R"({"run":2})").at("/result/run"), "2");
}

TEST_F(RunMethods, TargetsAreCalculatedFromRangeAndInterval) {
  add_axis();
  const Answer even = call("run.start", R"({"axis":"X","from_mm":-1,"to_mm":2,"interval_mm":1.5})");
  EXPECT_EQ(even.at("/result/targets_mm"), "[-1,0.5,2]") << even.text();
  ASSERT_EQ(call("run.stop", R"({"run":1})").code(), 0);
  const Answer moved =
      call("run.start",
           R"({"axis":"X","from_mm":0,"to_mm":90,"interval_mm":30,"jitter_mm":2,"seed":5})");
  ASSERT_EQ(moved.size("/result/targets_mm"), 4u) << moved.text();
  EXPECT_NE(moved.at("/result/targets_mm"), "[0,30,60,90]");
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(moved.number("/result/targets_mm/" + std::to_string(i)), 30.0 * i, 2);
}

// A recording writes -0 as 0 in its JSON. A replay of it must give bit-identical results.
TEST_F(RunMethods, ATargetOfMinusZeroIsZero) {
  add_axis();
  const Answer begun = call("run.start", R"({"axis":"X","targets_mm":[-0.0,5]})");
  EXPECT_EQ(begun.at("/result/targets_mm"), "[0,5]") << begun.text();
}

TEST_F(RunMethods, IntervalsThatHideTheScaleErrorGiveANotice) {
  add_axis();
  const Answer begun = call("run.start", R"({"axis":"X","from_mm":0,"to_mm":10,"interval_mm":1,)"
                                         R"("scale_period_um":20})");
  EXPECT_EQ(begun.at("/result/notices/0/code"), "\"scale_period_hidden\"") << begun.text();
}

TEST_F(RunMethods, RejectsInvalidRequestsByTheirKey) {
  add_axis();
  EXPECT_TEXT(refused_start(R"("targets_mm":[0,5,5])"), "targets_mm must be in ascending order");
  EXPECT_TEXT(refused_start(R"("targets_mm":[5,0])"), "targets_mm must be in ascending order");
  EXPECT_TEXT(refused_start(R"("targets_mm":[0,5000,20000])"), "the target at 20000 mm");
  EXPECT_TEXT(refused_start(R"("from_mm":-2e4,"to_mm":0,"interval_mm":5000)"), "at -20000 mm");
  EXPECT_TEXT(refused_start(R"("targets_mm":[0,"1"])"), "targets_mm");
  EXPECT_TEXT(refused_start(R"("targets_mm":[0,1],"from_mm":0)"), "give only one of the two");
  EXPECT_TEXT(refused_start(R"("from_mm":0,"to_mm":5)"), "interval_mm is missing");
  EXPECT_TEXT(refused_start(R"("from_mm":0,"interval_mm":5)"), "to_mm is missing");
  EXPECT_TEXT(refused_start(R"("to_mm":0,"interval_mm":5)"), "from_mm is missing");
  EXPECT_TEXT(refused_start(R"("from_mm":0,"to_mm":5,"interval_mm":0)"), "interval_mm");
  EXPECT_TEXT(refused_start(R"("from_mm":0,"to_mm":5,"interval_mm":1,"jitter_mm":9)"), "jitter_mm");
  EXPECT_TEXT(refused_start(R"("from_mm":0,"to_mm":1500,"interval_mm":1)"), "limit 1500");
  EXPECT_TEXT(refused_start(R"("repeats":2)"), R"(\"repeats\" needs targets; give targets_mm)");
  EXPECT_TEXT(call("run.start", R"({"axis":"W"})").message(), "must be X, Y or Z");
  const Answer other = call("run.start", R"({"axis":"Y"})");
  EXPECT_EQ(other.code(), rpc::kNotFound);
  EXPECT_TEXT(other.message(), "no rig is configured for axis Y");
  EXPECT_EQ(call("run.list").number("/result/total"), 0);
}

TEST_F(RunMethods, FifteenHundredTargetsFitIntoTheReply) {
  add_axis();
  const Answer most = call("run.start", R"({"axis":"X","from_mm":0,"to_mm":1499,"interval_mm":1})");
  EXPECT_EQ(most.size("/result/targets_mm"), 1500u) << most.text().substr(0, 200);
}

TEST_F(RunMethods, OnlyARunInProgressIsStopped) {
  add_axis();
  const std::int64_t done = add_run();
  for (const std::int64_t id : {done, std::int64_t{99}, std::int64_t{0}, std::int64_t{-1}}) {
    const Answer answer = call("run.stop", R"({"run":)" + std::to_string(id) + "}");
    EXPECT_EQ(answer.code(), rpc::kNotFound) << answer.text();
    EXPECT_TEXT(answer.message(), "run " + std::to_string(id) + " is not under way");
  }
}

TEST_F(RunMethods, ARunThatCannotContinueStatesWhy) {
  add_axis();
  EXPECT_EQ(call("run.resume", R"({"run":9})").code(), rpc::kNotFound);
  add_run('X', "whole"), add_run('X', "part", false), add_run('Y');
  EXPECT_TEXT(call("run.resume", R"({"run":1})").message(), "this run is complete");
  EXPECT_TEXT(call("run.resume", R"({"run":2})").message(),
              "the readings of this run come from a file (a log or an import), not from devices");
  EXPECT_TEXT(call("run.resume", R"({"run":3})").message(), "no rig is configured for axis Y");
}

TEST_F(RunMethods, RunsAreListedNewestFirstByPageAndAxis) {
  add_run('X', "first"), add_run('Y', "second"), add_run('X', "third");
  const Answer all = call("run.list");
  EXPECT_EQ(all.number("/result/total"), 3);
  EXPECT_EQ(all.at("/result/runs/0/note"), "\"third\"");
  EXPECT_EQ(all.at("/result/runs/2/note"), "\"first\"");
  const Answer page = call("run.list", R"({"offset":1,"count":1})");
  EXPECT_EQ(page.number("/result/total"), 3);
  EXPECT_EQ(page.number("/result/offset"), 1);
  ASSERT_EQ(page.size("/result/runs"), 1u);
  EXPECT_EQ(page.at("/result/runs/0/note"), "\"second\"");
  const Answer of_x = call("run.list", R"({"axis":"X"})");
  EXPECT_EQ(of_x.number("/result/total"), 2);
  EXPECT_EQ(of_x.at("/result/runs/1/note"), "\"first\"");
  EXPECT_EQ(call("run.list", R"({"axis":"Z"})").number("/result/total"), 0);
  EXPECT_EQ(call("run.list", R"({"axis":"x y"})").code(), rpc::kInvalidParams);
}

TEST_F(RunMethods, ASupersededRunNamesTheRunThatReplacesIt) {
  add_run('X', "first");
  supersedes_ = 1;
  add_run('X', "second");
  supersedes_ = 2;
  add_run('X', "third");
  const Answer all = call("run.list", R"({"all":true})");
  EXPECT_EQ(all.number("/result/total"), 3);
  EXPECT_EQ(all.at("/result/runs/0/superseded_by"), "null");
  EXPECT_EQ(all.at("/result/runs/1/superseded_by"), "3");
  EXPECT_EQ(all.at("/result/runs/2/superseded_by"), "3");
}

TEST_F(RunMethods, PointsArePagedWithUnitsAndReference) {
  add_run();
  const Answer page = call("run.points", R"({"run":1,"offset":3,"count":2})");
  EXPECT_EQ(page.number("/result/total"), 10);
  EXPECT_EQ(page.number("/result/offset"), 3);
  ASSERT_EQ(page.size("/result/points"), 2u);
  EXPECT_NEAR(page.number("/result/points/0/position_mm"), 15, 1e-9);
  const auto truth = TrueErrors::at(15).at_fixture(15);
  EXPECT_NEAR(page.number("/result/points/0/EYX_um"), 1e6 * truth[0], 3e-4);
  EXPECT_NEAR(page.number("/result/points/0/EZX_um"), 1e6 * truth[1], 3e-4);
  EXPECT_NEAR(page.number("/result/points/0/EAX_urad"), 1e6 * truth[2], 5e-3);
  EXPECT_NEAR(page.number("/result/points/0/ECX_urad"), 1e6 * truth[4], 5e-3);
  EXPECT_EQ(page.at("/result/reference"), "\"fixture\"");
  const Answer carriage = call("run.points", R"({"run":1,"offset":3,"reference":"carriage"})");
  EXPECT_EQ(carriage.at("/result/reference"), "\"carriage\"");
  EXPECT_NEAR(carriage.number("/result/points/0/EYX_um"), TrueErrors::at(15).dy_um, 3e-4);
  EXPECT_EQ(carriage.size("/result/points"), 7u);
  EXPECT_EQ(call("run.points", R"({"run":1,"offset":10})").size("/result/points"), 0u);
  EXPECT_EQ(call("run.points", R"({"run":2})").code(), rpc::kNotFound);
  EXPECT_TEXT(call("run.points", R"({"run":1,"reference":"spindle"})").message(), "spindle");
  const Answer tool = call("run.points", R"({"run":1,"reference":"tool"})");
  EXPECT_EQ(tool.code(), rpc::kInvalidParams);
  EXPECT_TEXT(tool.message(), "tool_point_mm");
}

TEST_F(RunMethods, ARunIsReadWithFiguresAndWithoutPoints) {
  add_run('Y', "of Y");
  const Answer run = call("run.get", R"({"run":1})");
  EXPECT_EQ(run.at("/result/axis"), "\"Y\"");
  EXPECT_EQ(run.number("/result/points_total"), 10);
  EXPECT_FALSE(run.at("/result/straightness/EXY_um/forward").empty()) << run.text();
  EXPECT_FALSE(run.at("/result/angles/ECY_urad").empty());
  EXPECT_FALSE(run.at("/result/plausibility").empty());
  EXPECT_EQ(run.at("/result/points"), "");
  EXPECT_EQ(call("run.get", R"({"run":7})").code(), rpc::kNotFound);
}

TEST_F(RunMethods, ABudgetIsThatOfTheRequestedFigure) {
  add_run('X'), add_run('Y');
  const Answer whole = call("run.budget", R"({"run":1,"figure":"EYX_straightness_um"})");
  ASSERT_EQ(whole.code(), 0) << whole.text();
  const std::string of = "/result/figures/EYX_straightness_um";
  EXPECT_EQ(whole.number(of + "/u"), whole.number(of + "/u_random"));
  EXPECT_EQ(whole.at(of + "/noise_only"), "true");
  EXPECT_EQ(whole.at("/result/figures/EZX_straightness_um"), "");
  const Answer at = call("run.budget", R"({"run":2,"figure":"EXY_um","at_mm":9})");
  EXPECT_EQ(at.code(), 0) << at.text();
  EXPECT_NEAR(at.number("/result/at_mm"), 10, 0.1);
  EXPECT_GT(at.number("/result/figures/EXY_um/U"), 0);
  const Answer square = call("squareness.budget", R"({"run_x":1,"run_y":2})");
  const Answer fitted = call("squareness.fit", R"({"run_x":1,"run_y":2})");
  EXPECT_EQ(square.at("/result/figures/EC0Y_urad/U"), fitted.at("/result/U_EC0Y_urad"));
  EXPECT_EQ(call("run.budget", R"({"run":1,"figure":"EXY_um"})").code(), rpc::kInvalidParams);
  EXPECT_EQ(call("run.budget", R"({"run":1})").code(), rpc::kInvalidParams);
  EXPECT_EQ(call("run.budget", R"({"run":9,"figure":"EYX_slope_urad"})").code(), rpc::kNotFound);
  EXPECT_EQ(call("squareness.budget", R"({"run_x":2,"run_y":1})").code(), rpc::kBadInput);
}

TEST_F(RunMethods, SquarenessNeedsARunAlongXAndOneAlongY) {
  add_run('X'), add_run('Y');
  const Answer plain = call("squareness.fit", R"({"run_x":1,"run_y":2})");
  ASSERT_EQ(plain.code(), 0) << plain.text();
  // EC0Y = -(slope of EXY over y) - (slope of EYX over x). For axis Y, EXY = -dy, with dy in the
  // frame of the axis.
  const auto slope_urad = [](int k) {
    return 1e6 * (TrueErrors::at(20).at_fixture(20)[k] - TrueErrors::at(0).at_fixture(0)[k]) /
           20e-3;
  };
  EXPECT_NEAR(plain.number("/result/EC0Y_urad"), slope_urad(0) - slope_urad(0), 0.1);
  EXPECT_NEAR(plain.number("/result/slope_EYX_urad"), slope_urad(0), 0.1) << plain.text();
  const Answer square =
      call("squareness.fit", R"({"run_x":1,"run_y":2,)"
                             R"("artefact_angle_error_urad":40,"u_artefact_angle_urad":3})");
  EXPECT_NEAR(std::abs(square.number("/result/EC0Y_urad") - plain.number("/result/EC0Y_urad")), 40,
              1e-6);
  EXPECT_NEAR(std::hypot(3, plain.number("/result/u_EC0Y_urad")),
              square.number("/result/u_EC0Y_urad"), 1e-6);
  EXPECT_EQ(call("history.list").at("/result/history/0/deed"), "\"squareness.fit\"");
  EXPECT_EQ(call("squareness.fit", R"({"run_x":2,"run_y":1})").code(), rpc::kBadInput);
  EXPECT_EQ(call("squareness.fit", R"({"run_x":1,"run_y":9})").code(), rpc::kNotFound);
  EXPECT_EQ(call("squareness.fit", R"({"run_x":1,"run_y":2,"u_artefact_urad":-1})").code(),
            rpc::kInvalidParams);
}

TEST_F(RunMethods, APartialRunIsUsedOnlyOnRequest) {
  add_run('X', "", false), add_run('Y');
  const Answer refused = call("squareness.fit", R"({"run_x":1,"run_y":2})");
  EXPECT_NE(refused.code(), 0);
  EXPECT_TEXT(refused.message(), "partial");
  const Answer taken = call("squareness.fit", R"({"run_x":1,"run_y":2,"partial":true})");
  EXPECT_EQ(taken.code(), 0) << taken.text();
  EXPECT_TEXT(taken.at("/result/notices"), "made_from_partial");
}

TEST_F(RunMethods, HistoryIsPaged) {
  add_run('X'), add_run('Y');
  // If the same fit is requested twice, it is stored only once. A different fit is stored in
  // addition.
  for (const char* artefact : {"0", "0", "1", "2"})
    call("squareness.fit",
         R"({"run_x":1,"run_y":2,"artefact_angle_error_urad":)" + std::string(artefact) + "}");
  const Answer page = call("history.list", R"({"offset":1,"count":1})");
  EXPECT_EQ(page.number("/result/total"), 3);
  EXPECT_EQ(page.size("/result/history"), 1u);
  EXPECT_EQ(page.at("/result/history/0/of"), "\"squareness\"");
  EXPECT_EQ(page.at("/result/history/0/id"), "2") << "newest first";
}

}  // namespace
}  // namespace mdof::daemon
