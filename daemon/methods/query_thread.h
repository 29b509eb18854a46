// Answers the calls that read the database or calculate for long, on the thread "query": the event
// loop goes on meanwhile, whatever they cost.
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

// Clients take turns, one call a turn: next is the client that has used the least of the thread.
// The calls of a client that has gone are dropped. What waits is kept on the loop and handed to the
// thread one by one: the thread comes after everything that measures, so that the loop must not
// wait for a lock that it holds.
class QueryThread {
 public:
  // `store`: a read-only connection to `database`, from then on the thread's own.
  QueryThread(std::shared_ptr<rpc::Executor> loop, std::filesystem::path database,
              store::Store store);
  ~QueryThread();  // ends the call under way; the others get no answer

  // Thread-bound from here on: the loop.
  using Work = std::function<Result<std::string>(store::Store&)>;
  // `conflict` at once where too many calls of the client wait already.
  void answer(rpc::Reply reply, Work work);
  // The connection is made anew before the next call.
  void open_again() { open_again_ = true; }
  std::uint64_t refused() const { return refused_; }
  // What SQLite said of a damaged file in a call since this was last asked; empty: nothing.
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
  // Of the thread:
  void work();
  void serve(Call call);

  static constexpr std::size_t kMostOfClient = 256;

  const std::shared_ptr<rpc::Executor> loop_;
  const std::filesystem::path database_;
  // Of the loop:
  std::map<Key, Client, std::owner_less<>> clients_;
  FairOrder<Key> order_;
  std::optional<Key> served_;  // whose call the thread has
  bool open_again_ = false;
  std::uint64_t refused_ = 0;
  std::string damage_;
  const std::shared_ptr<QueryThread*> self_;  // for the thread's messages, which may come too late

  store::Store store_;  // of the thread
  std::mutex mutex_;    // guards the next two
  std::condition_variable handed_over_;
  std::optional<Call> next_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace mdof::daemon
