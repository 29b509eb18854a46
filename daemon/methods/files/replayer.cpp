#include "daemon/methods/files/replayer.h"

#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>

#include "daemon/measure/replay/known_trouble.h"
#include "schema/base/thread_start.h"

namespace mdof::daemon {
namespace {

constexpr int kNiceness = 10;  // nice value of the thread: lower priority than the measurement
constexpr std::chrono::seconds kPatience{2};

std::atomic<bool> thread_abandoned{false};

}  // namespace

struct Replayer::Shared {
  explicit Shared(Storekeeper& to) : keeper(to) {}

  void work(const Make& make, const HistoryEntry& action, const Done& done);
  void store(Result<Made> made, const HistoryEntry& action, const Done& done);

  std::atomic<bool> busy{false}, stopping{false};
  std::mutex mutex;  // protects ended and working
  std::condition_variable ended;
  bool working = false;
  // Use the storekeeper only while the mutex is locked and `stopping` is false. When `stopping` is
  // true, the storekeeper can be destroyed.
  Storekeeper& keeper;
};

void Replayer::Shared::work(const Make& make, const HistoryEntry& action, const Done& done) {
  start_thread_as("replay");
  // On Linux this changes the priority of this thread only.
  (void)::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kNiceness);
  auto made = make([this](const Progress&) { return !stopping; });
  const std::lock_guard lock(mutex);
  busy = false;  // set before the reply is sent, because the client may then send the next request
                 // at once
  if (!stopping) store(std::move(made), action, done);
  working = false;
  ended.notify_all();
}

void Replayer::Shared::store(Result<Made> made, const HistoryEntry& action, const Done& done) {
  if (!made) return done(tl::unexpected(made.error()));
  const bool posted = keeper.post([made = std::move(*made), action, done](store::Store& store) {
    if (const Status added = add_known_trouble(store, *made.run); !added)
      return done(tl::unexpected(added.error()));
    const auto id = store.add_run(*made.run, action, made.uncertainty);
    if (!id) return done(tl::unexpected(id.error()));
    made.run->header.id = *id;
    done(made.document(*made.run));
  });
  if (!posted) done(io_error("too many writes to the database are pending; try again"));
}

Replayer::Replayer(Storekeeper& keeper) : shared_(std::make_shared<Shared>(keeper)) {}

Replayer::~Replayer() {
  std::unique_lock lock(shared_->mutex);
  shared_->stopping = true;
  const bool done = shared_->ended.wait_for(lock, kPatience, [this] { return !shared_->working; });
  lock.unlock();
  if (!thread_.joinable()) return;
  if (done) {
    thread_.join();
  } else {
    thread_abandoned = true;
    thread_.detach();
  }
}

bool Replayer::was_abandoned() {
  return thread_abandoned;
}

void Replayer::start(Make make, const HistoryEntry& action, Done done) {
  if (shared_->busy.exchange(true))
    return done(
        fail(ErrorCode::conflict,
             "mdofd is replaying or importing another file; try again when mdofd has finished"));
  // Waits only briefly: `busy` was false, so the thread has almost ended.
  if (thread_.joinable()) thread_.join();
  {
    const std::lock_guard lock(shared_->mutex);
    shared_->working = true;
  }
  thread_ = std::thread([shared = shared_, make = std::move(make), action, done = std::move(done)] {
    shared->work(make, action, done);
  });
}

}  // namespace mdof::daemon
