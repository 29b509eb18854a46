// The daemon put together: owns every part, in start-up order.
#pragma once

#include <memory>

#include "daemon/measure/configuration/config.h"
#include "schema/base/result.h"

namespace mdof::daemon {

class App {
 public:
  // Opens the database, the socket and the devices. Errors as theirs.
  static Result<std::unique_ptr<App>> create(Config config);
  ~App();
  // Serves until SIGTERM, SIGINT or SIGHUP. Runs under way end as aborted.
  void run();

 private:
  struct Parts;
  explicit App(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace mdof::daemon
