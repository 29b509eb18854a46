// Files of sysfs: short texts that the kernel generates at each read.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "schema/base/result.h"

namespace mdof::drivers {

// pread(2) from offset 0: returns the number of bytes, or -1 and errno. Tests use their own
// function.
using SysfsRead = std::function<ssize_t(int fd, char* into, std::size_t size)>;
SysfsRead sysfs_pread();

// A file that is read repeatedly through one descriptor. If the device was unplugged and plugged in
// again, reads fail (ENODEV) and never return another device's value. Thread-bound.
class SysfsAttribute {
 public:
  // Errors: the file does not exist, no permission.
  static Result<SysfsAttribute> open(const std::string& path, SysfsRead read = sysfs_pread());
  ~SysfsAttribute();
  SysfsAttribute(SysfsAttribute&& other) noexcept;
  SysfsAttribute& operator=(SysfsAttribute&& other) noexcept;

  // Returns the first line. Errors name the file and the kernel's error, with its possible cause.
  Result<std::string> read();
  // Returns a 64-bit integer; an unsigned one keeps its bits.
  Result<std::int64_t> read_integer();
  const std::string& path() const { return path_; }

 private:
  SysfsAttribute(int fd, std::string path, SysfsRead read);
  int fd_ = -1;
  std::string path_;
  SysfsRead read_;
};

// Reads a file once. nullopt: the file does not exist, which is not an error, because devices
// differ in their files.
Result<std::optional<std::string>> read_sysfs(const std::string& path);
Status write_sysfs(const std::string& path, const std::string& text);

// Cause and remedy of an error number of a read or write of a device's sysfs file.
std::string sysfs_error(int error);
std::string sysfs_write_error(int error);  // if the user may lack the permission to write
// A decimal integer from -2^63 to 2^64 - 1 that is the whole text. Pure.
std::optional<std::int64_t> parse_sysfs_integer(std::string_view text);

}  // namespace mdof::drivers
