#include "daemon/measure/pipeline.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "algo/iso230/straightness.h"
#include "algo/model/restate.h"
#include "algo/plausibility/map_cover.h"
#include "algo/plausibility/plausibility.h"
#include "algo/plausibility/visit_step.h"
#include "algo/points/flags.h"
#include "daemon/measure/completeness.h"
#include "daemon/measure/drift_treatment.h"
#include "daemon/measure/points/point_solver.h"
#include "daemon/words/words.h"
#include "schema/base/json_writer.h"
#include "schema/base/number/number_text.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

constexpr std::size_t kAlwaysWhole = 256;  // stops; fewer are recognised anew with each

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

void write_by_channel(JsonWriter& json, const char* key,
                      const std::map<std::string, double>& numbers) {
  if (numbers.empty()) return;
  json.key(key).begin_object();
  for (const auto& [channel, x] : numbers) json.field(channel, x);
  json.end_object();
}

// In mm; up to a kilometre to the picometre, so that it is the same once read again.
double offset_mm(const EncoderDatum& datum) {
  const double whole_mm = to_mm(datum.offset_m);
  return std::abs(whole_mm) < 1e6 ? std::round(whole_mm * 1e9) / 1e9 : whole_mm;
}

// An encoder that knows its positions by itself has no datum to write.
void write_datum(JsonWriter& json, const EncoderDatum& datum) {
  if (datum == EncoderDatum()) return;
  json.key("encoder_datum")
      .begin_object()
      .field("kind", to_string(datum.kind))
      .field("offset_mm", offset_mm(datum))
      .field("device", datum.device);
  if (!datum.utc.empty() || !datum.by.empty()) json.field("utc", datum.utc).field("by", datum.by);
  json.end_object();
}

}  // namespace

