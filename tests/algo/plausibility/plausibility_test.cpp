// A notice reports each fault of a run. A correct run has no notices.
#include "algo/plausibility/plausibility.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/algo/measured_machine.h"
#include "tests/shown.h"

namespace mdof::algo {
namespace {

Rig five_plain_probes() {
  Rig rig;
  const double l = 10e-3;
  const std::vector<Vec3> at = {
      {l, 0, 0}, {0, l, 0}, {0, -l, 0}, {0, 15e-3, 20e-3}, {l, 15e-3, 20e-3}};
  for (std::size_t k = 0; k < at.size(); ++k) {
    Probe probe;
    probe.id = std::string(1, static_cast<char>('A' + k));
    probe.position_m = at[k];
    probe.range_m = 400e-6;
    rig.probes.push_back(probe);
  }
  return rig;
}

struct Judged {
  Plausibility figures;
  Notices notices;

  bool says(const std::string& what) const { return all().find(what) != std::string::npos; }
  std::string all() const { return test::shown(notices); }
};

// Evaluates a run in the same way as the pipeline. The errors of point i are valid if `solved(i)`
// is true.
template <class Solved>
Judged judge(const Machine& machine, const std::vector<double>& targets_m, Solved solved) {
  Rig rig = five_plain_probes();
  rig.probes.resize(1);  // Machine simulates one probe
  DwellDetector detector({}, {"A"}, {200e-6});
  std::vector<Point> points;
  detector.push(machine.frames, points);
  detector.flush(points);
  SequenceOptions options;
  options.targets_m = targets_m;
  Sequence sequence = recognise_sequence(points, options);
  for (std::size_t i = 0; i < sequence.points.size(); ++i) {
    auto& errors = sequence.points[i].errors;
    errors.valid = solved(i);
    errors.reason = errors.valid ? "" : "probe A is lost";
  }
  const RunToJudge run{rig, sequence, detector.summary(), 0, !targets_m.empty()};
  Judged judged{plausibility(run), sequence.notices};
  append(judged.notices, visit_notices(run));
  return judged;
}

Judged judge(const Machine& machine, const std::vector<double>& targets_m = {}) {
  return judge(machine, targets_m, [](std::size_t) { return true; });
}

TEST(Plausibility, CountsVisits) {
  Machine m;
  m.standard(3);
  const Judged judged = judge(m);
  EXPECT_EQ(judged.all(), "");
  EXPECT_EQ(judged.figures.cycle, "standard");
  EXPECT_EQ(judged.figures.runs, 3);
  ASSERT_EQ(judged.figures.n_ij.size(), 7u);
  for (const auto& row : judged.figures.n_ij) {
    EXPECT_EQ(row.forward, (std::vector<int>{1, 1, 1}));
    EXPECT_EQ(row.reverse, (std::vector<int>{1, 1, 1}));
  }
  EXPECT_NEAR(judged.figures.rate_hz, 500, 1e-9);
  ASSERT_EQ(judged.figures.probes.size(), 1u);
  EXPECT_NEAR(judged.figures.probes[0].sd_m, 10e-9, 1e-9);
  EXPECT_NEAR(judged.figures.probes[0].travel_m, 30e-6, 50e-9);
}

TEST(Plausibility, ReportsAMissingVisit) {
  Machine m;
  m.forward(1), m.beyond(7, 1), m.reverse(1), m.beyond(1, -1);
  for (const int t : {1, 2, 4, 5, 6, 7}) m.visit(t, 2, 1);
  m.beyond(7, 1), m.reverse(2);
  const Judged judged = judge(m);
  EXPECT_EQ(judged.all(),
            "visit_missing run=2 approach=forward targets=target 3\n"
            "run_lacks_visits runs=run 2\n");
  EXPECT_EQ(judged.figures.n_ij[2].forward, (std::vector<int>{1, 0}));
}

TEST(Plausibility, ReportsAnUnsolvedVisit) {
  Machine m;
  m.standard(2);
  const Judged judged = judge(m, {}, [](std::size_t i) { return i != 8; });
  EXPECT_EQ(judged.all(),
            "visit_unsolved run=1 approach=reverse targets=target 6 reason=probe A is lost\n"
            "run_lacks_visits runs=run 1\n");
  EXPECT_EQ(judged.figures.n_ij[5].reverse, (std::vector<int>{0, 1}));
}

TEST(Plausibility, ReportsVisitsMissingAfterAnEarlyEnd) {
  Machine m;
  m.standard(1);
  m.forward(2);
  m.beyond(7, 1);
  m.visit(7, 2, -1), m.visit(6, 2, -1);
  EXPECT_EQ(judge(m).all(),
            "visit_outside_log run=2 approach=reverse targets=targets 1 to 5\n"
            "run_lacks_visits runs=run 2\n");
  Machine shorter;
  shorter.standard(1);
  shorter.forward(2);
  EXPECT_EQ(judge(shorter).all(),
            "visit_outside_log run=2 approach=reverse targets=any target\n"
            "run_lacks_visits runs=run 2\n");
}

TEST(Plausibility, ReportsADoubledVisit) {
  Machine m;
  for (int t = 1; t <= 7; ++t) {
    m.visit(t, 1, 1);
    if (t == 4) m.beyond(4, -1), m.visit(4, 1, 1);
  }
  m.beyond(7, 1), m.reverse(1);
  EXPECT_EQ(judge(m).all(), "visit_doubled run=1 approach=forward targets=target 4\n");
}

TEST(Plausibility, ReportsATargetThatIsFoundLate) {
  Machine m;
  for (const int t : {1, 2, 4, 5, 6, 7}) m.visit(t, 1, 1);
  m.beyond(7, 1), m.reverse(1), m.beyond(1, -1);
  m.forward(2), m.beyond(7, 1), m.reverse(2);
  const Judged judged = judge(m);
  EXPECT_TRUE(judged.says("visit_missing run=1 approach=forward targets=target 3\n"))
      << judged.all();
  EXPECT_TRUE(judged.says("targets_renumbered targets=target 3\n")) << judged.all();
}

TEST(Plausibility, ReportsAGivenTargetWithoutVisits) {
  Machine m;
  m.standard(2);
  auto targets_m = m.targets;
  targets_m.push_back(35e-3);
  EXPECT_EQ(judge(m, targets_m).all(), "target_never_visited targets=target 8\n");
}

TEST(Plausibility, ReportsStopsThatAreTooShort) {
  Machine m;
  m.forward(1), m.beyond(7, 1), m.reverse(1), m.beyond(1, -1);
  for (int t = 1; t <= 7; ++t) {
    m.dwell_s = t == 5 ? 0.15 : 0.4;
    m.stop(m.at(t));
  }
  m.beyond(7, 1), m.reverse(2);
  const Judged judged = judge(m);
  EXPECT_TRUE(judged.says("visit_missing run=2 approach=forward targets=target 5\n"))
      << judged.all();
  EXPECT_TRUE(judged.says("visit_without_point visits=1 too_short=1 creeping=0 longest_s=0.1"))
      << judged.all();
  EXPECT_EQ(judged.figures.short_stops, 1u);
}

TEST(Plausibility, ReportsStopsAtOnePlaceOnly) {
  Machine m;
  m.dwell_s = 0.15;
  m.forward(1), m.beyond(7, 1), m.reverse(1);
  m.dwell_s = 1;
  m.stop(m.at(3));
  const Judged judged = judge(m);
  EXPECT_TRUE(judged.says("stops_at_one_place position_mm=10.2 ")) << judged.all();
  EXPECT_TRUE(judged.says(" others=14 needed_s=0.2 ")) << judged.all();
}

// The stops at the other targets are left out because only one target is given, and no stop is
// short.
TEST(Plausibility, GivenTargetIsNotTheOnlyPlaceOfStops) {
  Machine m;
  m.standard(1);
  const Judged judged = judge(m, {m.at(3)});
  EXPECT_FALSE(judged.says("stops_at_one_place")) << judged.all();
  EXPECT_TRUE(judged.says("most_stops_left_out left_out=12 kept=2 ")) << judged.all();
}

TEST(Plausibility, ReportsGivenTargetsInAnotherUnit) {
  Machine m;
  m.standard(2);
  std::vector<double> in_m;
  for (const double t : m.targets) in_m.push_back(1e-3 * t);
  const Judged judged = judge(m, in_m);
  EXPECT_TRUE(judged.says("most_stops_left_out left_out=")) << judged.all();
}

TEST(Plausibility, ReportsThatAPendulumIsAssumed) {
  Machine m;
  m.forward(1);
  for (int t = 6; t >= 1; --t) m.visit(t, 1, -1);
  EXPECT_TRUE(judge(m).says("pendulum_assumed\n"));
}

// In a pendulum cycle the end targets have one visit per cycle, which is not reported. Any other
// missing visit is reported.
TEST(Plausibility, PendulumHasOneVisitAtItsEnds) {
  const auto pendulum = [](int missed) {
    Machine m;
    m.visit(1, 1, 1);
    for (int run = 1; run <= 3; ++run) {
      for (int t = 2; t <= 7; ++t) m.visit(t, run, 1);
      for (int t = 6; t >= 1; --t)
        if (run != 2 || t != missed) m.visit(t, run, -1);
    }
    return judge(m).all();
  };
  EXPECT_EQ(pendulum(0), "");
  EXPECT_EQ(pendulum(4),
            "visit_missing run=2 approach=reverse targets=target 4\n"
            "run_lacks_visits runs=run 2\n");
}

// ---- units ----

Plausibility right() {
  Plausibility p;
  p.rate_hz = 1000;
  p.encoder_min_m = -1e-3, p.encoder_max_m = 61e-3;
  for (const char* id : {"A", "B", "C", "D", "E"})
    p.probes.push_back({id, 78, 10e-9, 20e-6, -8e-6, 12e-6});
  return p;
}

std::string said(const Rig& rig, const Plausibility& p) {
  return test::shown(unit_notices(rig, p));
}

void scale(ProbeFigures& p, double factor) {
  p.sd_m *= factor, p.travel_m *= factor, p.min_m *= factor, p.max_m *= factor;
}

TEST(Units, CorrectRunHasNoNotices) {
  EXPECT_EQ(said(five_plain_probes(), right()), "");
  Plausibility quiet = right();  // a well adjusted axis with low noise
  for (auto& p : quiet.probes) p = {p.id, 78, 1e-9, 0.1e-6, -0.05e-6, 0.05e-6};
  EXPECT_EQ(said(five_plain_probes(), quiet), "");
}

TEST(Units, ReportsWrongUnitOfTheEncoder) {
  Plausibility p = right();
  p.encoder_max_m = 61;
  EXPECT_EQ(said(five_plain_probes(), p), "travel_too_long travel_m=61.001\n");
  p.encoder_min_m = 0, p.encoder_max_m = 60e-6;
  EXPECT_EQ(said(five_plain_probes(), p).find("travel_too_short travel_mm=0.06\n"), 0u);
}

TEST(Units, ReportsWrongUnitOfTime) {
  Plausibility p = right();
  p.rate_hz = 1;
  EXPECT_EQ(said(five_plain_probes(), p), "rate_too_low rate_hz=1\n");
}

TEST(Units, ReportsWrongUnitOfEachProbe) {
  for (std::size_t k = 0; k < 5; ++k) {
    Plausibility p = right();
    scale(p.probes[k], 1e-3);
    EXPECT_EQ(said(five_plain_probes(), p),
              "reading_too_small " + p.probes[k].id + " largest_um=0.012\n");
    scale(p.probes[k], 1e6);
    EXPECT_EQ(said(five_plain_probes(), p),
              "reading_too_noisy " + p.probes[k].id + " noise_um=10\n");
  }
}

TEST(Units, FrozenProbeHasNoUnitNotice) {
  Plausibility p = right();
  p.probes[2] = {"C", 78, 0, 0, 0, 0};
  EXPECT_EQ(said(five_plain_probes(), p), "");
}

TEST(Units, ReportsAGapWithoutOffset) {
  Rig rig = five_plain_probes();
  Plausibility p = right();
  rig.probes[1].calibration.reads_gap = true;
  EXPECT_EQ(said(rig, p), "");
  p.probes[1].min_m = -210e-6, p.probes[1].max_m = -190e-6;
  EXPECT_EQ(said(rig, p), "gap_without_offset B gap_um=200\n");
  rig.probes[1].calibration.offset_um = 50;
  EXPECT_EQ(said(rig, p), "");
}

TEST(Units, ReportsWrongUnitOfTheFixture) {
  for (const auto& [factor, code] :
       {std::pair(1e3, "fixture_too_large reach_m=25\n"), std::pair(1e-3, "fixture_too_small ")}) {
    Rig rig = five_plain_probes();
    for (auto& probe : rig.probes)
      for (double& x : probe.position_m) x *= factor;
    EXPECT_EQ(said(rig, right()).find(code), 0u) << said(rig, right());
  }
}

// From the second run on, all three targets are 0.3 mm further than in the first run.
TEST(Plausibility, ReportsShiftedTargetsWithTimeAndShift) {
  Sequence sequence;
  sequence.targets_m = {0, 0.3e-3, 10e-3, 10.3e-3, 20e-3, 20.3e-3};
  sequence.targets = 6;
  sequence.runs = 2;
  for (int run = 1; run <= 2; ++run)
    for (int t = 0; t < 3; ++t) {
      MeasuredPoint p;
      p.target = 2 * t + run;
      p.run = run;
      p.target_m = p.point.position_m = sequence.targets_m[static_cast<std::size_t>(p.target) - 1];
      p.point.direction = 1;
      p.point.begin_ns = 1'000'000'000LL * (5 + 10 * (3 * run + t));
      p.point.end_ns = p.point.begin_ns + 2'000'000'000LL;
      p.point.probe_m.assign(5, 1e-6 * (t - 1) * run);
      p.point.probe_sd_m.assign(5, 1e-8 * (t + 1));
      p.errors.valid = true;
      sequence.points.push_back(p);
    }
  const Rig rig = five_plain_probes();
  const DwellDetector::Summary dwells;
  const RunToJudge run{rig, sequence, dwells};
  EXPECT_EQ(run.scans_lost, 0u);
  EXPECT_FALSE(run.targets_given);
  std::size_t reported = 0;
  for (const Notice& notice : visit_notices(run)) {
    if (notice.code != NoticeCode::targets_shifted) continue;
    ++reported;
    EXPECT_NEAR(test::number(notice, "shift_mm"), 0.3, 1e-9);
    EXPECT_NEAR(test::number(notice, "time_s"), 22,
                1e-9);  // end of the third stop of run 1
  }
  EXPECT_EQ(reported, 1u);
  // The figures are calculated from the probes' readings at these stops.
  const Plausibility found = plausibility(run);
  ASSERT_EQ(found.probes.size(), 5u);
  EXPECT_EQ(found.probes[2].id, "C");
  EXPECT_EQ(found.probes[2].points, 6u);
  EXPECT_NEAR(found.probes[2].min_m, -2e-6, 1e-18);
  EXPECT_NEAR(found.probes[2].max_m, 2e-6, 1e-18);
  EXPECT_NEAR(found.probes[2].travel_m, 4e-6, 1e-18);
  EXPECT_NEAR(found.probes[2].sd_m, 2e-8, 1e-20);
  for (MeasuredPoint& p : sequence.points) p.point.probe_m[2] = std::nan("");
  const ProbeFigures none = plausibility(run).probes[2];
  EXPECT_EQ(none.points, 0u);
  EXPECT_TRUE(std::isnan(none.min_m) && std::isnan(none.max_m) && std::isnan(none.travel_m));
}

// One stop is enough to detect noise above 1 µm or above 0.25 % of the range. Without stops there
// is no notice.
TEST(Plausibility, OneStopShowsANoisyProbe) {
  const Rig rig = five_plain_probes();  // the range of each probe is 400 µm
  const auto noisy = [&](std::size_t points, double sd_m) {
    Plausibility figures;
    for (const Probe& probe : rig.probes) {
      ProbeFigures& of = figures.probes.emplace_back();
      of.id = probe.id;
      of.points = points;
      of.sd_m = probe.id == "D" ? sd_m : 1e-8;
      of.min_m = -1e-6;
      of.max_m = 1e-6;
      of.travel_m = 2e-6;
    }
    std::vector<std::string> named;
    for (const Notice& notice : unit_notices(rig, figures))
      if (notice.code == NoticeCode::reading_too_noisy) named.push_back(notice.subject);
    return named;
  };
  EXPECT_EQ(noisy(1, 1.2e-6), std::vector<std::string>{"D"});
  EXPECT_TRUE(noisy(1, 0.9e-6).empty());
  EXPECT_TRUE(noisy(0, 1.2e-6).empty());
}

}  // namespace
}  // namespace mdof::algo
