// Replays logs for clients, one at a time, on the thread "replay": who cannot write the database,
// since this daemon does, has the log measured here, so that what is stored was computed here.
#pragma once

#include <functional>
#include <memory>
#include <thread>

#include "daemon/measure/replay/replay_request.h"
#include "daemon/methods/client_file.h"
#include "daemon/storekeeper/storekeeper.h"

namespace mdof::daemon {

// Calls from the main thread only. The storekeeper outlives it.
class Replayer {
 public:
  explicit Replayer(Storekeeper& keeper);
  // Gives up the log under way. Where its file system does not answer, the thread is left behind
  // after a while: was_left_behind() then, and the process must end without waiting for threads.
  ~Replayer();
  static bool was_left_behind();

  // Opens and reads `request.log` with the rights of `user`. `done`: the id of the stored run, or
  // why there is none; on another thread, or at once with `conflict` while a log is under way.
  using Done = std::function<void(Result<std::int64_t>)>;
  void start(ReplayRequest request, const FileUser& user, const Deed& deed, Done done);

 private:
  struct Shared;  // with the thread, which may outlive this
  std::shared_ptr<Shared> shared_;
  std::thread thread_;
};

}  // namespace mdof::daemon