std::string PipelineOptions::json() const {
  JsonWriter json;
  json.begin_object().field("model", to_string(model));
  json.key("align")
      .begin_object()
      .field("lag_bound_s", align.lag_bound_s)
      .field("max_gap_s", align.max_gap_s);
  write_by_channel(json, "interval_s", align.interval_s);
  write_by_channel(json, "delay_s", align.delay_s);
  json.end_object();
  json.key("dwell").raw(dwell.json());
  json.key("targets_mm").begin_array();
  for (const double t : sequence.targets_m) json.value(to_mm(t));
  json.end_array()
      .field("target_window_mm", to_mm(sequence.target_window_m))
      .field("repeats", repeats);
  if (remove_drift) json.field("remove_drift", true);
  if (on_the_fly) json.key("on_the_fly").raw(on_the_fly->json());
  write_datum(json, datum);
  json.end_object();
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
      dwell_(options_.dwell, probe_ids(rig_), probe_ranges_m(rig_)),
      solver_(std::move(solver)),
      corrections_(rig_),
      suspect_(options_.dwell.min_length_s / 2) {}

Status Pipeline::push(SampleBlock& raw) {
  lost_ += raw.lost;
  note_break(raw);
  suspect_.push(raw);
  temperature_.push(raw);
  corrections_.push(raw);
  MDOF_CHECK(calibrator_.apply(raw));
  MDOF_CHECK(aligner_.push(raw, frames_));
  if (frames_.size() == 0) return {};
  keep_last(frames_, newest_);
  find_stops();
  if (!options_.keep_points) found_.clear();
  return {};
}

void Pipeline::find_stops() {
  dwell_.push(frames_, found_);
  frames_.time_ns.clear();
  leave_out_beyond();
}

void Pipeline::leave_out_beyond() {
  if (found_.size() <= options_.most_stops) return;
  beyond_ += found_.size() - options_.most_stops;
  found_.resize(options_.most_stops);
}

Notice Pipeline::beyond_limit() const {
  return notice(NoticeCode::stops_over_limit, "",
                {{"stops", found_.size()}, {"left_out", beyond_}});
}

Notice Pipeline::not_placed() const {
  const auto first = std::find_if(found_.begin(), found_.end(),
                                  [this](const Point& stop) { return suspect_.covers(stop); });
  return suspect_.left_out(unplaced_, ns_to_s(first->begin_ns - *begin_ns_));
}

void Pipeline::note_break(const SampleBlock& raw) {
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
  if (tail_ && found_.size() < whole_at_) {
    take_new_points();
  } else {
    take_points();
    whole_at_ = found_.size() + found_.size() / 4;
    if (found_.size() >= kAlwaysWhole) tail_.emplace(sequence_, options_.sequence);
  }
  return sequence_.points;
}

// Drift counts from the first stop.
algo::Residuals Pipeline::residuals() const {
  return {solver_, probe_ranges_m(rig_), rig_, found_.empty() ? 0 : found_.front().begin_ns};
}

// A long run grows by one point at a time: only the new point is put in its place and solved. The
// whole sequence is recognised again whenever it has grown by a quarter, and at the end.
void Pipeline::take_new_points() {
  const algo::Residuals residuals = this->residuals();
  std::vector<Point> fresh(found_.begin() + static_cast<std::ptrdiff_t>(taken_), found_.end());
  dwell_.mark(fresh);
  std::copy(fresh.begin(), fresh.end(), found_.begin() + static_cast<std::ptrdiff_t>(taken_));
  corrections_.apply(solver_, fresh);
  for (Point& stop : fresh) {
    ++taken_;
    if (suspect_.covers(stop)) {
      ++unplaced_;
      continue;
    }
    for (std::size_t i = tail_->append(std::move(stop), sequence_); i < sequence_.points.size();
         ++i)
      solve_point(solver_, rig_, residuals, sequence_.points[i]);
  }
}

// The sequence is simply recognised and solved anew, but only when somebody asks: a replay of a
// long log asks once.
void Pipeline::take_points() {
  taken_ = found_.size();
  dwell_.mark(found_);
  std::vector<Point> placed;
  std::copy_if(found_.begin(), found_.end(), std::back_inserter(placed),
               [this](const Point& stop) { return !suspect_.covers(stop); });
  unplaced_ = found_.size() - placed.size();
  corrections_.apply(solver_, placed);
  sequence_ = algo::recognise_sequence(placed, options_.sequence);
  const algo::Residuals residuals = this->residuals();
  for (auto& p : sequence_.points) solve_point(solver_, rig_, residuals, p);
}

AxisErrors Pipeline::solve_at(double encoder_m, const std::vector<double>& readings_m,
                              const std::vector<double>& u_m) const {
  const double travel_m = rig_.sides.target_travel_m(encoder_m);
  return algo::restate(solver_.solve(travel_m, readings_m, u_m), options_.model, rig_.axis,
                       travel_m, kAtCarriage, kAtFixture);
}

bool Pipeline::moved() const {
  const auto& s = dwell_.summary();
  return s.encoder_max_m - s.encoder_min_m >= options_.dwell.approach_m;
}

Status Pipeline::explain_nothing() const {
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
                     "encoder's channel and unit");
  }
  if (unplaced_ > 0 && unplaced_ == found_.size()) return bad_input(words::text(not_placed()));
  const auto problem = algo::encoder_unit_notice(s.encoder_max_m - s.encoder_min_m);
  if (!found_.empty()) {
    return bad_input("none of the " + std::to_string(found_.size()) +
                     " stops is near a given target; check targets_mm");
  }
  return bad_input("no stop found in " + std::to_string(s.scans) + " scans from " +
                       plain_number(to_mm(s.encoder_min_m), 6) + " to " +
                       plain_number(to_mm(s.encoder_max_m), 6) + " mm" +
                       ": the axis was at rest for at most " + plain_number(s.longest_still_s) +
                       " s" + " within " + plain_number(to_um(s.tolerance_m)) + " um" +
                       ", but a stop must last " + plain_number(options_.dwell.shortest_s()) +
                       " s" + (problem ? "; " + words::text(*problem) : ""),
                   Remedy::stop_longer);
}

