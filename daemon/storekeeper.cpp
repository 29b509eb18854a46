#include "daemon/storekeeper.h"

#include <pthread.h>

#include <algorithm>

#include "daemon/paths.h"

namespace mdof::daemon {
namespace {

constexpr std::chrono::milliseconds kLongestPop{500};    // the watchdog wants to see the thread
constexpr std::chrono::milliseconds kBetweenLooks{200};  // at whether the files are still there
constexpr std::size_t kQueueLength = 4096;  // jobs: blocks of samples, points, calls of clients

store::RunEnd end_of(const Run& run) {
  store::RunEnd end;
  end.state = run.header.state;
  end.scans = run.header.scans;
  end.scans_lost = run.header.scans_lost;
  end.warnings = run.header.warnings;
  end.recording_sha256 = run.header.provenance.recording_sha256;
  end.straightness = run.straightness;
  end.angles = run.angles;
  end.plausibility = run.plausibility;
  end.temperature = run.header.temperature;
  return end;
}

// The end of a run that turned out otherwise: of use to nobody; `where` is what it turned out to
// be.
store::RunEnd provisional_of(store::RunEnd whole, const char* where) {
  whole.state = RunState::failed;
  whole.straightness.clear();
  whole.angles.clear();
  whole.plausibility.reset();
  whole.warnings.push_back(std::string("once all was known the points turned out otherwise; ") +
                           where);
  return whole;
}

// A foreign program holds the file: that passes.
template <class T>
bool is_busy(const Result<T>& done) {
  return !done && done.error().message.find("SQLITE_BUSY") != std::string::npos;
}

Result<store::Store> open_database(const Storekeeper::Options& options) {
  const store::StoreOptions how{options.durability, static_cast<int>(options.busy_timeout.count())};
  return store::Store::open(options.database, store::Access::read_write, how);
}

// A mdofd that is just ending still holds it for a while.
Result<store::Store> open_patiently(const Storekeeper::Options& options) {
  constexpr std::chrono::seconds kPatience{5};
  const auto end = std::chrono::steady_clock::now() + kPatience;
  for (;;) {
    auto opened = open_database(options);
    const bool held = !opened && opened.error().code == ErrorCode::conflict;
    if (!held || std::chrono::steady_clock::now() > end) return opened;
  }
}

}  // namespace

Result<std::unique_ptr<Storekeeper>> Storekeeper::start(const Options& options, Events events) {
  MDOF_TRY(auto database, open_patiently(options));
  return std::unique_ptr<Storekeeper>(
      new Storekeeper(std::move(database), options, std::move(events)));
}

Storekeeper::Storekeeper(store::Store database, const Options& options, Events events)
    : store_(std::move(database)),
      options_(options),
      events_(std::move(events)),
      database_(options.database),
      queue_(kQueueLength),
      last_turn_(std::chrono::steady_clock::now()),
      thread_([this] { work(); }) {}

Storekeeper::~Storekeeper() {
  queue_.close();
  thread_.join();
}

void Storekeeper::work() {
  pthread_setname_np(pthread_self(), "store");
  auto next_commit = std::chrono::steady_clock::now() + options_.commit_interval;
  while (!queue_.closed_and_empty()) {
    if (const auto job = queue_.pop(std::min(options_.commit_interval, kLongestPop))) (*job)();
    const auto now = std::chrono::steady_clock::now();
    last_turn_.store(now);
    if (now < next_commit) continue;
    commit_recordings();
    watch_files();
    store_what_waits();
    if (!unended_.empty()) end_what_can_be();
    next_commit = now + options_.commit_interval;
  }
  commit_recordings();
  store_what_waits();
  give_up_what_waits();
  end_what_can_be();
}

// One transaction a recording and interval: durable at the price of one disk flush.
void Storekeeper::commit_recordings() {
  for (auto& [run, recording] : recordings_) {
    const Status kept = commit(run, recording);
    if (!kept && !is_busy(kept)) events_.failed(run, kept.error());
  }
}

void Storekeeper::watch_files() {
  const auto now = std::chrono::steady_clock::now();
  if (now - files_watched_ < kBetweenLooks) return;
  files_watched_ = now;
  watch_database();
  for (auto& [run, recording] : recordings_) {
    const std::string lost = recording.file.fault();
    if (!lost.empty())
      events_.failed(run, Error{ErrorCode::io, lost + " while the run was being recorded"});
  }
}

void Storekeeper::watch_database() {
  std::string reason = database_.fault();
  if (!reason.empty())
    reason +=
        " under mdofd, so nothing can be stored: put it back, or restart mdofd to go on with "
        "what is there now";
  {
    const std::lock_guard guard(fault_mutex_);
    if (reason == fault_) return;
    fault_ = reason;
  }
  if (events_.database_changed) events_.database_changed(reason);
  if (reason.empty()) return;
  for (const auto& [run, recording] : recordings_)
    events_.failed(run, Error{ErrorCode::io, reason});
}

std::string Storekeeper::fault() const {
  const std::lock_guard guard(fault_mutex_);
  return fault_;
}

Status Storekeeper::commit(std::int64_t run, Recording& recording) {
  if (!recording.waiting) return {};
  MDOF_TRY(const std::int64_t seq, recording.writer.commit());
  recording.waiting = false;
  events_.recorded(run, seq);
  return {};
}

// The samples are on the disk before what is made of them.
Status Storekeeper::keep_points(std::int64_t run, const std::vector<MeasuredPoint>& points) {
  if (incomplete_.contains(run)) return io_error("an earlier point was not kept");
  const auto recording = recordings_.find(run);
  Status kept = recording == recordings_.end() ? Status() : commit(run, recording->second);
  if (kept) kept = store_.append_points(run, points);
  if (kept || is_busy(kept)) return kept;
  incomplete_.insert(run);
  events_.failed(run, kept.error());
  return kept;
}

// Runs whose end the disk refused: tried again until it takes it.
void Storekeeper::end_what_can_be() {
  std::erase_if(unended_, [&](Unended& waiting) {
    waiting.end.state = RunState::failed;
    return store_.end_run(waiting.run, waiting.end).has_value();
  });
}

bool Storekeeper::post(Job job) {
  return queue_.try_push([this, job = std::move(job)] { job(store_); });
}

Result<store::RecordingWriter> Storekeeper::create_recording(const NewRun& run) const {
  return store::RecordingWriter::create(run.recording, run.recording_header, options_.durability);
}

Result<std::int64_t> Storekeeper::begin(NewRun& run) {
  if (const std::string reason = fault(); !reason.empty()) return io_error(reason);
  if (run.recording.empty()) return store_.begin_run(run.header, run.deed);
  auto writer = run.begun ? std::move(*run.begun) : create_recording(run);
  if (!writer) return tl::unexpected(writer.error());
  auto id = store_.begin_run(run.header, run.deed);
  if (id) recordings_.emplace(*id, Recording{std::move(*writer), store::FileWatch(run.recording)});
  return id;
}

// Of a run that did not begin nothing is left.
Result<std::int64_t> Storekeeper::begin_or_clear(NewRun& run) {
  const bool made =
      !run.recording.empty() && (run.begun || !std::filesystem::exists(run.recording));
  auto id = begin(run);
  run.begun.reset();
  if (!id && made) store::RecordingWriter::remove(run.recording);
  return id;
}

bool Storekeeper::begin_run(NewRun run, std::function<void(Result<std::int64_t>)> done) {
  auto shared = std::make_shared<NewRun>(std::move(run));
  const bool posted =
      queue_.try_push([this, shared, done = std::move(done)] { done(begin_or_clear(*shared)); });
  if (posted || !shared->begun) return posted;
  shared->begun.reset();
  store::RecordingWriter::remove(shared->recording);
  return false;
}

bool Storekeeper::record(std::int64_t run, std::vector<SampleBlock> blocks, bool wait) {
  auto shared = std::make_shared<std::vector<SampleBlock>>(std::move(blocks));
  auto job = [this, run, shared] {
    const auto recording = recordings_.find(run);
    if (recording == recordings_.end()) return;  // it has failed or ended
    for (const SampleBlock& block : *shared) {
      const Status kept = recording->second.writer.append(block);
      if (!kept) events_.failed(run, kept.error());
    }
    recording->second.waiting = true;
  };
  return wait ? queue_.push(std::move(job)) : queue_.try_push(std::move(job));
}

void Storekeeper::append_points(std::int64_t run, std::vector<MeasuredPoint> points,
                                std::function<void(Status)> done) {
  auto shared = std::make_shared<Points>(Points{run, std::move(points), std::move(done)});
  queue_.push_always([this, shared] { take(std::move(*shared)); });
}

// In the order in which they came.
void Storekeeper::take(Points points) {
  const Status kept = waiting_points_.empty() ? keep_points(points.run, points.points)
                                              : Status(tl::unexpected(Error()));
  if (!waiting_points_.empty() || is_busy(kept))
    waiting_points_.push_back(std::move(points));
  else
    points.done(kept);
}

void Storekeeper::take(Ending ending) {
  seal(ending);
  auto ended = waiting_points_.empty() ? end(ending) : Result<std::int64_t>(0);
  if (!waiting_points_.empty() || is_busy(ended))
    waiting_ends_.push_back(std::move(ending));
  else
    ending.done(std::move(ended));
}

void Storekeeper::store_what_waits() {
  for (; !waiting_points_.empty(); waiting_points_.pop_front()) {
    const Points& next = waiting_points_.front();
    const Status kept = keep_points(next.run, next.points);
    if (is_busy(kept)) return;
    next.done(kept);
  }
  for (; !waiting_ends_.empty(); waiting_ends_.pop_front()) {
    auto ended = end(waiting_ends_.front());
    if (is_busy(ended)) return;
    waiting_ends_.front().done(std::move(ended));
  }
}

// mdofd ends: the runs stay without an end, as after a power cut, and their recordings have all.
void Storekeeper::give_up_what_waits() {
  const auto error = io_error(
      "mdofd ended while a foreign program held the database: the recording has the run, go on "
      "with it (mdof record --resume RUN) or replay it");
  for (const Points& points : waiting_points_) points.done(error);
  for (const Ending& ending : waiting_ends_) ending.done(error);
}

// Once: what the recording says of the run.
void Storekeeper::seal(Ending& ending) {
  RunHeader& header = ending.result.header;
  if (const auto recording = recordings_.find(ending.run); recording != recordings_.end()) {
    auto sealed = recording->second.writer.finish(utc_now());
    recordings_.erase(recording);
    if (!sealed) {
      header.state = RunState::failed;
      header.warnings.push_back(sealed.error().message);
    } else {
      header.provenance.recording_sha256 = *sealed;
    }
  }
}

Result<std::int64_t> Storekeeper::end(Ending& ending) {
  const std::int64_t run = ending.run;
  if (incomplete_.erase(run) > 0) ending.how.differs = !ending.result.points.empty();
  store::RunEnd whole = end_of(ending.result);
  whole.deed = ending.how.deed;
  if (!ending.how.differs) {
    MDOF_CHECK(end_or_wait(run, whole));
    return run;
  }
  auto superseded = store_.end_and_supersede(
      run, provisional_of(whole, "the run that supersedes this one has them"), ending.result);
  if (!superseded && !is_busy(superseded))
    unended_.push_back({run, provisional_of(whole, "the disk refused them: replay its recording")});
  return superseded;
}

// A refused end is not given up: it is tried again until the disk takes it.
Status Storekeeper::end_or_wait(std::int64_t run, const store::RunEnd& end) {
  Status ended = store_.end_run(run, end);
  if (!ended && !is_busy(ended)) unended_.push_back({run, end});
  return ended;
}

void Storekeeper::end_run(std::int64_t run, Run result, RunEnding how,
                          std::function<void(Result<std::int64_t>)> done) {
  auto shared =
      std::make_shared<Ending>(Ending{run, std::move(result), std::move(how), std::move(done)});
  queue_.push_always([this, shared] { take(std::move(*shared)); });
}

}  // namespace mdof::daemon
