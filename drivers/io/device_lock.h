// Prevents two programs from opening the same device, for connections that have no lock.
#pragma once

#include <string>

#include "drivers/io/byte_stream.h"
#include "schema/base/result.h"

namespace mdof::drivers {

// Identity of a device. It does not depend on how the address is written: host names are replaced
// by addresses, and symbolic links by their files.
std::string identity_of(const Endpoint& at);
std::string identity_of_path(const std::string& path);

// The lock exists from take() to the destructor; the kernel removes it when the program ends. It is
// an abstract Unix socket, not a file: it needs no folder and no permission, leaves no file behind,
// and the kernel knows the process that has it. It applies within one network namespace.
class DeviceLock {
 public:
  // Error: another program has the lock; the message contains its name and process id. If the
  // kernel does not support abstract sockets, take() succeeds without a lock, because the lock is
  // advisory. `shared`: this program may take the lock several times, for a device that serves
  // several drivers.
  static Result<DeviceLock> take(const std::string& identity, bool shared = false);
  ~DeviceLock();
  DeviceLock(DeviceLock&& other) noexcept;
  DeviceLock& operator=(DeviceLock&& other) noexcept;

  // Closes the connections of programs that have asked which process has the device. Call it about
  // every second: if too many connections are pending, further programs get no answer.
  void answer_inquiries() const;

 private:
  explicit DeviceLock(int fd) : fd_(fd) {}
  int fd_ = -1;
};

}  // namespace mdof::drivers
