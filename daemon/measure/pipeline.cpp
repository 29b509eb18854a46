#include "daemon/measure/pipeline.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "algo/model/moving_body.h"
#include "algo/model/restate.h"
#include "algo/plausibility/plausibility.h"
#include "algo/points/flags.h"
#include "daemon/measure/points/point_solver.h"
#include "daemon/words/words.h"
#include "schema/base/number/number_text.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

// Below this number of stops, each new stop restarts the recognition of the whole sequence.
constexpr std::size_t kFullRecognitionLimit = 256;

// Copies the last frame of `frames` into `newest`.
void copy_last_instant(const FrameBlock& frames, FrameBlock& newest) {
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

// If the times of a log are in minutes or hours, its sample rate seems to be high, and its stops
// seem to be short.
std::string time_unit_hint(double period_s) {
  // Above the usual 1 kHz, and below 1.2 kHz: a log with 20 Hz whose times are in minutes.
  constexpr double kFast_hz = 1'100;
  if (!(period_s > 0 && 1 / period_s > kFast_hz)) return "";
  return "; the sample rate is " + plain_number(1 / period_s) +
         " Hz: if time_s of the log is in minutes or hours, convert it to s";
}

}  // namespace

Result<Pipeline> Pipeline::create(const Rig& rig, const PipelineOptions& options) {
  MDOF_TRY(algo::Solver solver, algo::Solver::create(rig, options.model));
  return Pipeline(rig, options, std::move(solver));
}

Pipeline::Pipeline(Rig rig, PipelineOptions options, algo::Solver solver)
    : RunBuilder(std::move(rig), std::move(options), std::move(solver)),
      dwell_(options_.dwell, probe_ids(rig_), probe_ranges_m(rig_)),
      newest_quality_(rig_.probes.size() + 1, Quality::missing) {}

Status Pipeline::push(SampleBlock& raw) {
  note_scan_loss(raw);
  MDOF_CHECK(calibrate(raw));
  note_quality(raw);
  MDOF_CHECK(align(raw));
  if (frames_.size() == 0) return {};
  copy_last_instant(frames_, newest_);
  if (watcher_) watcher_(frames_);
  find_stops();
  if (!options_.keep_points) found_.clear();
  return {};
}

void Pipeline::note_quality(const SampleBlock& calibrated) {
  if (calibrated.scans() == 0) return;
  const std::size_t last = calibrated.scans() - 1;
  for (std::size_t c = 0; c < calibrated.channels.size(); ++c) {
    const std::string& id = calibrated.channels[c].id;
    const auto probe = std::find_if(rig_.probes.begin(), rig_.probes.end(),
                                    [&](const Probe& p) { return p.id == id; });
    if (probe == rig_.probes.end() && id != kEncoderChannel) continue;
    // The index of the encoder is the number of probes.
    newest_quality_[static_cast<std::size_t>(probe - rig_.probes.begin())] =
        std::isnan(calibrated.value[c][last]) ? Quality::missing : calibrated.quality_at(c, last);
  }
}

std::vector<algo::FrozenProbe> Pipeline::frozen_now() const {
  // The detector ignores scans without a position, so the newest reading is compared, too.
  auto frozen = dwell_.frozen_probes();
  std::erase_if(frozen, [this](const algo::FrozenProbe& f) {
    return f.end_ns != INT64_MAX || newest_.probe_m[f.probe][0] != f.value_m;
  });
  return frozen;
}

void Pipeline::find_stops() {
  dwell_.push(frames_, found_);
  frames_.time_ns.clear();
  drop_excess_stops();
}

void Pipeline::drop_excess_stops() {
  if (found_.size() <= options_.max_stops) return;
  excess_stops_ += found_.size() - options_.max_stops;
  found_.resize(options_.max_stops);
}

Notice Pipeline::excess_stops_notice() const {
  return notice(NoticeCode::stops_over_limit, "",
                {{"stops", found_.size()}, {"left_out", excess_stops_}});
}

Notice Pipeline::not_placed() const {
  const auto first = std::find_if(found_.begin(), found_.end(),
                                  [this](const Point& stop) { return suspect_.covers(stop); });
  return suspect_.left_out(stops_without_position_, ns_to_s(first->begin_ns - *begin_ns_));
}

