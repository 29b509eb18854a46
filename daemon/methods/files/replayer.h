// Calculates runs from files of clients, one file at a time, on the thread "replay". Only mdofd may
// write its database. mdofd reads the file itself, so that it stores only results that it has
// calculated.
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

// Use this class on the main thread only. The storekeeper must exist longer than the Replayer.
class Replayer {
 public:
  explicit Replayer(Storekeeper& keeper);
  // Cancels the current file. If the file system does not respond within two seconds, the
  // destructor abandons the thread. was_abandoned() then returns true, and the process must exit
  // without waiting for threads.
  ~Replayer();
  static bool was_abandoned();

  // A calculated run. `uncertainty`: stored with the run, for users who read the database with SQL.
  // `document`: writes the reply from the stored run. This function runs on the thread that stores
  // the run, so it must be short.
  struct Made {
    std::shared_ptr<Run> run;
    RunUncertainty uncertainty;
    std::function<std::string(const Run&)> document;
  };
  // `make` runs on the thread "replay", and must end soon after its callback has returned false.
  // `done` receives the document of the stored run, or the error; `done` can be called on another
  // thread. If another file is in progress, `done` receives the error `conflict` at once.
  using Make = std::function<Result<Made>(const ProgressCallback&)>;
  using Done = std::function<void(Result<std::string>)>;
  void start(Make make, const HistoryEntry& action, Done done);

 private:
  struct Shared;  // shared with the thread; the thread can exist longer than this object
  std::shared_ptr<Shared> shared_;
  std::thread thread_;
};

}  // namespace mdof::daemon
