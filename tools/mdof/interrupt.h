// Lets long work end early on a signal, with the results so far.
#pragma once

namespace mdof::tools {

// While an object exists, the first SIGINT, SIGTERM or SIGHUP (unless ignored) only makes
// requested() true; a second signal ends the program as usual. Only one object may exist at a time.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  static bool requested();  // Any thread.
};

}  // namespace mdof::tools
