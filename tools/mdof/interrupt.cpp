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

Interrupt::Interrupt(Further further) {
  asked = false;
  struct sigaction action = {};
  action.sa_handler = note;
  action.sa_flags = SA_RESTART;
  if (further == Further::ends_program) action.sa_flags |= static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  // SIGHUP: the terminal was closed. If nohup started the program, the signal is ignored and must
  // stay ignored.
  struct sigaction before = {};
  sigaction(SIGHUP, nullptr, &before);
  if (before.sa_handler == SIG_DFL) sigaction(SIGHUP, &action, nullptr);
}

Interrupt::~Interrupt() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  struct sigaction now = {};
  sigaction(SIGHUP, nullptr, &now);
  if (now.sa_handler == note) std::signal(SIGHUP, SIG_DFL);
}

bool Interrupt::requested() {
  return asked;
}

}  // namespace mdof::tools
