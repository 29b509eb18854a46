// Replays logs for clients, one at a time, on the thread "replay": who cannot write the database,
// since this daemon does, has the log measured here, so that what is stored was computed here.
#pragma once

#include <atomic>
#include <functional>
#include <thread>

#include "daemon/measure/replay/replay_request.h"
#include "daemon/storekeeper/storekeeper.h"

namespace mdof::daemon {

// Calls from the main thread only. The storekeeper outlives it.
class Replayer {
 public:
  explicit Replayer(Storekeeper& keeper) : keeper_(keeper) {}
  ~Replayer();  // gives up the log under way

  // `done`: the id of the stored run, or why there is none; on another thread, or at once with
  // `conflict` while a log is under way.
  using Done = std::function<void(Result<std::int64_t>)>;
  void start(ReplayRequest request, const Deed& deed, Done done);

 private:
  void work(const ReplayRequest& request, const Deed& deed, const Done& done);

  Storekeeper& keeper_;
  std::atomic<bool> busy_{false}, stopping_{false};
  std::thread thread_;
};

}  // namespace mdof::daemon
