// The functions of the thread "measure-X" of a station. The thread calculates points from samples.

#include <algorithm>
#include <deque>

#include "algo/points/flags.h"
#include "daemon/measure/budgets.h"
#include "daemon/measure/completeness.h"
#include "daemon/paths.h"
#include "daemon/station/live_json.h"
#include "daemon/station/open_run.h"
#include "daemon/station/run_events.h"
#include "daemon/station/station.h"
#include "daemon/store/result_hash.h"
#include "daemon/words/error_text.h"
#include "daemon/words/words.h"
#include "drivers/calibration.h"
#include "drivers/clock/monotonic.h"
#include "schema/base/thread_start.h"
#include "schema/rig/calibrated.h"
#include "schema/rig/check/rig_check.h"
#include "schema/run_json.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

Notices failure(const std::string& why) {
  if (why.empty()) return {};
  return {notice(NoticeCode::failure, "", {{"words", why}})};
}

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kPopTimeout{100};
constexpr milliseconds kRecordInterval{50};  // each call of record() wakes the thread of the store

PipelineOptions without_points(PipelineOptions options) {
  options.keep_points = false;
  return options;
}

// Whether the points that were sent to the store are bit-identical with the points of the result.
bool same_points(const std::vector<MeasuredPoint>& stored,
                 const std::vector<MeasuredPoint>& result) {
  store::ResultHash a, b;
  for (const auto& p : stored) a.add(p);
  for (const auto& p : result) b.add(p);
  return a.hex() == b.hex();
}

// Whether the approach of this point is only assumed. The next motion of the axis shows the
// approach; until then, the point is not stored.
bool approach_assumed(const MeasuredPoint& p) {
  return algo::has_flag(p.point, Flag::approach_assumed);
}

// Whether the result begins with the stored points. The result can contain further points.
bool begins_with(const std::vector<MeasuredPoint>& result,
                 const std::vector<MeasuredPoint>& stored) {
  if (result.size() < stored.size()) return false;
  const auto n = static_cast<std::ptrdiff_t>(stored.size());
  return same_points(stored, {result.begin(), result.begin() + n});
}

}  // namespace

void Station::measure() {
  start_thread_as(std::string("measure-") + letter(config_.rig.axis));
  std::deque<Item> items;
  while (!shared_->queue.closed_and_empty()) {
    measure_turn_ = steady_clock::now();
    shared_->queue.pop_all(items, kPopTimeout);
    for (Item& item : items) {
      std::visit([this](auto& what) { handle(what); }, item);
      measure_turn_ = steady_clock::now();
    }
    note_newest();
    show_live();  // after all available samples; if no samples arrive, the view shows them as stale
    record_if_due();
  }
  if (open_) finish(RunState::aborted, {notice(NoticeCode::daemon_stopped)});
}

void Station::handle(Samples& samples) {
  if (!is_this_pass(samples.pass)) return;
  take_samples(samples.block);
  shared_->spare.put(std::move(samples.block));
}

// A replay is read once for each run. The queue can contain samples of an earlier pass through the
// log; these samples do not belong to this run.
bool Station::is_this_pass(std::uint64_t pass) const {
  return config_.live() || pass == acquisitions_.front()->pass();
}

void Station::source_ended(std::uint64_t pass, const std::string& reason,
                           const drivers::SourceInfo& source) {
  if (!open_ || !is_this_pass(pass)) return;
  finish(reason.empty() ? RunState::complete : RunState::failed, failure(reason), source);
}

void Station::take_trouble(const Trouble& trouble) {
  if (trouble.kind == Trouble::Kind::suspect) zero_.lose(trouble.device);
  if (open_) open_->troubles.add(trouble);
}

void Station::storage_ended(std::int64_t run, const std::string& reason) {
  if (open_ && open_->id == run) finish(RunState::failed, failure(reason));
}

void Station::end_run(bool abort, const HistoryEntry& action, const RunDone& done) {
  if (!open_) return done(fail(ErrorCode::not_found, "the run has just ended"));
  if (abort) return finish(RunState::aborted, {notice(NoticeCode::aborted)}, {}, done, action);
  finish(RunState::complete, {}, {}, done, action);
}

