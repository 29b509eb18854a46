#include "daemon/storekeeper/storekeeper.h"

#include <sys/statvfs.h>

#include <algorithm>
#include <future>

#include "daemon/store/file/announced_head.h"
#include "daemon/storekeeper/storage_errors.h"
#include "daemon/words/error_text.h"
#include "schema/base/thread_start.h"

namespace mdof::daemon {
namespace {

// Longest wait for a job. The thread must report to the watchdog in time (App checks this).
constexpr std::chrono::milliseconds kLongestPop{500};
constexpr std::chrono::milliseconds kFileCheckInterval{200};
constexpr std::chrono::seconds kOpenRetryInterval{1};
// Largest number of pending jobs: blocks of samples, points, calls of clients.
constexpr std::size_t kQueueLength = 4096;

Result<store::Store> open_database(const Storekeeper::Options& options) {
  const store::StoreOptions how{options.durability, static_cast<int>(options.busy_timeout.count())};
  return store::Store::open(options.database, store::Access::read_write, how);
}

bool has_room(const std::filesystem::path& file) {
  constexpr std::uint64_t kLeastBytes = 1u << 20;
  struct statvfs disk {};
  if (::statvfs(file.c_str(), &disk) != 0) return false;
  return (disk.f_flag & ST_RDONLY) == 0 &&
         std::uint64_t{disk.f_bavail} * disk.f_frsize > kLeastBytes;
}

std::string another_locks(const Storekeeper::Options& options, const char* consequence) {
  const std::string file = options.database.string();
  return file + ": another program locks the database (SQLITE_BUSY)" + consequence +
         "; end that program (to find it, use: fuser " + file + ")";
}

StorageState not_writable(const Storekeeper::Options& options, const Error& error) {
  const bool held = is_busy(error);
  return {held ? "held" : "full",
          (held ? another_locks(options, "") : words::text(error)) +
              "; mdofd serves the active tables and tries again to open the database; until the "
              "database is open, mdofd stores nothing"};
}

// Whether the database can be read, although it cannot be opened for writing.
bool is_only_readable(const Storekeeper::Options& options, const Error& why) {
  if (why.code != ErrorCode::io) return false;
  const store::StoreOptions how{options.durability, static_cast<int>(options.busy_timeout.count())};
  return store::Store::open(options.database, store::Access::read_only, how).has_value();
}

// The error if the database cannot be read. mdofd must not start: if it reported that no table is
// active, a controller would stop its corrections.
Error not_readable(const Storekeeper::Options& options, Error why) {
  if (!is_busy(why)) return why;
  return {ErrorCode::io,
          another_locks(options, ", so mdofd cannot read the active tables and does not start")};
}

// Tries for five seconds, because an mdofd that is ending can lock the database for a short time.
Result<store::Store> open_with_retries(const Storekeeper::Options& options) {
  constexpr std::chrono::seconds kPatience{5};
  const auto end = std::chrono::steady_clock::now() + kPatience;
  for (;;) {
    auto opened = open_database(options);
    const bool held = is_busy(opened) || (!opened && opened.error().code == ErrorCode::conflict);
    if (!held || std::chrono::steady_clock::now() > end) return opened;
  }
}

}  // namespace

Result<std::unique_ptr<Storekeeper>> Storekeeper::start(const Options& options, Events events) {
  auto database = open_with_retries(options);
  if (!database && !is_only_readable(options, database.error()))
    return tl::unexpected(not_readable(options, std::move(database.error())));
  std::unique_ptr<Storekeeper> keeper(new Storekeeper(options, std::move(events)));
  if (database)
    keeper->store_.emplace(std::move(*database));
  else
    keeper->unopened_ = not_writable(options, database.error());
  keeper->begin_chain();
  keeper->check_database();
  keeper->announce_head();
  keeper->thread_ = std::thread([k = keeper.get()] { k->work(); });
  return keeper;
}

Storekeeper::Storekeeper(const Options& options, Events events)
    : options_(options),
      events_(std::move(events)),
      database_(options.database),
      queue_(kQueueLength),
      last_turn_(std::chrono::steady_clock::now()) {}

Storekeeper::~Storekeeper() {
  queue_.close();
  if (thread_.joinable()) thread_.join();
}

void Storekeeper::work() {
  start_thread_as("store");
  auto next_commit = std::chrono::steady_clock::now() + options_.commit_interval;
  while (!queue_.closed_and_empty()) {
    if (const auto job = queue_.pop(std::min(options_.commit_interval, kLongestPop))) (*job)();
    announce_head();
    const auto now = std::chrono::steady_clock::now();
    last_turn_.store(now);
    if (now < next_commit) continue;
    commit_recordings();
    check_storage_if_due();
    if (!store_) open_again();
    if (now >= next_try_) store_waiting_items();
    if (!unended_.empty()) end_finished_runs();
    next_commit = now + options_.commit_interval;
  }
  commit_recordings();
  store_waiting_items();
  discard_waiting_items();
  end_finished_runs();
}

// Makes one transaction for each recording and interval, so that one disk flush is enough for all
// blocks of the interval.
void Storekeeper::commit_recordings() {
  for (auto& [run, recording] : recordings_) {
    const Status kept = commit(run, recording);
    if (kept || is_busy(kept)) continue;
    note_full(kept.error());
    events_.failed(run, kept.error());
  }
}

void Storekeeper::open_again() {
  const auto now = std::chrono::steady_clock::now();
  if (now - last_open_attempt_ < kOpenRetryInterval) return;
  last_open_attempt_ = now;
  auto opened = open_database(options_);
  if (!opened) return set_unopened(not_writable(options_, opened.error()));
  store_.emplace(std::move(*opened));
  database_ = store::FileWatch(options_.database);
  begin_chain();
  set_unopened({});
}

// The state "full" stays until the disk has free space again.
void Storekeeper::note_full(const Error& error) {
  if (is_full(error)) set(full_, words::text(error));
}

void Storekeeper::clear_full_state() {
  if (store_ && has_room(options_.database)) set(full_, "");
}

void Storekeeper::set(std::string& which, const std::string& reason) {
  const StorageState before = storage();
  {
    const std::lock_guard guard(fault_mutex_);
    which = reason;
  }
  report_change(before);
}

void Storekeeper::set_unopened(StorageState now) {
  const StorageState before = storage();
  {
    const std::lock_guard guard(fault_mutex_);
    unopened_ = std::move(now);
  }
  report_change(before);
}

void Storekeeper::report_change(const StorageState& before) {
  const StorageState now = storage();
  if (now != before && events_.storage_changed) events_.storage_changed(now);
}

StorageState Storekeeper::storage() const {
  const std::lock_guard guard(fault_mutex_);
  if (!lost_.empty()) return {"lost", lost_};
  if (!unopened_.reason.empty()) return unopened_;
  if (!full_.empty()) return {"full", full_};
  if (!held_.empty()) return {"held", held_};
  if (!damaged_.empty()) return {"damaged", damaged_};
  return {};
}

std::string Storekeeper::still_open_reason(std::int64_t run) const {
  const std::lock_guard guard(fault_mutex_);
  const auto found = open_reasons_.find(run);
  return found == open_reasons_.end() ? "" : found->second;
}

void Storekeeper::check_storage_if_due() {
  const auto now = std::chrono::steady_clock::now();
  if (now - files_watched_ < kFileCheckInterval) return;
  files_watched_ = now;
  check_database();
  announce_head();
  if (store_ && !store_->damage().empty()) set(damaged_, store_->damage());
  clear_full_state();
  for (auto& [run, recording] : recordings_) {
    const std::string lost = recording.file.fault();
    if (!lost.empty())
      events_.failed(run, Error{ErrorCode::io, lost + " while the run was being recorded"});
  }
}

// Error text if another program changed the chain of hashes after its head was announced.
std::string Storekeeper::chain_fault() {
  if (!store_) return {};
  const Status whole = store_->check_head(announced_);
  if (whole || whole.error().code != ErrorCode::bad_input) return {};
  return words::text(whole.error()) +
         ", and restart mdofd; until the restart, mdofd stores nothing";
}

// If the announced head is not in the chain, announce_head() announces no new head; see
// check_database().
void Storekeeper::begin_chain() {
  if (!store_) return;
  const std::lock_guard guard(fault_mutex_);
  announced_ = store::read_announced_head(options_.database).head;
  changes_announced_ = -1;
}

void Storekeeper::announce_head() {
  if (!store_ || !lost_.empty() || store_->changes() == changes_announced_) return;
  changes_announced_ = store_->changes();
  const auto head = store_->chain_head();
  if (!head || *head == announced_ || !store_->check_head(announced_)) return;
  // Writes the head to a file only with full durability. Otherwise the announced head can be
  // missing in the database after a power failure, although nobody changed the database.
  const auto generation = store_->generation();
  if (options_.durability == store::Durability::full && generation) {
    const Status written = store::write_announced_head(options_.database, {*head, *generation});
    if (!written) note_full(written.error());
  }
  if (events_.head_changed) events_.head_changed(*head);
  const std::lock_guard guard(fault_mutex_);
  announced_ = *head;
}

store::ChainHead Storekeeper::chain_head() const {
  const std::lock_guard guard(fault_mutex_);
  return announced_;
}

void Storekeeper::note_damage(const std::string& what) {
  queue_.push_always([this, what] { set(damaged_, what); });
}

void Storekeeper::check_database() {
  std::string reason = database_.fault();
  if (!reason.empty())
    reason +=
        " while mdofd was using the file, so mdofd cannot store data; restore the old file, or "
        "restart mdofd to use the present file (if the file is missing, mdofd creates a new one)";
  else if (store_ && !(reason = store_->journal_fault()).empty())
    reason += "; mdofd has stopped storing data; restart mdofd";
  else
    reason = chain_fault();
  {
    const std::lock_guard guard(fault_mutex_);
    if (reason == lost_) return;
  }
  set(lost_, reason);
  if (reason.empty()) return;
  for (const auto& [run, recording] : recordings_)
    events_.failed(run, Error{ErrorCode::io, reason});
}

std::string Storekeeper::fault() const {
  const std::lock_guard guard(fault_mutex_);
  return lost_.empty() ? unopened_.reason : lost_;
}

Status Storekeeper::commit(std::int64_t run, Recording& recording) {
  if (!recording.waiting) return {};
  MDOF_TRY(const std::int64_t seq, recording.writer.commit());
  recording.waiting = false;
  events_.recorded(run, seq);
  return {};
}

// Stores the samples first, then the points that are calculated from these samples.
Status Storekeeper::keep_points(std::int64_t run, const std::vector<MeasuredPoint>& points) {
  if (const auto found = incomplete_.find(run); found != incomplete_.end()) {
    found->second += points.size();
    dropped_points_ += points.size();
    return io_error("an earlier point of this run was not stored");
  }
  const auto recording = recordings_.find(run);
  Status kept = recording == recordings_.end() ? Status() : commit(run, recording->second);
  if (kept) kept = store_->append_points(run, points);
  if (kept || is_busy(kept)) return kept;
  note_full(kept.error());
  incomplete_[run] += points.size();
  dropped_points_ += points.size();
  events_.failed(run, kept.error());
  return kept;
}

bool Storekeeper::post(Job job) {
  return queue_.try_push([this, job = std::move(job)] {
    if (store_) job(*store_);  // without a store, callers have rejected the request: see fault()
  });
}

Result<std::string> Storekeeper::run(std::function<Result<std::string>(store::Store&)> job) {
  auto promise = std::make_shared<std::promise<Result<std::string>>>();
  auto result = promise->get_future();
  if (!post([promise = std::move(promise), job = std::move(job)](store::Store& store) {
        promise->set_value(job(store));
      }))
    return io_error("too many writes to the database are pending; try again");
  try {
    return result.get();
  } catch (const std::future_error&) {  // the job was destroyed and did not run: see post()
    return io_error("mdofd cannot store data at present: " + storage().reason);
  }
}

Result<store::RecordingWriter> Storekeeper::create_recording(const NewRun& run) const {
  return store::RecordingWriter::create(run.recording, run.recording_header, options_.durability);
}

Result<std::int64_t> Storekeeper::begin(NewRun& run) {
  if (const std::string reason = fault(); !reason.empty()) return io_error(reason);
  if (run.recording.empty()) return store_->begin_run(run.header, run.action);
  auto writer = run.begun ? std::move(*run.begun) : create_recording(run);
  if (!writer) return tl::unexpected(writer.error());
  auto id = store_->begin_run(run.header, run.action);
  if (id) recordings_.emplace(*id, Recording{std::move(*writer), store::FileWatch(run.recording)});
  return id;
}

// Begins a run. If this fails, removes the recording of the run.
Result<std::int64_t> Storekeeper::begin_or_remove(NewRun& run) {
  const bool made =
      !run.recording.empty() && (run.begun || !std::filesystem::exists(run.recording));
  auto id = begin(run);
  run.begun.reset();
  if (!id) note_full(id.error());
  if (!id && made) store::RecordingWriter::remove(run.recording);
  return id;
}

bool Storekeeper::begin_run(NewRun run, std::function<void(Result<std::int64_t>)> done) {
  auto shared = std::make_shared<NewRun>(std::move(run));
  const bool posted =
      queue_.try_push([this, shared, done = std::move(done)] { done(begin_or_remove(*shared)); });
  if (posted || !shared->begun) return posted;
  shared->begun.reset();
  store::RecordingWriter::remove(shared->recording);
  return false;
}

bool Storekeeper::record(std::int64_t run, std::vector<SampleBlock> blocks, bool wait) {
  auto shared = std::make_shared<std::vector<SampleBlock>>(std::move(blocks));
  auto job = [this, run, shared] {
    const auto recording = recordings_.find(run);
    if (recording == recordings_.end()) return;  // the recording has failed or ended
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

void Storekeeper::end_run(std::int64_t run, Run result, RunEnding how,
                          std::function<void(Result<std::int64_t>)> done) {
  auto shared =
      std::make_shared<Ending>(Ending{run, std::move(result), std::move(how), std::move(done)});
  queue_.push_always([this, shared] { take(std::move(*shared)); });
}

}  // namespace mdof::daemon
