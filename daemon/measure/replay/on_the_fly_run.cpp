#include "daemon/measure/replay/on_the_fly_run.h"

#include <algorithm>
#include <utility>

#include "algo/iso230/straightness.h"
#include "algo/plausibility/map_cover.h"
#include "algo/plausibility/plausibility.h"
#include "algo/plausibility/visit_step.h"
#include "daemon/measure/completeness.h"
#include "daemon/measure/drift_treatment.h"
#include "daemon/measure/points/point_solver.h"
#include "daemon/words/words.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {}  // namespace

Result<OnTheFlyRun> OnTheFlyRun::create(const Rig& rig, const PipelineOptions& options) {
  MDOF_TRY(algo::Solver solver, algo::Solver::create(rig, options.model));
  return OnTheFlyRun(rig, options, std::move(solver));
}

OnTheFlyRun::OnTheFlyRun(Rig rig, PipelineOptions options, algo::Solver solver)
    : rig_(std::move(rig)),
      options_(std::move(options)),
      calibrator_(rig_),
      aligner_(options_.align, probe_ids(rig_)),
      solver_(std::move(solver)),
      fly_(algo::TargetGrid(options_.on_the_fly.value_or(algo::OnTheFlyOptions()),
                            options_.sequence.targets_m),
           probe_ids(rig_), probe_ranges_m(rig_), options_.dwell.max_speed_m_s),
      corrections_(rig_),
      suspect_(options_.dwell.min_length_s / 2) {}

Status OnTheFlyRun::push(SampleBlock& raw) {
  lost_ += raw.lost;
  if (!begin_ns_ && raw.scans() > 0) begin_ns_ = raw.time_ns.front();
  temperature_.push(raw);
  suspect_.push(raw);
  corrections_.push(raw);
  MDOF_CHECK(calibrator_.apply(raw));
  MDOF_CHECK(aligner_.push(raw, frames_));
  MDOF_CHECK(fly_.push(frames_));
  frames_.time_ns.clear();
  return check_room();
}

Status OnTheFlyRun::check_room() {
  const auto& passes = fly_.passes();
  for (; passes_seen_ < passes.size(); ++passes_seen_)
    points_ += passes[passes_seen_].bins.size() + passes[passes_seen_].left_out.size();
  if (points_ <= options_.most_stops) return {};
  return bad_input(
      "a run on the fly may have at most " + std::to_string(options_.most_stops) + " points",
      Remedy::larger_interval);
}

// Unlike a stop, a bin has its place from each of its scans.
Status OnTheFlyRun::leave_suspect_out(algo::Sequence& sequence, Notices& notices) const {
  auto& points = sequence.points;
  const auto suspect = [this](const MeasuredPoint& p) { return suspect_.touches(p.point); };
  const auto first = std::find_if(points.begin(), points.end(), suspect);
  if (first == points.end()) return {};
  const double from_s = ns_to_s(first->point.begin_ns - *begin_ns_);
  const std::size_t left_out = std::erase_if(points, suspect);
  Notice found = suspect_.left_out(left_out, from_s);
  if (points.empty()) return bad_input(words::text(found));
  notices.push_back(std::move(found));
  return {};
}

void OnTheFlyRun::correct(algo::Sequence& sequence) const {
  std::vector<Point> points;
  for (const MeasuredPoint& p : sequence.points) points.push_back(p.point);
  corrections_.apply(solver_, points);
  for (std::size_t i = 0; i < points.size(); ++i) sequence.points[i].point = std::move(points[i]);
}

Status OnTheFlyRun::solve(algo::Sequence& sequence, const algo::Residuals& residuals) const {
  bool any = false;
  for (MeasuredPoint& p : sequence.points) {
    solve_point(solver_, rig_, residuals, p);
    any = any || p.errors.valid;
  }
  if (any) return {};
  return bad_input("none of the " + std::to_string(sequence.points.size()) +
                   " points on the fly could be solved: " + sequence.points.front().errors.reason);
}

void OnTheFlyRun::judge(const algo::Sequence& sequence, Run& run) const {
  const bool given = !options_.sequence.targets_m.empty();
  const algo::RunToJudge whole{rig_, sequence, fly_.summary(), lost_, given, 0};
  run.plausibility = algo::plausibility(whole);
  Notices& notices = run.header.notices;
  append(notices, algo::signal_notices(whole));
  append(notices, algo::visit_notices(whole));
  append(notices, algo::unit_notices(rig_, *run.plausibility));
  append(notices, algo::map_notices(rig_, solver_.fixture(), sequence.points));
  append(notices, fly_.notices());
}

Result<Run> OnTheFlyRun::finish() {
  aligner_.flush(frames_);
  MDOF_CHECK(fly_.push(frames_));
  fly_.flush();
  MDOF_CHECK(fly_.explain_nothing());
  algo::Sequence sequence = fly_.sequence();
  Run run;
  MDOF_CHECK(leave_suspect_out(sequence, run.header.notices));
  std::vector<Point> as_read;
  for (const MeasuredPoint& p : sequence.points) as_read.push_back(p.point);
  correct(sequence);
  const std::int64_t start_ns =
      sequence.points.empty() ? 0 : sequence.points.front().point.begin_ns;
  const algo::Residuals residuals(solver_, probe_ranges_m(rig_), rig_, start_ns);
  MDOF_CHECK(solve(sequence, residuals));
  run.header.axis = rig_.axis;
  run.header.sides = rig_.sides;
  run.header.stated = kAtFixture;
  run.header.scans = fly_.summary().scans;
  run.header.scans_lost = lost_;
  run.header.temperature = temperature_.of_run();
  Notices& notices = run.header.notices;
  const Notices statements = fly_.statements();
  notices.insert(notices.begin(), statements.begin(), statements.end());
  if (auto note = datum_note(options_.datum.kind, options_.datum.device); !note.empty())
    run.header.notes.push_back(std::move(note));
  for (auto& [probe, why] : aligner_.too_slow()) notices.push_back(std::move(why));
  judge(sequence, run);
  run.points = std::move(sequence.points);
  corrections_.report(solver_, as_read, run);
  if (auto contradiction = residuals.contradiction(run.points))
    notices.push_back(std::move(*contradiction));
  append(notices, algo::repeat_notices(rig_, run.points));
  treat_drift(rig_, options_.remove_drift, run);
  const auto missing = missing_notices(sequence.targets_m, options_.repeats, run.points);
  run.header.state = missing.empty() ? RunState::complete : RunState::partial;
  append(notices, missing);
  run.straightness = algo::straightness(rig_.moving(), run.points);
  run.angles = algo::angles(rig_.moving(), run.points);
  return run;
}

}  // namespace mdof::daemon
