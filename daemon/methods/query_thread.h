// Answers calls that take long (reading of the database, calculation) on the thread "query", so
// that these calls do not block the event loop.
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

// The thread serves one call at a time. The next call is from the client that has used the least
// time of the thread. Calls of disconnected clients are removed. The event loop keeps the pending
// calls and gives them to the thread one by one. The thread has a lower priority than the
// measurement; therefore the event loop must not wait for a lock that the thread has locked.
class QueryThread {
 public:
  // `store`: a read-only connection to `database`. Only the thread uses it after this call.
  QueryThread(std::shared_ptr<rpc::Executor> loop, std::filesystem::path database,
              store::Store store);
  ~QueryThread();  // finishes the current call; the pending calls get no answer

  // Call the following functions on the event loop only.
  using Work = std::function<Result<std::string>(store::Store&)>;
  // Adds a call. If the client has too many pending calls, answer() replies with `conflict` at
  // once.
  void answer(rpc::Reply reply, Work work);
  // Before the next call, the thread opens the database again.
  void open_again() { open_again_ = true; }
  std::uint64_t refused() const { return refused_; }
  // The message of SQLite about a damaged file, if a call has found damage since the last
  // take_damage(). Empty: no damage.
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
  // The following functions run on the thread "query".
  void work();
  void serve(Call call);

  static constexpr std::size_t kClientCallLimit = 256;

  const std::shared_ptr<rpc::Executor> loop_;
  const std::filesystem::path database_;
  // The following members are used on the event loop only.
  std::map<Key, Client, std::owner_less<>> clients_;
  FairOrder<Key> order_;
  std::optional<Key> served_;  // client of the current call
  bool open_again_ = false;
  std::uint64_t refused_ = 0;
  std::string damage_;
  // Messages from the thread to the event loop use this pointer, because they can arrive after the
  // QueryThread is destroyed.
  const std::shared_ptr<QueryThread*> self_;

  store::Store store_;  // only the thread uses it
  std::mutex mutex_;    // protects next_ and stopping_
  std::condition_variable call_ready_;
  std::optional<Call> next_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace mdof::daemon
