#include "daemon/measure/replay/on_the_fly_run.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "daemon/measure/points/point_solver.h"
#include "daemon/words/words.h"
#include "schema/units.h"

namespace mdof::daemon {

Result<OnTheFlyRun> OnTheFlyRun::create(const Rig& rig, const PipelineOptions& options) {
  MDOF_TRY(algo::Solver solver, algo::Solver::create(rig, options.model));
  return OnTheFlyRun(rig, options, std::move(solver));
}

OnTheFlyRun::OnTheFlyRun(Rig rig, PipelineOptions options, algo::Solver solver)
    : RunBuilder(std::move(rig), std::move(options), std::move(solver)),
      fly_(algo::TargetGrid(options_.on_the_fly.value_or(algo::OnTheFlyOptions()),
                            options_.sequence.targets_m),
           probe_ids(rig_), probe_ranges_m(rig_), options_.dwell.max_speed_m_s) {}

Status OnTheFlyRun::push(SampleBlock& raw) {
  if (!begin_ns_ && raw.scans() > 0) begin_ns_ = raw.time_ns.front();
  MDOF_CHECK(take(raw));
  MDOF_CHECK(fly_.push(frames_));
  frames_.time_ns.clear();
  return check_room();
}

Status OnTheFlyRun::check_room() {
  const auto& passes = fly_.passes();
  for (; passes_seen_ < passes.size(); ++passes_seen_)
    points_ += passes[passes_seen_].bins.size() + passes[passes_seen_].left_out.size();
  if (points_ <= options_.max_stops) return {};
  return bad_input("a run that is measured on the fly may have at most " +
                       std::to_string(options_.max_stops) + " points",
                   Remedy::larger_interval);
}

// Each scan in a bin contributes to the position of the bin. A point is therefore removed if the
// encoder was suspect at any time during the bin.
Status OnTheFlyRun::remove_suspect_points(algo::Sequence& sequence, Notices& notices) const {
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
  return bad_input(
      "none of the " + std::to_string(sequence.points.size()) +
      " points that were measured on the fly has error values; reason of the first point: " +
      sequence.points.front().errors.reason);
}

Result<Run> OnTheFlyRun::finish() {
  aligner_.flush(frames_);
  MDOF_CHECK(fly_.push(frames_));
  fly_.flush();
  MDOF_CHECK(fly_.check_has_points());
  algo::Sequence sequence = fly_.sequence();
  Notices first = fly_.statements();
  MDOF_CHECK(remove_suspect_points(sequence, first));
  std::vector<Point> as_read;
  for (const MeasuredPoint& p : sequence.points) as_read.push_back(p.point);
  correct(sequence);
  const std::int64_t start_ns =
      sequence.points.empty() ? 0 : sequence.points.front().point.begin_ns;
  const algo::Residuals residuals(solver_, probe_ranges_m(rig_), rig_, start_ns);
  MDOF_CHECK(solve(sequence, residuals));
  std::vector<double> targets_m = sequence.targets_m;
  return build({.sequence = std::move(sequence),
                .as_read = as_read,
                .summary = fly_.summary(),
                .residuals = residuals,
                .targets_m = std::move(targets_m),
                .first = std::move(first),
                .notices_after_signals = fly_.notices()});
}

}  // namespace mdof::daemon
