// Charts of runs that no recording contains: very many stops, no stop, only one target, invalid
// numbers.
#include <gtest/gtest.h>

#include <limits>

#include "daemon/output/charts/run/run_charts.h"
#include "tests/daemon/output/charts/xml_check.h"

namespace mdof::charts {
namespace {

StatedResults axis_with(std::size_t points, std::size_t targets) {
  StatedResults results;
  results.run.header.id = 7;
  for (std::size_t i = 0; i < points; ++i) {
    MeasuredPoint p;
    p.target = static_cast<int>(i % targets) + 1;
    p.run = static_cast<int>(i / targets) + 1;
    p.point.position_m = 1e-6 * static_cast<double>(i % targets);
    p.point.direction = i % 2 == 0 ? 1 : -1;
    p.errors.valid = true;
    p.errors.local = {1e-7, -1e-7, 1e-6, 2e-6, -3e-6};
    results.run.points.push_back(p);
    ErrorsUncertainty u;
    u.U.fill(1e-8);
    u.coverage_factor.fill(2);
    results.uncertainty.points.push_back(u);
  }
  return results;
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(RunCharts, ManyStopsKeepTheOutlierInASmallFile) {
  StatedResults results = axis_with(143'000, 143'000);
  results.run.points[71'234].errors.local[kDy] = 5e-6;
  const std::string svg = five_errors_svg(results, Language::english);
  EXPECT_EQ(xml_fault(svg), "");
  EXPECT_LT(svg.size(), 1'000'000u);
  EXPECT_EQ(count_of(svg, "data-high=\"5\""), 1u);
  EXPECT_NE(svg.find("The 143\u00a0000 points are drawn in groups"), std::string::npos);
}

TEST(RunCharts, OneTargetHasPointsButNoStraightness) {
  const RunCharts drawn = charts_of_run(axis_with(6, 1), Language::english);
  // Two charts of errors, and one of the differences between the visits.
  ASSERT_EQ(drawn.charts.size(), 3u);
  for (const NamedChart& chart : drawn.charts) EXPECT_EQ(xml_fault(chart.svg), "") << chart.file;
  EXPECT_EQ(count_of(drawn.charts[0].svg, "data-row="), 30u);
  EXPECT_EQ(count_of(drawn.charts[0].svg, "data-band="), 10u);  // five errors, two approaches
  ASSERT_GE(drawn.left_out.size(), 1u);
  EXPECT_NE(drawn.left_out[0].find("at least three targets"), std::string::npos);
}

TEST(RunCharts, ARunWithoutErrorsHasNoChartsAndAReason) {
  StatedResults results = axis_with(4, 2);
  for (MeasuredPoint& p : results.run.points) p.errors = {};
  for (const StatedResults& each : {results, axis_with(0, 1)}) {
    const RunCharts drawn = charts_of_run(each, Language::english);
    EXPECT_TRUE(drawn.charts.empty());
    ASSERT_EQ(drawn.left_out.size(), 1u);
    EXPECT_NE(drawn.left_out[0].find("run 7: no point has error values"), std::string::npos);
  }
}

TEST(RunCharts, ShowAPointWithoutErrorsAndItsReason) {
  StatedResults results = axis_with(9, 3);
  results.run.points[4].errors = {.valid = false, .reason = "probe <C> lost"};
  const std::string svg = five_errors_svg(results, Language::english);
  EXPECT_EQ(xml_fault(svg), "");
  EXPECT_EQ(count_of(svg, "data-reason=\"probe &lt;C&gt; lost\""), 5u);
  EXPECT_NE(svg.find("no error values for 1 of 9 points: probe &lt;C&gt; lost"), std::string::npos);
}

TEST(RunCharts, StateThatUIsUnknown) {
  StatedResults results = axis_with(9, 3);
  for (ErrorsUncertainty& u : results.uncertainty.points) {
    u.U.fill(std::numeric_limits<double>::quiet_NaN());
    u.coverage_factor = u.U;
  }
  results.uncertainty.why = "the rig cannot be read";
  const std::string svg = five_errors_svg(results, Language::english);
  EXPECT_EQ(count_of(svg, ">U unknown<"), 5u);
  EXPECT_NE(svg.find("U unknown: the rig cannot be read"), std::string::npos);
  EXPECT_EQ(count_of(svg, "data-band="), 0u);
  EXPECT_EQ(count_of(svg, "data-U="), 0u);
}

TEST(RunCharts, AreValidForExtremeErrors) {
  for (const double x : {0.0, 1e-300, 1e300, -1e300}) {
    StatedResults results = axis_with(9, 3);
    results.run.points[3].errors.local.fill(x);
    for (const std::string& svg :
         {five_errors_svg(results, Language::german), repeatability_svg(results, Language::german),
          drift_svg(results, Language::german)}) {
      EXPECT_EQ(xml_fault(svg), "") << x;
      for (const char* bad : {"\"nan", "\"inf", "\"-inf", ",nan", ",inf"})
        EXPECT_EQ(svg.find(bad), std::string::npos) << x;
    }
  }
}

}  // namespace
}  // namespace mdof::charts
