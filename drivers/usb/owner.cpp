#include "drivers/usb/owner.h"

#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>

namespace mdof::drivers::usb {
namespace {

namespace fs = std::filesystem;

// Uses readlink(), because programs that simulate a bus can intercept this function.
std::string target_of(const std::string& link) {
  std::array<char, 512> text{};
  const ssize_t n = ::readlink(link.c_str(), text.data(), text.size());
  return n <= 0 ? "" : std::string(text.data(), static_cast<std::size_t>(n));
}

bool has_open(const fs::path& process, const std::string& path) {
  std::error_code failed;
  for (fs::directory_iterator fd(process / "fd", failed), end; !failed && fd != end;
       fd.increment(failed))
    if (target_of(fd->path().string()) == path) return true;
  return false;
}

}  // namespace

std::string find_program_with_file(const std::string& path) {
  std::error_code failed;
  for (fs::directory_iterator each("/proc", failed), end; !failed && each != end;
       each.increment(failed)) {
    const std::string pid = each->path().filename().string();
    if (pid.find_first_not_of("0123456789") != std::string::npos) continue;
    if (pid == std::to_string(::getpid()) || !has_open(each->path(), path)) continue;
    std::ifstream file(each->path() / "comm");
    std::string name;
    std::getline(file, name);
    return name + " (" + pid + ")";
  }
  return "";
}

std::string interface_owner(const Place& place, int interface) {
  const std::string driver = fs::path(target_of("/sys/bus/usb/devices/" + place.port + ":1." +
                                                std::to_string(interface) + "/driver"))
                                 .filename()
                                 .string();
  if (!driver.empty() && driver != "usbfs") return "the kernel's driver " + driver;
  std::array<char, 64> node{};
  std::snprintf(node.data(), node.size(), "/dev/bus/usb/%03d/%03d", place.bus, place.address);
  const std::string program = find_program_with_file(node.data());
  return program.empty() ? "another program" : "the program " + program;
}

}  // namespace mdof::drivers::usb
