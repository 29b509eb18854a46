#include "daemon/pipeline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "algo/chi_square.h"
#include "algo/straightness.h"
#include "schema/json_writer.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

std::vector<std::string> probe_ids(const Rig& rig) {
  std::vector<std::string> ids;
  for (const auto& probe : rig.probes) ids.push_back(probe.id);
  return ids;
}

std::vector<double> probe_ranges(const Rig& rig) {
  std::vector<double> ranges;
  for (const auto& probe : rig.probes) ranges.push_back(probe.range_m);
  return ranges;
}

// The last instant of `frames`, into `newest`.
void keep_last(const FrameBlock& frames, FrameBlock& newest) {
  const std::size_t last = frames.size() - 1;
  newest.time_ns.assign(1, frames.time_ns[last]);
  newest.encoder_m.assign(1, frames.encoder_m[last]);
  newest.probe_m.resize(frames.probe_m.size());
  newest.probe_quality.resize(frames.probe_m.size());
  for (std::size_t k = 0; k < frames.probe_m.size(); ++k) {
    newest.probe_m[k].assign(1, frames.probe_m[k][last]);
    newest.probe_quality[k].assign(1, frames.quality_at(k, last));
  }
}

// Why a probe is missing, before what follows from it.
std::string by_cause(const Point& point) {
  constexpr std::string_view kFrozen = "frozen:";
  for (const std::string& flag : point.flags) {
    if (flag.starts_with(kFrozen))
      return "probe " + flag.substr(kFrozen.size()) + " no longer changes: ";
  }
  return "";
}

std::string number(const char* format, double x) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), format, x);
  return text.data();
}

}  // namespace

std::string PipelineOptions::json() const {
  JsonWriter json;
  json.begin_object().field("model", to_string(model));
  json.key("align")
      .begin_object()
      .field("lag_bound_s", align.lag_bound_s)
      .field("max_gap_s", align.max_gap_s)
      .end_object();
  json.key("dwell").raw(dwell.json());
  json.key("targets_mm").begin_array();
  for (const double t : sequence.targets_m) json.value(to_mm(t));
  json.end_array()
      .field("target_window_mm", to_mm(sequence.target_window_m))
      .field("repeats", repeats)
      .end_object();
  return json.take();
}

Result<Pipeline> Pipeline::create(const Rig& rig, const PipelineOptions& options) {
  MDOF_TRY(algo::Solver solver, algo::Solver::create(rig, options.model));
  return Pipeline(rig, options, std::move(solver));
}

Pipeline::Pipeline(Rig rig, PipelineOptions options, algo::Solver solver)
    : rig_(std::move(rig)),
      options_(std::move(options)),
      calibrator_(rig_),
      aligner_(options_.align, probe_ids(rig_)),
      dwell_(options_.dwell, probe_ids(rig_), probe_ranges(rig_)),
      solver_(std::move(solver)) {}

Status Pipeline::push(SampleBlock& raw) {
  lost_ += raw.lost;
  note_break(raw);
  MDOF_CHECK(calibrator_.apply(raw));
  MDOF_CHECK(aligner_.push(raw, frames_));
  if (frames_.size() == 0) return {};
  keep_last(frames_, newest_);
  dwell_.push(frames_, found_);
  if (!options_.keep_points) found_.clear();
  frames_.time_ns.clear();
  return {};
}

void Pipeline::note_break(const SampleBlock& raw) {
  const auto is_encoder = [](const Channel& channel) { return channel.id == kEncoderChannel; };
  if (raw.scans() == 0 || std::none_of(raw.channels.begin(), raw.channels.end(), is_encoder))
    return;
  const auto unseen_ns = static_cast<std::int64_t>(options_.dwell.window_s * 1e9);
  if (raw.lost > 0 && encoder_ns_ && raw.time_ns.front() - *encoder_ns_ > unseen_ns)
    dwell_.break_after(*encoder_ns_);
  encoder_ns_ = raw.time_ns.back();
}

const std::vector<MeasuredPoint>& Pipeline::points() {
  if (taken_ != found_.size()) take_points();
  return sequence_.points;
}

