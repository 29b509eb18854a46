// Finds the program or kernel driver that uses a USB interface, for messages.
#pragma once

#include <string>

namespace mdof::drivers::usb {

struct Place {
  int bus = 0, address = 0;
  std::string port;  // name of the port as in /sys/bus/usb/devices: "1-4.2"; "": not known
};

// Returns "the kernel's driver cdc_acm", "the program mdofd (4711)", or "another program".
std::string interface_owner(const Place& place, int interface);
// Returns another program that has `path` open: "mdofd (4711)"; "": no such program is visible to
// this user.
std::string find_program_with_file(const std::string& path);

}  // namespace mdof::drivers::usb
