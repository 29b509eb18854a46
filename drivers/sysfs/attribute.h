// Files of sysfs: small texts that the kernel makes at each read.
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

// As pread(2) from offset 0: bytes, or -1 and errno. Tests hand in their own.
using SysfsRead = std::function<ssize_t(int fd, char* into, std::size_t size)>;
SysfsRead sysfs_pread();

// A file that is read again and again through one descriptor: a device that was unplugged and
// plugged in again is an error (ENODEV), and never another device's value. Thread-bound.
class SysfsAttribute {
 public:
  // Error: not there, no permission.
  static Result<SysfsAttribute> open(const std::string& path, SysfsRead read = sysfs_pread());
  ~SysfsAttribute();
  SysfsAttribute(SysfsAttribute&& other) noexcept;
  SysfsAttribute& operator=(SysfsAttribute&& other) noexcept;

  // Its first line. Errors name the file, the kernel's error and what it may mean.
  Result<std::string> read();
  // One integer of 64 bits, signed or not (the bits of an unsigned one).
  Result<std::int64_t> read_integer();
  const std::string& path() const { return path_; }

 private:
  SysfsAttribute(int fd, std::string path, SysfsRead read);
  int fd_ = -1;
  std::string path_;
  SysfsRead read_;
};

// Reads a file once. Nothing: there is no such file, which is no error: not every device has all.
Result<std::optional<std::string>> read_sysfs(const std::string& path);
Status write_sysfs(const std::string& path, const std::string& text);

// What an error number of a read or write means for a device in sysfs, with the remedy.
std::string sysfs_error(int error);
std::string sysfs_write_error(int error);  // where a write may be refused by rights alone
// Decimal, the whole text; from -2^63 to 2^64 - 1. Pure.
std::optional<std::int64_t> parse_sysfs_integer(std::string_view text);

}  // namespace mdof::drivers
