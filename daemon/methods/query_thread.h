// Answers calls that read the database or calculate for a long time, on the thread "query", so that
// they do not block the event loop.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "daemon/rpc/fair_order.h"
#include "daemon/rpc/reply.h"
#include "daemon/rpc/session/executor.h"
#include "daemon/store/store.h"
#include "schema/base/result.h"

namespace mdof::daemon {

// Serves one call at a time; the next call is that of the client that has used the least time of
// the thread. Calls of disconnected clients are dropped. Pending calls stay on the event loop, and
// the thread gets them one by one: the thread has a lower priority than the measurement, so the
// event loop must not wait for a lock that the thread holds.
class QueryThread {
 public:
  // `store`: a read-only connection to `database`. The thread owns it from here on.
  QueryThread(std::shared_ptr<rpc::Executor> loop, std::filesystem::path database,
              store::Store store);
  ~QueryThread();  // finishes the present call; the others get no answer

  // Thread-bound from here on: call it on the event loop.
  using Work = std::function<Result<std::string>(store::Store&)>;
  // Replies with `conflict` at once if the client has too many pending calls.
  void answer(rpc::Reply reply, Work work);
  // The thread opens the database again before the next call.
  void open_again() { open_again_ = true; }
  std::uint64_t refused() const { return refused_; }
  // The SQLite message on a damaged file in a call since the last query; empty: no damage.
  std::string take_damage() { return std::exchange(damage_, {}); }

 private:
  struct Call {
    rpc::Reply reply;
    Work work;
    bool open_again = false;
  };
  struct Client {
    std::deque<Call> calls;
    FairShare share;
  };
  using Key = std::weak_ptr<const void>;
  using Cost = std::chrono::nanoseconds;

  void admit(const Key& client);
  void deliver();
  void done(Cost cost, std::string damage);
  // On the thread "query":
  void work();
  void serve(Call call);

  static constexpr std::size_t kClientCallLimit = 256;

  const std::shared_ptr<rpc::Executor> loop_;
  const std::filesystem::path database_;
  // On the event loop:
  std::map<Key, Client, std::owner_less<>> clients_;
  FairOrder<Key> order_;
  std::optional<Key> served_;  // client of the present call
  bool open_again_ = false;
  std::uint64_t refused_ = 0;
  std::string damage_;
  const std::shared_ptr<QueryThread*> self_;  // for messages of the thread, which may arrive after
                                              // the destruction

  store::Store store_;  // used by the thread
  std::mutex mutex_;    // protects next_ and stopping_
  std::condition_variable call_ready_;
  std::optional<Call> next_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace mdof::daemon
