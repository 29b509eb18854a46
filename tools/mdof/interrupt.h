// A long piece of work that ends early when it is asked to, with what it has.
#pragma once

namespace mdof::tools {

// While one lives, the first SIGINT, SIGTERM or SIGHUP (unless ignored) only makes requested()
// true; a second one ends the program as usual. One at a time.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  static bool requested();  // any thread
};

}  // namespace mdof::tools