void Station::attach(std::int64_t run, const RunRequest& request, const Options& options,
                     Beginning* beginning, const RunDone& done) {
  std::optional<Continuation> continues;
  auto pipeline =
      beginning ? std::move(beginning->pipeline) : Pipeline::create(config_.rig, *options);
  if (!pipeline) {  // hardly possible: the rig was checked at the start; only the targets are new
    shared_->run = 0;
    return done(tl::unexpected(pipeline.error()));
  }
  if (beginning) continues.emplace(beginning->end_ns);
  open_ = std::make_unique<OpenRun>(
      OpenRun{run, request, std::move(*pipeline), {}, std::move(continues), {}, {}, 0});
  watch_range(open_->pipeline);
  open_->datum = options->datum;
  open_->model = options->model;
  if (beginning) open_->left_out_ns = beginning->end_ns;  // the old run has reported its stops
  zero_.begins(run);
  shared_->run = run;
  shared_->events.run_event(started_message(run, config_.rig.axis));
  done(run);
  if (!config_.live()) acquisitions_.front()->start();
  // The encoder may have passed its reference mark after the check in start_run().
  end_unless_from_mark();
}

void Station::take_samples(SampleBlock& block) {
  if (config_.live()) zero_.apply(block);
  if (!open_) {
    if (!view_) {
      auto view = Pipeline::create(config_.rig, without_points(with_devices(options_)));
      if (!view) return;  // not possible: the rig was checked at the start
      view_.emplace(std::move(*view));
      watch_range(*view_);
    }
    // After an error, the live view starts again with the next block.
    if (!view_->push(block)) view_.reset();
    return;
  }
  view_.reset();
  if (open_->continues) open_->continues->shift(block);
  if (config_.recorded()) open_->unrecorded.add(block);
  if (const Status pushed = open_->pipeline.push(block); !pushed) {
    return finish(RunState::failed, failure(words::text(pushed.error())));
  }
  const auto& points = open_->pipeline.points();
  const std::size_t before = open_->stored.size();
  if (!points.empty() && !approach_assumed(points.back())) keep_new_points(points);
  report_left_out();
  if (open_->pipeline.is_full()) return finish(RunState::complete, {});
  const RunRequest& asked = open_->request;
  const std::size_t all = 2 * asked.targets_m.size() * static_cast<std::size_t>(asked.repeats);
  if (open_->stored.size() == before || open_->stored.size() < all) return;
  if (all_measured(asked.targets_m, asked.repeats, open_->stored)) finish(RunState::complete, {});
}

void Station::record_if_due() {
  const auto now = steady_clock::now();
  if (!open_ || now - open_->recorded < kRecordInterval) return;
  open_->recorded = now;
  record();
}

void Station::record() {
  if (open_->unrecorded.empty()) return;
  std::vector<SampleBlock> blocks = open_->unrecorded.take();
  const std::size_t count = blocks.size();
  const bool kept = keeper_.record(open_->id, std::move(blocks), !config_.live());
  if (!kept) open_->blocks_not_recorded += count;
}

void Station::report_unsolved(const std::vector<MeasuredPoint>& points) {
  const auto solved = [](const MeasuredPoint& p) { return p.errors.valid; };
  if (std::all_of(points.begin(), points.end(), solved)) return;
  ChannelsByDevice channels;
  for (const auto& device : devices())
    for (const auto& channel : device.info.channels)
      channels[device.info.name].push_back(channel.id);
  for (const auto& point : points) {
    const auto trouble = unsolved(point, config_.rig, channels, utc_now());
    if (!trouble) continue;
    open_->troubles.add(*trouble);
    shared_->events.trouble(config_.rig.axis, open_->id, *trouble);
  }
}

// Clients wait for the next point. Reports to the clients why a stop did not become a point.
void Station::report_left_out() {
  for (const StopLeftOut& stop : open_->pipeline.left_out()) {
    if (stop.reason != to_string(NoticeCode::stop_near_no_target)) continue;
    if (open_->left_out_ns && stop.begin_ns <= *open_->left_out_ns) continue;
    open_->left_out_ns = stop.begin_ns;
    shared_->events.run_event(left_out_message(open_->id, config_.rig.axis, stop.position_m));
  }
}

// Sends new points to the store. The samples of these points are sent before.
void Station::keep_new_points(const std::vector<MeasuredPoint>& points) {
  const std::size_t first = open_->stored.size();
  if (points.size() <= first) return;
  record();
  std::vector<MeasuredPoint> fresh(points.begin() + static_cast<std::ptrdiff_t>(first),
                                   points.end());
  open_->stored.insert(open_->stored.end(), fresh.begin(), fresh.end());
  report_unsolved(fresh);
  const std::int64_t run = open_->id;
  auto messages = points_messages(run, config_.rig, open_->model, open_->stored, first);
  std::string progress = progress_message(run, config_.rig.axis, open_->request, open_->stored);
  // Clients receive the points when the points are on the disk.
  keeper_.append_points(run, std::move(fresh),
                        [shared = shared_, messages = std::move(messages),
                         progress = std::move(progress)](const Status& kept) {
                          if (!kept) return;
                          for (const auto& json : messages) shared->events.run_event(json);
                          shared->events.run_event(progress);
                        });
}

