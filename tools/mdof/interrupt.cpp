#include "tools/mdof/interrupt.h"

#include <atomic>
#include <csignal>

namespace mdof::tools {
namespace {

std::atomic<bool> asked = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler writes it");

void note(int) {
  asked = true;
}

}  // namespace

Interrupt::Interrupt() {
  asked = false;
  struct sigaction action = {};
  action.sa_handler = note;
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

Interrupt::~Interrupt() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

bool Interrupt::requested() {
  return asked;
}

}  // namespace mdof::tools