void Pipeline::note_scan_loss(const SampleBlock& raw) {
  const auto is_encoder = [](const Channel& channel) { return channel.id == kEncoderChannel; };
  if (raw.scans() == 0 || std::none_of(raw.channels.begin(), raw.channels.end(), is_encoder))
    return;
  if (!begin_ns_) begin_ns_ = raw.time_ns.front();
  const auto unseen_ns = static_cast<std::int64_t>(options_.dwell.window_s * 1e9);
  if (raw.lost > 0 && encoder_ns_ && raw.time_ns.front() - *encoder_ns_ > unseen_ns)
    dwell_.break_after(*encoder_ns_);
  encoder_ns_ = raw.time_ns.back();
}

const std::vector<MeasuredPoint>& Pipeline::points() {
  if (taken_ == found_.size()) return sequence_.points;
  if (tail_ && found_.size() < next_full_recognition_) {
    take_new_points();
  } else {
    take_points();
    next_full_recognition_ = found_.size() + found_.size() / 4;
    if (found_.size() >= kFullRecognitionLimit) tail_.emplace(sequence_, options_.sequence);
  }
  return sequence_.points;
}

// The residuals calculate drift from the time of the first stop.
algo::Residuals Pipeline::residuals() const {
  return {solver_, probe_ranges_m(rig_), rig_, found_.empty() ? 0 : found_.front().begin_ns};
}

// Sorts and solves only the new points of a long run. The whole sequence is recognised again when
// the number of stops has increased by a quarter, and at the end.
void Pipeline::take_new_points() {
  const algo::Residuals residuals = this->residuals();
  std::vector<Point> fresh(found_.begin() + static_cast<std::ptrdiff_t>(taken_), found_.end());
  dwell_.mark(fresh);
  std::copy(fresh.begin(), fresh.end(), found_.begin() + static_cast<std::ptrdiff_t>(taken_));
  corrections_.apply(solver_, fresh);
  for (Point& stop : fresh) {
    ++taken_;
    if (suspect_.covers(stop)) {
      ++stops_without_position_;
      continue;
    }
    for (std::size_t i = tail_->append(std::move(stop), sequence_); i < sequence_.points.size();
         ++i)
      solve_point(solver_, rig_, residuals, sequence_.points[i]);
  }
}

// Recognises and solves the whole sequence. This takes long for a long log, so a replay calls this
// function only once.
void Pipeline::take_points() {
  taken_ = found_.size();
  dwell_.mark(found_);
  std::vector<Point> placed;
  std::copy_if(found_.begin(), found_.end(), std::back_inserter(placed),
               [this](const Point& stop) { return !suspect_.covers(stop); });
  stops_without_position_ = found_.size() - placed.size();
  corrections_.apply(solver_, placed);
  sequence_ = algo::recognise_sequence(placed, options_.sequence);
  const algo::Residuals residuals = this->residuals();
  for (auto& p : sequence_.points) solve_point(solver_, rig_, residuals, p);
}

AxisErrors Pipeline::solve_at(double encoder_m, const std::vector<double>& readings_m,
                              const std::vector<double>& u_m) const {
  const double travel_m = rig_.sides.target_travel_m(encoder_m);
  const AxisErrors of_target = solver_.solve(travel_m, readings_m, u_m);
  return algo::restate(algo::errors_of_moving_body(of_target, options_.model, rig_.moving()),
                       options_.model, rig_.moving(), travel_m, kAtCarriage, kAtFixture);
}

bool Pipeline::moved() const {
  const auto& s = dwell_.summary();
  return s.encoder_max_m - s.encoder_min_m >= options_.dwell.approach_m;
}

Status Pipeline::check_has_points() const {
  const auto& s = dwell_.summary();
  if (s.scans == 0 && s.unplaced > 0)
    return bad_input(
        "none of " + std::to_string(s.unplaced) +
        " scans has an encoder position; check the encoder, its cable and its channel");
  if (s.scans == 0)
    return bad_input(
        "no samples arrived from the rig's probes and the encoder; check the devices, or the "
        "columns of the log");
  if (!moved()) {
    const double travel_m = s.encoder_max_m - s.encoder_min_m;
    return bad_input("the encoder stays at " + plain_number(to_mm(s.encoder_min_m), 7) + " mm" +
                     " (within " + plain_number(to_um(travel_m)) + " um" +
                     "): the axis did not move, or encoder_mm is not the axis position; check the "
                     "channel and the unit of the encoder");
  }
  if (stops_without_position_ > 0 && stops_without_position_ == found_.size())
    return bad_input(words::text(not_placed()));
  const auto problem = algo::encoder_unit_notice(s.encoder_max_m - s.encoder_min_m);
  if (!found_.empty()) {
    return bad_input("none of the " + std::to_string(found_.size()) +
                     " stops is near a given target; check targets_mm");
  }
  return bad_input("no stop found in " + std::to_string(s.scans) + " scans from " +
                       plain_number(to_mm(s.encoder_min_m), 6) + " to " +
                       plain_number(to_mm(s.encoder_max_m), 6) + " mm" + ": " +
                       dwell_.why_no_stop() + (problem ? "; " + words::text(*problem) : "") +
                       time_unit_hint(s.period_s),
                   dwell_.crept() ? Remedy::move_faster : Remedy::stop_longer,
                   plain_number(to_um(s.tolerance_m)));
}

