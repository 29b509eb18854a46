// The owner of a USB interface that is in use, for messages.
#pragma once

#include <string>

namespace mdof::drivers::usb {

struct Place {
  int bus = 0, address = 0;
  std::string port;  // as in /sys/bus/usb/devices: "1-4.2"; "": not known
};

// "the kernel's driver cdc_acm", "the program mdofd (4711)", or "another program".
std::string interface_owner(const Place& place, int interface);
// "mdofd (4711)": another program that has `path` open; "": this user can see none.
std::string find_program_with_file(const std::string& path);

}  // namespace mdof::drivers::usb
