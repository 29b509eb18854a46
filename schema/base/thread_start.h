// Initialisation of a thread.
#pragma once

#include <pthread.h>

#include <csignal>
#include <string>

namespace mdof {

// Names the calling thread (Linux keeps 15 bytes) and blocks the signals that end a program, so
// that the main thread receives them. A signal in this thread would interrupt a driver's call.
inline void start_thread_as(const std::string& name) {
  ::pthread_setname_np(::pthread_self(), name.substr(0, 15).c_str());
  sigset_t ending;
  ::sigemptyset(&ending);
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) ::sigaddset(&ending, signal);
  ::pthread_sigmask(SIG_BLOCK, &ending, nullptr);
}

}  // namespace mdof