// A probe without a value is an error where the others are too few to do without it.
Status Pipeline::judge_dead_probes(Notices& notices) const {
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
      continue;  // reported with the others
    }
    const bool frozen = algo::has_flag(found_.front(), Flag::frozen, id);
    const bool saturated = algo::has_flag(found_.front(), Flag::saturated, id);
    Notice why = frozen      ? notice(NoticeCode::probe_constant, id)
                 : saturated ? notice(NoticeCode::probe_saturated, id,
                                      {{"range_um", to_um(rig_.probes[k].range_m)}})
                             : notice(NoticeCode::probe_dead, id);
    if (needed) return bad_input(words::text(why));
    notices.push_back(std::move(why));
  }
  return {};
}

// An axis that moves all the time turns at the ends of its travel, and stands there long enough to
// be taken for a stop.
std::optional<Notice> Pipeline::never_stops() const {
  const auto& targets_m = sequence_.targets_m;
  if (!options_.sequence.targets_m.empty() || targets_m.size() > 2) return std::nullopt;
  double stood_s = 0;
  for (const Point& stop : found_)
    stood_s += ns_to_s(stop.end_ns - stop.begin_ns) + options_.dwell.settle_s;
  const auto& s = dwell_.summary();
  const double moved_s = static_cast<double>(s.scans) * s.period_s - stood_s;
  if (moved_s <= stood_s) return std::nullopt;
  const std::string stops_mm =
      plain_number(to_mm(targets_m.front())) +
      (targets_m.size() > 1 ? " and " + plain_number(to_mm(targets_m.back())) : "");
  return notice(NoticeCode::axis_never_stops, "",
                {{"moving_percent", 100 * moved_s / (moved_s + stood_s)}, {"stops_mm", stops_mm}});
}

// Complete is what has all that was asked for.
void Pipeline::judge(Run& run) const {
  Notices missing = missing_notices(options_.sequence.targets_m, options_.repeats, run.points);
  if (auto why = never_stops()) missing.push_back(std::move(*why));
  run.header.state = missing.empty() ? RunState::complete : RunState::partial;
  append(run.header.notices, std::move(missing));
}

// What the run looks like as a whole, and what of it is doubtful.
void Pipeline::add_plausibility(Run& run) const {
  const auto& dwell = options_.dwell;
  const algo::RunToJudge whole{rig_,
                               sequence_,
                               dwell_.summary(),
                               lost_,
                               !options_.sequence.targets_m.empty(),
                               dwell.shortest_s()};
  run.plausibility = algo::plausibility(whole);
  Notices& notices = run.header.notices;
  append(notices, algo::signal_notices(whole));
  append(notices, algo::visit_notices(whole));
  append(notices, algo::unit_notices(rig_, *run.plausibility));
  append(notices, algo::map_notices(rig_, solver_.fixture(), sequence_.points));
}

Result<Run> Pipeline::finish() {
  aligner_.flush(frames_);
  find_stops();
  dwell_.flush(found_);
  leave_out_beyond();
  take_points();
  if (sequence_.points.empty() || !moved()) MDOF_CHECK(explain_nothing());
  Run run;
  MDOF_CHECK(judge_dead_probes(run.header.notices));
  run.header.axis = rig_.axis;
  run.header.sides = rig_.sides;
  run.header.stated = kAtFixture;
  run.header.scans = dwell_.summary().scans;
  run.header.scans_lost = lost_;
  run.header.temperature = temperature_.of_run();
  if (auto note = datum_note(options_.datum.kind, options_.datum.device); !note.empty())
    run.header.notes.push_back(std::move(note));
  Notices& notices = run.header.notices;
  append(notices, sequence_.notices);
  if (unplaced_ > 0) notices.push_back(not_placed());
  if (is_full()) notices.push_back(beyond_limit());
  for (auto& [probe, why] : aligner_.too_slow()) notices.push_back(std::move(why));
  add_plausibility(run);
  run.points = sequence_.points;
  corrections_.report(solver_, found_, run);
  append(notices, dwell_.notices(found_));
  if (auto contradiction = residuals().contradiction(run.points))
    notices.push_back(std::move(*contradiction));
  append(notices, algo::repeat_notices(rig_, run.points));
  treat_drift(rig_, options_.remove_drift, run);
  judge(run);
  run.straightness = algo::straightness(rig_.moving(), run.points);
  run.angles = algo::angles(rig_.moving(), run.points);
  return run;
}

}  // namespace mdof::daemon
