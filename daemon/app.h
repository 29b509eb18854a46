// The application object of mdofd. It creates and owns all objects that mdofd needs.
#pragma once

#include <memory>

#include "daemon/measure/configuration/config.h"
#include "schema/base/result.h"

namespace mdof::daemon {

class App {
 public:
  // Opens the database, the sockets and the devices. Returns the first error.
  static Result<std::unique_ptr<App>> create(Config config);
  ~App();
  // Serves clients until the signal SIGTERM, SIGINT or SIGHUP. The state of an unfinished run then
  // becomes "aborted".
  void run();

 private:
  struct Parts;
  explicit App(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace mdof::daemon
