#include "daemon/measure/points/run_builder.h"

#include <algorithm>
#include <utility>

#include "algo/iso230/straightness.h"
#include "algo/plausibility/calibrated_stretch.h"
#include "algo/plausibility/coarse_targets.h"
#include "algo/plausibility/map_cover.h"
#include "algo/plausibility/visit_step.h"
#include "daemon/measure/completeness.h"
#include "daemon/measure/drift_treatment.h"
#include "daemon/measure/points/point_solver.h"
#include "schema/units.h"

namespace mdof::daemon {

RunBuilder::RunBuilder(Rig rig, PipelineOptions options, algo::Solver solver)
    : rig_(std::move(rig)),
      options_(std::move(options)),
      calibrator_(rig_),
      aligner_(options_.align, probe_ids(rig_)),
      solver_(std::move(solver)),
      corrections_(rig_),
      suspect_(options_.dwell.min_length_s / 2) {}

Status RunBuilder::take(SampleBlock& raw) {
  MDOF_CHECK(calibrate(raw));
  return align(raw);
}

Status RunBuilder::calibrate(SampleBlock& raw) {
  lost_ += raw.lost;
  suspect_.push(raw);
  temperature_.push(raw);
  corrections_.push(raw);
  if (raw.scans() > 0) {
    begin_ns_ = begin_ns_ ? std::min(*begin_ns_, raw.time_ns.front()) : raw.time_ns.front();
    end_ns_ = std::max(end_ns_, raw.time_ns.back());
  }
  return calibrator_.apply(raw);
}

RunHeader RunBuilder::head(const algo::DwellDetector::Summary& summary) const {
  RunHeader header;
  header.axis = rig_.axis;
  header.sides = rig_.sides;
  header.stated = kAtFixture;
  header.scans = summary.scans;
  header.scans_lost = lost_;
  header.temperature = temperature_.of_run();
  header.notices = datum_notices(options_.datum);
  if (auto left_out = temperature_.left_out()) header.notices.push_back(std::move(*left_out));
  return header;
}

// Calculates the plausibility of the whole run, and adds the notices about the plausibility.
void RunBuilder::add_plausibility(const SolvedPoints& points, Run& run) const {
  const bool given = !options_.sequence.targets_m.empty();
  const algo::RunToJudge whole{rig_, points.sequence, points.summary, lost_, given};
  run.plausibility = algo::plausibility(whole);
  if (begin_ns_) run.plausibility->duration_s = ns_to_s(end_ns_ - *begin_ns_);
  Notices& notices = run.header.notices;
  append(notices, algo::signal_notices(whole));
  append(notices, algo::visit_notices(whole));
  append(notices, algo::unit_notices(rig_, *run.plausibility));
  append(notices, algo::map_notices(rig_, solver_.fixture(), points.sequence.points));
  append(notices, algo::calibrated_range_notices(rig_, points.sequence.points));
}

Run RunBuilder::build(SolvedPoints points) const {
  Run run;
  run.header = head(points.summary);
  Notices& notices = run.header.notices;
  append(notices, std::move(points.first));
  for (auto& [probe, why] : aligner_.too_slow()) notices.push_back(why);
  add_plausibility(points, run);
  append(notices, std::move(points.notices_after_signals));
  run.points = std::move(points.sequence.points);
  corrections_.report(solver_, points.as_read, run);
  append(notices, std::move(points.of_points));
  if (auto contradiction = points.residuals.contradiction(run.points))
    notices.push_back(std::move(*contradiction));
  append(notices, algo::repeat_notices(rig_, run.points));
  treat_drift(rig_, options_.remove_drift, run);
  append(notices, algo::coarse_target_notices(rig_, run));
  // A run is complete if no requested point is missing.
  Notices missing = missing_notices(points.targets_m, options_.repeats, run.points);
  append(missing, std::move(points.partial));
  run.header.state = missing.empty() ? RunState::complete : RunState::partial;
  append(notices, std::move(missing));
  run.straightness = algo::straightness(rig_.moving(), run.points);
  run.angles = algo::angles(rig_.moving(), run.points);
  return run;
}

}  // namespace mdof::daemon
