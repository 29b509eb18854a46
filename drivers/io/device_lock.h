// Prevents two programs from opening one device, for buses that have no lock.
#pragma once

#include <string>

#include "drivers/io/byte_stream.h"
#include "schema/base/result.h"

namespace mdof::drivers {

// Identity of a device independent of the spelling: host names are resolved to addresses, links to
// files.
std::string identity_of(const Endpoint& at);
std::string identity_of_path(const std::string& path);

// Held from take() to the destructor; the kernel releases it when the program ends. It is an
// abstract Unix socket, not a file: it needs no folder and no permission, leaves nothing behind,
// and the kernel knows which process holds it. It is valid within one network namespace.
class DeviceLock {
 public:
  // Error: another program holds the lock; the message gives its name and process id. If the kernel
  // does not support such names, take() succeeds without a lock, because the lock is advisory.
  // `shared`: this program may take the lock several times, for a device that serves several
  // drivers.
  static Result<DeviceLock> take(const std::string& identity, bool shared = false);
  ~DeviceLock();
  DeviceLock(DeviceLock&& other) noexcept;
  DeviceLock& operator=(DeviceLock&& other) noexcept;

  // Closes the connections of programs that asked which process holds the device. Call it about
  // every second: when too many are pending, further programs get no message.
  void answer_inquiries() const;

 private:
  explicit DeviceLock(int fd) : fd_(fd) {}
  int fd_ = -1;
};

}  // namespace mdof::drivers
