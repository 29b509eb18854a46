#include "daemon/measure/replay/on_the_fly_run.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "algo/iso230/straightness.h"
#include "algo/model/restate.h"
#include "algo/plausibility/map_cover.h"
#include "algo/plausibility/plausibility.h"
#include "daemon/measure/completeness.h"
#include "daemon/measure/drift_treatment.h"

namespace mdof::daemon {
namespace {

std::vector<std::string> ids_of(const Rig& rig) {
  std::vector<std::string> ids;
  for (const Probe& probe : rig.probes) ids.push_back(probe.id);
  return ids;
}

std::vector<double> ranges_of(const Rig& rig) {
  std::vector<double> ranges_m;
  for (const Probe& probe : rig.probes) ranges_m.push_back(probe.range_m);
  return ranges_m;
}

template <class Texts>
void append(std::vector<std::string>& to, const Texts& texts) {
  to.insert(to.end(), texts.begin(), texts.end());
}

}  // namespace

Result<OnTheFlyRun> OnTheFlyRun::create(const Rig& rig, const PipelineOptions& options) {
  MDOF_TRY(algo::Solver solver, algo::Solver::create(rig, options.model));
  return OnTheFlyRun(rig, options, std::move(solver));
}

OnTheFlyRun::OnTheFlyRun(Rig rig, PipelineOptions options, algo::Solver solver)
    : rig_(std::move(rig)),
      options_(std::move(options)),
      calibrator_(rig_),
      aligner_(options_.align, ids_of(rig_)),
      solver_(std::move(solver)),
      fly_(algo::TargetGrid(options_.on_the_fly.value_or(algo::OnTheFlyOptions()),
                            options_.sequence.targets_m),
           ids_of(rig_), ranges_of(rig_), options_.dwell.max_speed_m_s),
      corrections_(rig_) {}

Status OnTheFlyRun::push(SampleBlock& raw) {
  lost_ += raw.lost;
  note_temperature(raw);
  corrections_.push(raw);
  MDOF_CHECK(calibrator_.apply(raw));
  MDOF_CHECK(aligner_.push(raw, frames_));
  Status taken = fly_.push(frames_);
  frames_.time_ns.clear();
  return taken;
}

void OnTheFlyRun::note_temperature(const SampleBlock& raw) {
  const auto found =
      std::find(raw.channels.begin(), raw.channels.end(), Channel{"temperature", Unit::deg_c});
  if (found == raw.channels.end()) return;
  for (const double read_C : raw.value[static_cast<std::size_t>(found - raw.channels.begin())]) {
    if (!std::isfinite(read_C)) continue;
    if (temperatures_++ == 0) temperature_ = Temperature{0, read_C, read_C};
    temperature_->mean_C += read_C;
    temperature_->min_C = std::min(temperature_->min_C, read_C);
    temperature_->max_C = std::max(temperature_->max_C, read_C);
  }
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
    const double travel_m = rig_.sides.target_travel_m(p.point.position_m);
    p.errors = solver_.solve(travel_m, p.point.probe_m, p.point.probe_u_m);
    residuals.test(p);
    p.errors =
        algo::restate(p.errors, options_.model, rig_.axis, travel_m, kAtCarriage, kAtFixture);
    any = any || p.errors.valid;
  }
  if (any) return {};
  return bad_input("none of " + std::to_string(sequence.points.size()) +
                   " points on the fly could be solved: " + sequence.points.front().errors.reason);
}

void OnTheFlyRun::judge(const algo::Sequence& sequence, Run& run) const {
  const bool given = !options_.sequence.targets_m.empty();
  const algo::RunToJudge whole{rig_, sequence, fly_.summary(), lost_, given, 0};
  run.plausibility = algo::plausibility(whole);
  auto& warnings = run.header.warnings;
  append(warnings, algo::warnings_of_signals(whole));
  append(warnings, algo::warnings_of_visits(whole, *run.plausibility));
  append(warnings, algo::warnings_of_units(rig_, *run.plausibility));
  append(warnings, algo::warnings_of_maps(rig_, solver_.fixture(), sequence.points));
  append(warnings, fly_.warnings());
}

Result<Run> OnTheFlyRun::finish() {
  aligner_.flush(frames_);
  MDOF_CHECK(fly_.push(frames_));
  fly_.flush();
  MDOF_CHECK(fly_.explain_nothing());
  algo::Sequence sequence = fly_.sequence();
  std::vector<Point> as_read;
  for (const MeasuredPoint& p : sequence.points) as_read.push_back(p.point);
  correct(sequence);
  const algo::Residuals residuals(solver_, ranges_of(rig_), rig_.sides);
  MDOF_CHECK(solve(sequence, residuals));
  Run run;
  run.header.axis = rig_.axis;
  run.header.sides = rig_.sides;
  run.header.stated = kAtFixture;
  run.header.scans = fly_.summary().scans;
  run.header.scans_lost = lost_;
  run.header.temperature = temperature_;
  if (temperature_) run.header.temperature->mean_C /= static_cast<double>(temperatures_);
  append(run.header.warnings, fly_.statements());  // which are stored, as notes are not
  if (auto note = datum_note(options_.datum.kind, options_.datum.device); !note.empty())
    run.header.notes.push_back(std::move(note));
  for (auto& [probe, why] : aligner_.too_slow()) run.header.warnings.push_back(std::move(why));
  judge(sequence, run);
  run.points = std::move(sequence.points);
  corrections_.tell(solver_, as_read, run);
  if (const auto contradiction = residuals.warning(run.points))
    run.header.warnings.push_back(*contradiction);
  treat_drift(rig_, options_.remove_drift, run);
  const auto missing = what_is_missing(sequence.targets_m, options_.repeats, run.points);
  run.header.state = missing.empty() ? RunState::complete : RunState::partial;
  append(run.header.warnings, missing);
  run.straightness = algo::straightness(rig_.moving(), run.points);
  run.angles = algo::angles(rig_.moving(), run.points);
  return run;
}

}  // namespace mdof::daemon