// The sequence is simply recognised and solved anew, but only when somebody asks: a replay of a
// long log asks once.
void Pipeline::take_points() {
  taken_ = found_.size();
  dwell_.mark(found_);
  sequence_ = algo::recognise_sequence(found_, options_.sequence);
  const algo::Residuals residuals(solver_, probe_ranges(rig_));
  for (auto& p : sequence_.points) {
    p.errors = solver_.solve(p.point.position_m, p.point.probe_m, p.point.probe_u_m);
    if (!p.errors.valid) p.errors.reason = by_cause(p.point) + p.errors.reason;
    residuals.test(p);
  }
}

bool Pipeline::moved() const {
  const auto& s = dwell_.summary();
  return s.encoder_max_m - s.encoder_min_m >= options_.dwell.approach_m;
}

Status Pipeline::explain_nothing() const {
  const auto& s = dwell_.summary();
  if (s.scans == 0) return bad_input("no samples of the rig's probes and the encoder came");
  if (!moved()) {
    const double travel_m = s.encoder_max_m - s.encoder_min_m;
    return bad_input("the encoder stays at " + number("%.4f mm", to_mm(s.encoder_min_m)) +
                     " (within " + number("%.3g um", to_um(travel_m)) +
                     "): the axis did not move or encoder_mm is not its position; check the "
                     "encoder's channel and unit");
  }
  if (!found_.empty()) {
    return bad_input("none of the " + std::to_string(found_.size()) +
                     " stops is near a given target; check targets_mm");
  }
  return bad_input("no dwell found in " + std::to_string(s.scans) + " scans from " +
                   number("%.3f", to_mm(s.encoder_min_m)) + " to " +
                   number("%.3f mm", to_mm(s.encoder_max_m)) + ": the longest stop was " +
                   number("%.3f s", s.longest_still_s) + " within " +
                   number("%.3g um", to_um(s.tolerance_m)) + ", needed are " +
                   number("%.3f s", options_.dwell.settle_s + options_.dwell.min_length_s) +
                   "; dwell longer, or change --settle-s, --min-length-s or --tolerance-um");
}

Status Pipeline::reject_dead_probes() const {
  const bool solved = std::any_of(sequence_.points.begin(), sequence_.points.end(),
                                  [](const MeasuredPoint& p) { return p.errors.valid; });
  if (solved) return {};  // by the other probes
  for (std::size_t k = 0; k < rig_.probes.size(); ++k) {
    const bool dead = std::all_of(found_.begin(), found_.end(),
                                  [&](const Point& p) { return std::isnan(p.probe_m[k]); });
    if (!dead) continue;
    const auto& flags = found_.front().flags;
    const std::string& id = rig_.probes[k].id;
    if (std::find(flags.begin(), flags.end(), "frozen:" + id) != flags.end())
      return bad_input("probe \"" + id +
                       "\" reads the same in every scan while the others change; check its cable, "
                       "amplifier and channel");
    const bool saturated = std::find(flags.begin(), flags.end(), "saturated:" + id) != flags.end();
    return bad_input(saturated ? "probe \"" + id + "\" is at the end of its range (" +
                                     number("%g um", to_um(rig_.probes[k].range_m)) +
                                     ") in every dwell: shim it into range, or correct range_um, "
                                     "offset_um or reads in the rig"
                               : "probe \"" + id +
                                     "\" gave no usable value in any dwell; check its cable "
                                     "and channel");
  }
  return {};
}

Result<Run> Pipeline::finish() {
  aligner_.flush(frames_);
  dwell_.push(frames_, found_);
  frames_.time_ns.clear();
  dwell_.flush(found_);
  take_points();
  if (sequence_.points.empty() || !moved()) MDOF_CHECK(explain_nothing());
  MDOF_CHECK(reject_dead_probes());
  Run run;
  run.header.axis = rig_.axis;
  run.header.state = RunState::complete;
  run.header.scans = dwell_.summary().scans;
  run.header.scans_lost = lost_;
  run.header.warnings = sequence_.warnings;
  run.points = sequence_.points;
  auto more = dwell_.warnings(found_);
  const algo::Residuals residuals(solver_, probe_ranges(rig_));
  if (const auto contradiction = residuals.warning(run.points)) more.push_back(*contradiction);
  run.header.warnings.insert(run.header.warnings.end(), more.begin(), more.end());
  run.straightness = algo::straightness(rig_.axis, run.points);
  run.angles = algo::angles(rig_.axis, run.points);
  return run;
}

}  // namespace mdof::daemon
