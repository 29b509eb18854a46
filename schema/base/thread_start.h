// Prepares a new thread.
#pragma once

#include <pthread.h>

#include <csignal>
#include <string>

namespace mdof {

// Sets the name of the calling thread (Linux stores 15 bytes). In the calling thread, blocks the
// signals that end a program, so that only the main thread receives these signals: a signal in the
// calling thread would interrupt a system call of a driver.
inline void start_thread_as(const std::string& name) {
  ::pthread_setname_np(::pthread_self(), name.substr(0, 15).c_str());
  sigset_t ending;
  ::sigemptyset(&ending);
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) ::sigaddset(&ending, signal);
  ::pthread_sigmask(SIG_BLOCK, &ending, nullptr);
}

}  // namespace mdof
