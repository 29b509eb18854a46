// Ends long work early if a signal arrives; the program then uses the results so far.
#pragma once

namespace mdof::tools {

// While an object exists, the first SIGINT, SIGTERM or SIGHUP only makes requested() true. A
// further signal ends the program as usual, or is ignored as long as the object exists. A signal
// that the program ignored before stays ignored. Only one object may exist at a time.
class Interrupt {
 public:
  enum class Further { ends_program, is_ignored };
  explicit Interrupt(Further further = Further::ends_program);
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  static bool requested();  // Any thread.
};

}  // namespace mdof::tools
