// Makes runs of clients' files, one at a time, on the thread "replay": who cannot write the
// database, since this daemon does, has the file read here, so that what is stored was computed
// here.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "daemon/storekeeper/storekeeper.h"
#include "schema/base/progress.h"
#include "schema/run.h"
#include "schema/uncertainty/run_uncertainty.h"

namespace mdof::daemon {

// Calls from the main thread only. The storekeeper outlives it.
class Replayer {
 public:
  explicit Replayer(Storekeeper& keeper);
  // Gives up the file under way. Where its file system does not answer, the thread is left behind
  // after a while: was_left_behind() then, and the process must end without waiting for threads.
  ~Replayer();
  static bool was_left_behind();

  // A run with its uncertainty for SQL users, and what the reply says of it once it has its id:
  // that is made by the thread that stores it, so it is quick.
  struct Made {
    std::shared_ptr<Run> run;
    RunUncertainty uncertainty;
    std::function<std::string(const Run&)> document;
  };
  // `make` runs on the thread and ends soon after the callback that it gets has returned false.
  // `done` receives the document of the stored run, or the error; on another thread, or at once
  // with `conflict` while a file is under way.
  using Make = std::function<Result<Made>(const ProgressCallback&)>;
  using Done = std::function<void(Result<std::string>)>;
  void start(Make make, const HistoryEntry& action, Done done);

 private:
  struct Shared;  // with the thread, which may outlive this
  std::shared_ptr<Shared> shared_;
  std::thread thread_;
};

}  // namespace mdof::daemon
