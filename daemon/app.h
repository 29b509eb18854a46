// The application object of mdofd. It owns all parts and creates them in start-up order.
#pragma once

#include <memory>

#include "daemon/measure/configuration/config.h"
#include "schema/base/result.h"

namespace mdof::daemon {

class App {
 public:
  // Opens the database, the sockets and the devices. Returns the errors of these parts.
  static Result<std::unique_ptr<App>> create(Config config);
  ~App();
  // Serves until SIGTERM, SIGINT or SIGHUP. Unfinished runs then end as aborted.
  void run();

 private:
  struct Parts;
  explicit App(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace mdof::daemon
