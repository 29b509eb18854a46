// Calculates runs from clients' files, one at a time, on the thread "replay". A client cannot write
// the database while this daemon does; the daemon reads the file itself, so that it stores only its
// own results.
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

// Call it from the main thread only. The storekeeper must outlive it.
class Replayer {
 public:
  explicit Replayer(Storekeeper& keeper);
  // Cancels the present file. If its file system does not respond, the thread is abandoned after a
  // while. was_abandoned() is then true, and the process must exit without waiting for threads.
  ~Replayer();
  static bool was_abandoned();

  // A run, its uncertainty for SQL users, and a function that makes the reply from the stored run.
  // The function runs on the thread that stores the run, so it must be short.
  struct Made {
    std::shared_ptr<Run> run;
    RunUncertainty uncertainty;
    std::function<std::string(const Run&)> document;
  };
  // `make` runs on the thread and ends soon after its callback has returned false. `done` gets the
  // document of the stored run or the error, on another thread; if another file is in progress, it
  // gets `conflict` at once.
  using Make = std::function<Result<Made>(const ProgressCallback&)>;
  using Done = std::function<void(Result<std::string>)>;
  void start(Make make, const HistoryEntry& action, Done done);

 private:
  struct Shared;  // shared with the thread, which may outlive this object
  std::shared_ptr<Shared> shared_;
  std::thread thread_;
};

}  // namespace mdof::daemon
