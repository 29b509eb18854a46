// That no two programs open one device: for buses that have no lock of their own.
#pragma once

#include <string>

#include "drivers/io/byte_stream.h"
#include "schema/base/result.h"

namespace mdof::drivers {

// The device whatever name it goes by: host names become addresses, links the file they lead to.
std::string identity_of(const Endpoint& at);
std::string identity_of_path(const std::string& path);

// Held from take() to the destructor, and gone with the program, however that ends. It is a name of
// the kernel's (an abstract Unix socket) and no file: it needs no folder and no permission, nothing
// of it is left over, and the kernel says who has it. It holds within one network namespace.
class DeviceLock {
 public:
  // Error: another has it, with its name and process id. Where the kernel gives no such names the
  // lock is none: it is advisory.
  // `shared`: this program may have it more than once, as a device that speaks with several.
  static Result<DeviceLock> take(const std::string& identity, bool shared = false);
  ~DeviceLock();
  DeviceLock(DeviceLock&& other) noexcept;
  DeviceLock& operator=(DeviceLock&& other) noexcept;

  // Ends the connections of programs that asked who holds the device. To be called about every
  // second: once too many wait, further programs get no message.
  void answer_inquiries() const;

 private:
  explicit DeviceLock(int fd) : fd_(fd) {}
  int fd_ = -1;
};

}  // namespace mdof::drivers