void Station::finish(RunState state, Notices why, const drivers::SourceInfo& source, RunDone done,
                     const std::optional<HistoryEntry>& action) {
  if (!config_.live())
    acquisitions_.front()->request_stop();  // later samples would have the pass number of this run
  auto result = open_->pipeline.finish();
  // The last stop becomes a point only when the pipeline is finished.
  record();
  if (result && begins_with(result->points, open_->stored)) keep_new_points(result->points);
  const std::unique_ptr<OpenRun> open = std::move(open_);
  Run run;
  if (result) {
    run = std::move(*result);
  } else {
    append(run.header.notices, failure(words::text(result.error())));
    if (state == RunState::complete) state = RunState::failed;
  }
  // If `state` is complete, the state of the result is kept: complete or partial.
  if (state != RunState::complete) run.header.state = state;
  Notices& notices = run.header.notices;
  if (run.header.state == RunState::partial && config_.recorded())
    notices.push_back(notice(NoticeCode::run_can_go_on));
  run.header.provenance.recording_sha256 = source.sha256;
  append(notices, source.notices);
  append(notices, open->request.notices);
  append(notices, open->troubles.summary());
  append(notices, overdue_calibrations(config_.rig, utc_now()));
  append(notices, calibration_notices(config_.rig));
  for (const auto& device : devices())
    append(notices, drivers::unused_scales(config_.rig, device.info.channels));
  append(notices, unusual_values(config_.rig));
  append(notices, std::move(why));
  if (open->blocks_not_recorded > 0)
    notices.push_back(
        notice(NoticeCode::blocks_not_recorded, "", {{"blocks", open->blocks_not_recorded}}));
  const bool differs = result && !same_points(open->stored, run.points);
  const std::int64_t id = open->id;
  const Axis axis = config_.rig.axis;
  const RunState became = run.header.state;
  std::optional<RunUncertainty> uncertainty;
  if (result) uncertainty = uncertainty_of(run);
  keeper_.end_run(id, std::move(run), {differs, action, std::move(uncertainty)},
                  [shared = shared_, id, axis, became,
                   done = std::move(done)](const Result<std::int64_t>& stored) {
                    shared->run = 0;
                    shared->events.run_event(ended_message(stored ? *stored : id, axis,
                                                           stored ? became : RunState::failed));
                    if (done) done(stored);
                  });
}

const Pipeline* Station::pipeline() const {
  return open_ ? &open_->pipeline : view_ ? &*view_ : nullptr;
}

// Called also without a live view, so that the first live message states the correct age.
void Station::note_newest() {
  const Pipeline* from = pipeline();
  if (!from || from->newest().size() == 0 || from->newest().time_ns[0] == newest_ns_) return;
  newest_ns_ = from->newest().time_ns[0];
  newest_since_ = steady_clock::now();
}

// Age of the newest readings. If a device is silent, readings of the others arrive late (see
// AlignOptions::lag_bound_s), so the times of the readings count, too. The times in a log are not
// times of the computer's clock.
double Station::age_s(steady_clock::time_point now) const {
  const double since_arrival_s = std::chrono::duration<double>(now - newest_since_).count();
  if (!config_.live()) return since_arrival_s;
  return std::max(since_arrival_s, ns_to_s(drivers::monotonic_ns() - newest_ns_));
}

std::vector<std::string> Station::present_troubles() const {
  std::vector<std::string> lines;
  for (const auto& device : devices())
    for (const auto& trouble : device.standing) lines.push_back(trouble_line(trouble));
  for (const auto& frozen : pipeline()->frozen_now())
    lines.push_back(
        words::text(notice(NoticeCode::probe_constant, config_.rig.probes[frozen.probe].id)));
  return lines;
}

void Station::watch_range(Pipeline& pipeline) {
  pipeline.watch([this](const FrameBlock& frames) { recent_.add(frames); });
}

void Station::show_live() {
  const Pipeline* from = pipeline();
  const milliseconds every = live_every_.load();
  if (every == kNever || !from || from->newest().size() == 0) return;
  const auto now = steady_clock::now();
  if (now - last_live_ < every) return;
  last_live_ = now;
  const double age = age_s(now);
  const LiveState state{config_.simulated(), age > options_.stale_s, age, open_ ? open_->id : 0,
                        present_troubles()};
  shared_->events.live(live_json(config_.rig, *from, recent_, state));
}

}  // namespace mdof::daemon
