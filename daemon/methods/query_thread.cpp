#include "daemon/methods/query_thread.h"

#include <sys/resource.h>
#include <unistd.h>

#include <utility>

#include "schema/base/thread_start.h"

namespace mdof::daemon {
namespace {

constexpr int kQueryNiceness = 10;  // nice value of the thread: lower priority than the measurement
constexpr std::chrono::milliseconds kNewClientCost{1};

}  // namespace

QueryThread::QueryThread(std::shared_ptr<rpc::Executor> loop, std::filesystem::path database,
                         store::Store store)
    : loop_(std::move(loop)),
      database_(std::move(database)),
      self_(std::make_shared<QueryThread*>(this)),
      store_(std::move(store)),
      thread_([this] { work(); }) {}

QueryThread::~QueryThread() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  call_ready_.notify_all();
  thread_.join();
}

void QueryThread::answer(rpc::Reply reply, Work work) {
  Key key = reply.client();
  if (!clients_.contains(key)) admit(key);
  Client& client = clients_.at(key);
  if (client.calls.size() >= kClientCallLimit) {
    ++refused_;
    return reply(fail(ErrorCode::conflict,
                      std::to_string(kClientCallLimit) +
                          " calls of this connection are already waiting for the database; call "
                          "again after mdofd has answered some of these calls"));
  }
  client.calls.push_back({std::move(reply), std::move(work)});
  if (client.calls.size() == 1) order_.add(std::move(key), client.share);
  if (!served_) deliver();
}

// Adds a client. Removes disconnected clients before, so that the map never has more clients than
// connections exist.
void QueryThread::admit(const Key& client) {
  order_.remove_if([](const Key& key) { return key.expired(); });
  std::erase_if(clients_, [this](const auto& entry) {
    const bool served =
        served_ && !served_->owner_before(entry.first) && !entry.first.owner_before(*served_);
    return entry.first.expired() && !served;
  });
  // Without this initial cost, a client that connects again for each call would always be served
  // first.
  order_.charge(clients_[client].share, kNewClientCost);
}

// Gives the next call to the thread. The call stays in the list of its client until done().
// Otherwise answer() would add the client to order_ a second time.
void QueryThread::deliver() {
  while (!order_.empty()) {
    const Key key = order_.take();
    if (key.expired()) {
      clients_.erase(key);
      continue;
    }
    Client& client = clients_.at(key);
    Call call = std::move(client.calls.front());
    call.open_again = std::exchange(open_again_, false);
    served_ = key;
    {
      const std::lock_guard lock(mutex_);
      next_ = std::move(call);
    }
    return call_ready_.notify_all();
  }
}

void QueryThread::done(Cost cost, std::string damage) {
  if (!damage.empty()) damage_ = std::move(damage);
  const Key key = *std::exchange(served_, std::nullopt);
  Client& client = clients_.at(key);
  order_.charge(client.share, cost);
  client.calls.pop_front();  // the call that deliver() has moved to the thread
  if (!client.calls.empty()) order_.add(key, client.share);
  deliver();
}

void QueryThread::work() {
  start_thread_as("query");
  // On Linux this changes the priority of this thread only.
  (void)::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kQueryNiceness);
  for (;;) {
    std::unique_lock lock(mutex_);
    call_ready_.wait(lock, [this] { return stopping_ || next_; });
    if (stopping_) return;
    Call call = *std::exchange(next_, std::nullopt);
    lock.unlock();
    serve(std::move(call));
  }
}

void QueryThread::serve(Call call) {
  if (call.open_again) {
    auto opened = store::Store::open(database_, store::Access::read_only);
    if (opened) store_ = std::move(*opened);
  }
  const auto begin = std::chrono::steady_clock::now();
  call.reply(call.work(store_));
  const Cost cost = std::chrono::steady_clock::now() - begin;
  loop_->dispatch([self = std::weak_ptr(self_), cost, damage = store_.damage()] {
    if (const auto here = self.lock()) (*here)->done(cost, damage);
  });
}

}  // namespace mdof::daemon
