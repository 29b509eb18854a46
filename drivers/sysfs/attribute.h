// Reads and writes files of sysfs: short texts that the kernel makes at each read.
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

// pread(2) from offset 0. Returns the number of bytes, or -1 with errno. Tests pass another
// function.
using SysfsRead = std::function<ssize_t(int fd, char* into, std::size_t size)>;
SysfsRead sysfs_pread();

// A file that is read repeatedly through one descriptor. If the device was unplugged and plugged in
// again, reads fail (ENODEV); they never return a value of another device. Thread-bound.
class SysfsAttribute {
 public:
  // Errors: the file does not exist; the user has no permission.
  static Result<SysfsAttribute> open(const std::string& path, SysfsRead read = sysfs_pread());
  ~SysfsAttribute();
  SysfsAttribute(SysfsAttribute&& other) noexcept;
  SysfsAttribute& operator=(SysfsAttribute&& other) noexcept;

  // Returns the first line. Errors name the file, the kernel's error and its possible cause.
  Result<std::string> read();
  // Returns a 64-bit integer. An unsigned number above 2^63 - 1 is returned as the signed number
  // with the same bits.
  Result<std::int64_t> read_integer();
  const std::string& path() const { return path_; }

 private:
  SysfsAttribute(int fd, std::string path, SysfsRead read);
  int fd_ = -1;
  std::string path_;
  SysfsRead read_;
};

// Reads a file once. nullopt: the file does not exist. This is not an error, because devices have
// different files.
Result<std::optional<std::string>> read_sysfs(const std::string& path);
Status write_sysfs(const std::string& path, const std::string& text);

// Text with cause and remedy, for the errno of a read or write of a device's sysfs file.
std::string sysfs_error(int error);
std::string sysfs_write_error(int error);  // for writes, if the user may have no permission
// Parses a text that is a decimal integer from -2^63 to 2^64 - 1. Pure.
std::optional<std::int64_t> parse_sysfs_integer(std::string_view text);

}  // namespace mdof::drivers
