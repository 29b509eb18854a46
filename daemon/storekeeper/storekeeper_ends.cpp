// Functions of Storekeeper that store points and ends of runs. If another program locks the
// database, the points and ends are stored later.
#include <algorithm>

#include "daemon/paths.h"
#include "daemon/storekeeper/storage_errors.h"
#include "daemon/storekeeper/storekeeper.h"
#include "daemon/words/error_text.h"

namespace mdof::daemon {
namespace {

constexpr const char* kHeld =
    ": another program locks the database with a transaction that does not end. The measured "
    "points are in memory and in the recording, but not yet in the database. End that program";

std::string too_many(std::size_t most) {
  return "; more than " + std::to_string(most) +
         " points are pending; further points are stored when their run ends";
}

store::RunEnd end_of(const Run& run) {
  store::RunEnd end;
  end.state = run.header.state;
  end.scans = run.header.scans;
  end.scans_lost = run.header.scans_lost;
  end.notices = run.header.notices;
  end.recording_sha256 = run.header.provenance.recording_sha256;
  end.straightness = run.straightness;
  end.angles = run.angles;
  end.plausibility = run.plausibility;
  end.temperature = run.header.temperature;
  return end;
}

// The end of a run whose points differ from the result. `why`: notice that states which run
// contains the result, or why it is not stored.
store::RunEnd renumbered_run_end(store::RunEnd whole, NoticeCode why) {
  whole.state = RunState::failed;
  whole.straightness.clear();
  whole.angles.clear();
  whole.plausibility.reset();
  whole.notices.push_back(notice(why));
  return whole;
}

// The end of a run with a notice. The client has received an error for this end.
store::RunEnd with_rejection_notice(store::RunEnd whole, const Error& error) {
  std::string reason = words::text(error);
  if (reason.ends_with('.')) reason.pop_back();  // the text of the notice continues
  whole.notices.push_back(notice(NoticeCode::end_refused, "", {{"reason", reason}}));
  return whole;
}

}  // namespace

// Stores the ends that the disk rejected before. If the disk rejects an end again, the end stays
// pending.
void Storekeeper::end_finished_runs() {
  std::erase_if(unended_, [&](Unended& waiting) {
    waiting.end.state = RunState::failed;
    if (!store_->end_run(waiting.run, waiting.end)) return false;
    explain(waiting.run, "");
    return true;
  });
}

// Points are stored in the order in which they arrive.
void Storekeeper::take(Points points) {
  if (overflowed_.contains(points.run)) return drop(points);
  if (waiting_points_.empty()) {
    const Status kept = keep_points(points.run, points.points);
    if (!is_busy(kept)) return points.done(kept);
  }
  wait_for_database(std::move(points));
}

void Storekeeper::take(Ending ending) {
  seal(ending);
  auto ended = waiting_points_.empty() ? end(ending) : Result<std::int64_t>(0);
  if (!waiting_points_.empty() || is_busy(ended))
    wait_for_database(std::move(ending));
  else
    ending.done(std::move(ended));
}

void Storekeeper::wait_for_database(Points points) {
  const std::size_t count = waiting_count_ + points.points.size();
  if (count > options_.max_pending_points) {
    set(held_, options_.database.string() + kHeld + too_many(options_.max_pending_points));
    return drop(points);
  }
  if (waiting_points_.empty()) set(held_, options_.database.string() + kHeld);
  waiting_count_ = count;
  waiting_points_.push_back(std::move(points));
}

// Drops these points. take() then drops all later points of the run, too, because the points of a
// run must be stored in order.
void Storekeeper::drop(const Points& points) {
  overflowed_[points.run] += points.points.size();
  dropped_points_ += points.points.size();
  points.done(io_error("this point is not stored yet" + too_many(options_.max_pending_points)));
}

// Returns the number of dropped points and removes it. Called once, at the end of the run.
std::size_t Storekeeper::take_dropped_count(std::int64_t run) {
  std::size_t dropped = 0;
  for (auto* runs : {&incomplete_, &overflowed_}) {
    const auto found = runs->find(run);
    if (found == runs->end()) continue;
    dropped += found->second;
    runs->erase(found);
  }
  return dropped;
}

void Storekeeper::wait_for_database(Ending ending) {
  set(held_, options_.database.string() + kHeld);
  explain(ending.run,
          "the end of the run is not stored yet: " + options_.database.string() + kHeld);
  waiting_ends_.push_back(std::move(ending));
}

// Sets the reason for still_open_reason(). An empty `why` removes it.
void Storekeeper::explain(std::int64_t run, const std::string& why) {
  const std::lock_guard guard(fault_mutex_);
  if (why.empty())
    open_reasons_.erase(run);
  else
    open_reasons_[run] = why;
}

void Storekeeper::keep_rejected_end(Unended unended, const Error& error) {
  note_full(error);
  explain(unended.run, "the end of the run is not stored yet: " + words::text(error));
  unended_.push_back(std::move(unended));
}

// Without this pause, the thread would only wait for the database and would not record samples.
void Storekeeper::try_later() {
  next_try_ = std::chrono::steady_clock::now() + options_.busy_timeout;
}

void Storekeeper::store_waiting_items() {
  for (; !waiting_points_.empty(); waiting_points_.pop_front()) {
    const Points& next = waiting_points_.front();
    const Status kept = keep_points(next.run, next.points);
    if (is_busy(kept)) return try_later();
    waiting_count_ -= next.points.size();
    next.done(kept);
  }
  for (; !waiting_ends_.empty(); waiting_ends_.pop_front()) {
    auto ended = end(waiting_ends_.front());
    if (is_busy(ended)) return try_later();
    explain(waiting_ends_.front().run, ended ? "" : words::text(ended.error()));
    waiting_ends_.front().done(std::move(ended));
  }
  set(held_, "");
}

// Called when mdofd ends. The ends of these runs are not stored, as after a power failure. The
// recordings of the runs are complete.
void Storekeeper::discard_waiting_items() {
  const auto error = io_error(
      "mdofd ended while another program locked the database; the samples of the run are in the "
      "recording",
      Remedy::resume_or_replay);
  for (const Points& points : waiting_points_) points.done(error);
  for (const Ending& ending : waiting_ends_) ending.done(error);
}

// Seals the recording and adds the hash of the recording to the result. If the recording cannot be
// sealed, the state of the run is "failed". A second call does nothing.
void Storekeeper::seal(Ending& ending) {
  RunHeader& header = ending.result.header;
  if (const auto recording = recordings_.find(ending.run); recording != recordings_.end()) {
    auto sealed = recording->second.writer.finish(utc_now());
    recordings_.erase(recording);
    if (!sealed) {
      header.state = RunState::failed;
      // The run may have ended because of the same error.
      const Notice failure =
          notice(NoticeCode::failure, "", {{"words", words::text(sealed.error())}});
      auto& all = header.notices;
      if (std::find(all.begin(), all.end(), failure) == all.end()) all.push_back(failure);
    } else {
      header.provenance.recording_sha256 = *sealed;
    }
  }
}

Result<std::int64_t> Storekeeper::end(Ending& ending) {
  const std::int64_t run = ending.run;
  if (const std::size_t dropped = take_dropped_count(run); dropped > 0) {
    ending.dropped = dropped;
    ending.how.differs = !ending.result.points.empty();
  }
  store::RunEnd whole = end_of(ending.result);
  whole.action = ending.how.action;
  if (!ending.how.differs) {
    whole.uncertainty = ending.how.uncertainty;
    MDOF_CHECK(end_or_wait(run, whole));
    return run;
  }
  if (ending.dropped > 0)
    whole.notices.push_back(
        notice(NoticeCode::points_not_stored, "", {{"points", ending.dropped}}));
  auto superseded = store_->end_and_supersede(
      run, renumbered_run_end(whole, NoticeCode::superseded_by_renumbering), ending.result,
      ending.how.uncertainty);
  if (!superseded && !is_busy(superseded))
    keep_rejected_end({run, renumbered_run_end(whole, NoticeCode::renumbering_refused)},
                      superseded.error());
  return superseded;
}

// Stores the end of a run. If the disk rejects the end, end_finished_runs() tries again.
Status Storekeeper::end_or_wait(std::int64_t run, const store::RunEnd& end) {
  Status ended = store_->end_run(run, end);
  if (!ended && !is_busy(ended))
    keep_rejected_end({run, with_rejection_notice(end, ended.error())}, ended.error());
  return ended;
}

}  // namespace mdof::daemon
