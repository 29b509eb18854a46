// Resources that this process uses.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace mdof::drivers::usb {

inline int open_descriptors() {
  int n = 0;
  for (const auto& fd : std::filesystem::directory_iterator("/proc/self/fd"))
    n += !fd.path().empty();
  return n;
}

inline std::int64_t resident_bytes() {
  std::ifstream file("/proc/self/statm");
  std::int64_t total = 0, resident = 0;
  file >> total >> resident;
  return resident * ::sysconf(_SC_PAGESIZE);
}

// Number of times that a test unplugs and replugs a device: the value of MDOF_USB_REPLUGS, or 20.
inline int replugs() {
  const char* text = std::getenv("MDOF_USB_REPLUGS");
  return text ? std::atoi(text) : 20;
}

}  // namespace mdof::drivers::usb
