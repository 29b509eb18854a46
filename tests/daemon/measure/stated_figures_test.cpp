// If a figure of a run has no uncertainty, the run contains the reason.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "daemon/measure/budgets.h"
#include "daemon/measure/several_runs/trends.h"
#include "daemon/store/store.h"
#include "daemon/words/words.h"
#include "schema/uncertainty/budget_json.h"
#include "tests/algo/rigs.h"
#include "tests/algo/uncertainty/synthetic_run.h"

namespace mdof::daemon {
namespace {

std::string declared_toml() {
  return test::rig_x_toml() +
         "u_calibration_um = 0.03\n[encoder]\nu_um = 1\n"
         "[[plane]]\nid = \"side\"\nnormal = \"+Y\"\nu_flatness_um = 0.05\n"
         "[[plane]]\nid = \"top\"\nnormal = \"+Z\"\nu_flatness_um = 0.05\n";
}

Run run_with(const std::string& toml, int targets) {
  algo::SyntheticRun synthetic{.rig = parse_rig(toml, "rig_X.toml").value(), .runs = 1};
  synthetic.targets_m.clear();
  for (int t = 0; t < targets; ++t) synthetic.targets_m.push_back(t * 0.1e-3);
  synthetic.u_reading_m = 10e-9;
  Run run = synthetic.measure();
  run.header.provenance.rig_text = toml;
  return run;
}

std::string json_of(const StatedFigures& figures) {
  JsonWriter json;
  json.begin_object();
  write_stated(json, figures);
  json.end_object();
  return json.take();
}

TEST(StatedFigures, EqualTheFiguresCalculatedAlone) {
  const auto run = run_with(declared_toml(), 20);
  const StatedRun stated = stated_run(run);
  EXPECT_EQ(stated.figures.why, "");
  EXPECT_EQ(stated.figures.budgets.size(), 7u);
  EXPECT_EQ(json_of(stated.figures), json_of(figure_budgets(run)));
  EXPECT_EQ(json_of(stated.figures).find("uncertainty_reason"), std::string::npos);
  EXPECT_EQ(stated.points.points[3].U, uncertainty_of(run).points[3].U);
}

TEST(StatedFigures, HaveAReasonIfTheyAreOmitted) {
  const auto why = [](const auto& run) {
    EXPECT_EQ(figure_budgets(run).why, stated_run(run).figures.why);
    EXPECT_TRUE(stated_run(run).figures.budgets.empty());
    return figure_budgets(run).why;
  };
  EXPECT_NE(why(run_with(declared_toml(), 3000)).find("3000 targets"), std::string::npos);
  EXPECT_NE(why(run_with(declared_toml(), 1)).find("too few"), std::string::npos);
  auto broken = run_with(declared_toml(), 5);
  broken.header.provenance.rig_text = "no rig";
  EXPECT_NE(why(broken).find("its rig"), std::string::npos);
  EXPECT_NE(stated_run(broken).points.why.find("its rig"), std::string::npos);
  EXPECT_GT(stated_run(broken).points.points[0].u[0], 0);
  auto empty = run_with(declared_toml(), 5);
  empty.points.clear();
  EXPECT_NE(why(empty).find("no points"), std::string::npos);
  EXPECT_EQ(json_of({{}, "it \"takes\" long"}),
            R"({"uncertainty":{},"uncertainty_reason":"it \"takes\" long"})");
}

// A chart of many runs must not occupy the query thread for minutes.
TEST(StatedFigures, TrendHasAReasonInPlaceOfAUThatTakesLong) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "mdof-trend-of-a-long-run";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  {
    auto store = store::Store::open(folder / "mdof.db", store::Access::read_write).value();
    auto run = run_with(declared_toml(), 1500);
    run.header.state = RunState::complete;
    ASSERT_TRUE(store.add_run(run));
    TrendRequest request;
    request.figure = "EYX_straightness_um";
    const auto found = trends(store, request);
    ASSERT_TRUE(found) << found.error().message;
    const Trend& trend = found->at(0);
    ASSERT_EQ(trend.values.size(), 1u);
    EXPECT_TRUE(std::isfinite(trend.values[0].stated.value));
    EXPECT_TRUE(std::isnan(trend.values[0].stated.U));
    ASSERT_EQ(trend.notices.size(), 1u);
    EXPECT_NE(words::text(trend.notices[0]).find("1500 targets"), std::string::npos);
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace mdof::daemon