// Adds a notice for each probe without values. Error: a probe has no values, and no point could be
// solved.
Status Pipeline::check_dead_probes(Notices& notices) const {
  const bool needed = std::none_of(sequence_.points.begin(), sequence_.points.end(),
                                   [](const MeasuredPoint& p) { return p.errors.valid; });
  const auto too_slow = aligner_.too_slow();
  for (std::size_t k = 0; k < rig_.probes.size(); ++k) {
    const bool dead = std::all_of(found_.begin(), found_.end(),
                                  [&](const Point& p) { return std::isnan(p.probe_m[k]); });
    if (!dead) continue;
    const std::string& id = rig_.probes[k].id;
    if (const auto slow = too_slow.find(id); slow != too_slow.end()) {
      if (needed) return bad_input(words::text(slow->second));
      continue;  // RunBuilder::build() adds the notice of each slow channel
    }
    const bool frozen = algo::has_flag(found_.front(), Flag::frozen, id);
    const bool saturated = algo::has_flag(found_.front(), Flag::saturated, id);
    Notice why = frozen      ? notice(NoticeCode::probe_constant, id)
                 : saturated ? notice(NoticeCode::probe_saturated, id,
                                      {{"range_um", to_um(rig_.probes[k].range_m)}})
                             : notice(NoticeCode::probe_dead, id);
    if (needed) return bad_input(words::text(why));
    // The run gets the notice probe_beyond_range already.
    if (why.code != NoticeCode::probe_saturated) notices.push_back(std::move(why));
  }
  return {};
}

// An axis that moves all the time reverses at the ends of its travel. The axis can rest at an end
// so long that mdof recognises a stop.
std::optional<Notice> Pipeline::never_stops() const {
  const auto& targets_m = sequence_.targets_m;
  if (!options_.sequence.targets_m.empty() || targets_m.size() > 2) return std::nullopt;
  double rest_time_s = 0;
  for (const Point& stop : found_)
    rest_time_s += ns_to_s(stop.end_ns - stop.begin_ns) + options_.dwell.settle_s;
  const auto& s = dwell_.summary();
  const double moved_s = static_cast<double>(s.scans) * s.period_s - rest_time_s;
  if (moved_s <= rest_time_s) return std::nullopt;
  const std::string stops_mm =
      plain_number(to_mm(targets_m.front())) +
      (targets_m.size() > 1 ? " and " + plain_number(to_mm(targets_m.back())) : "");
  return notice(
      NoticeCode::axis_never_stops, "",
      {{"moving_percent", 100 * moved_s / (moved_s + rest_time_s)}, {"stops_mm", stops_mm}});
}

Result<Run> Pipeline::finish() {
  aligner_.flush(frames_);
  find_stops();
  dwell_.flush(found_);
  drop_excess_stops();
  take_points();
  if (sequence_.points.empty() || !moved()) MDOF_CHECK(check_has_points());
  Notices first;
  MDOF_CHECK(check_dead_probes(first));
  append(first, sequence_.notices);
  if (stops_without_position_ > 0) first.push_back(not_placed());
  if (is_full()) first.push_back(excess_stops_notice());
  Notices partial;
  if (auto why = never_stops()) partial.push_back(std::move(*why));
  const algo::Residuals residuals = this->residuals();
  return build({.sequence = sequence_,
                .as_read = found_,
                .summary = dwell_.summary(),
                .residuals = residuals,
                .targets_m = options_.sequence.targets_m,
                .first = std::move(first),
                .of_points = dwell_.notices(found_),
                .partial = std::move(partial)});
}

}  // namespace mdof::daemon
