#include "drivers/udev_rules.h"

#include <array>
#include <cstdio>

namespace mdof::drivers {
namespace {

constexpr const char* kRulesHead =
    R"(# Made from the rows of drivers/registry.cpp.
# Devices that mdof reads, for the group mdof (mdof.sysusers makes it) and for the user who is
# logged in at the machine. A stable name by serial number: /dev/mdof/<serial>.
# Install: lib/udev/rules.d/60-mdof.rules, then udevadm control --reload && udevadm trigger

ACTION=="remove", GOTO="mdof_end"

)";
constexpr const char* kTail = "\nLABEL=\"mdof_end\"\n";
constexpr const char* kForGroup = R"(MODE="0660", GROUP="mdof", TAG+="uaccess")";

std::string match(const char* key, const std::string& value) {
  return std::string(key) + "==\"" + value + "\", ";
}

std::string hex(const char* format, unsigned number) {
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), format, number);
  return text.data();
}

std::string bus_rule(const UsbDevice& usb) {
  std::string rule = match("SUBSYSTEM", "usb") + match("ENV{DEVTYPE}", "usb_device") +
                     match("ATTR{idVendor}", hex("%04x", usb.vendor));
  if (usb.product) rule += match("ATTR{idProduct}", hex("%04x", *usb.product));
  return rule + kForGroup + R"(, SYMLINK+="mdof/$attr{serial}")";
}

// In a udev rule, all ATTRS must match the same parent device. Here this parent is the USB
// interface; its modalias contains the vendor and the number of the interface.
std::string hidraw_rule(const UsbDevice& usb) {
  const std::string product = usb.product ? hex("%04X", *usb.product) : "";
  return match("SUBSYSTEM", "hidraw") +
         match("ATTRS{modalias}", "usb:v" + hex("%04X", usb.vendor) + "p" + product + "*in" +
                                      hex("%02X", static_cast<unsigned>(usb.interface))) +
         kForGroup;
}

std::string tty_rule(const UsbDevice& usb) {
  std::string rule = match("SUBSYSTEM", "tty") + match("ATTRS{idVendor}", hex("%04x", usb.vendor));
  if (usb.product) rule += match("ATTRS{idProduct}", hex("%04x", *usb.product));
  if (*usb.manufacturer != '\0') rule += match("ATTRS{manufacturer}", usb.manufacturer);
  return rule + kForGroup;
}

std::string rule_of(const UsbDevice& usb) {
  switch (usb.node) {
    case UsbNode::bus:
      return bus_rule(usb);
    case UsbNode::hidraw:
      return hidraw_rule(usb);
    case UsbNode::tty:
      return tty_rule(usb);
  }
  return "";
}

std::string rule_of(const ClassDevice& device) {
  const std::string subsystem = device.subsystem;
  return match("SUBSYSTEM", subsystem) + match("KERNEL", subsystem + "[0-9]*") +
         R"(MODE="0660", GROUP=")" + device.group + R"(", TAG+="uaccess")";
}

std::string rule_of(const SysfsFile& sysfs) {
  const std::string files = sysfs.files;
  return match("SUBSYSTEM", sysfs.subsystem) + match("ATTR{name}", sysfs.devices) +
         R"(RUN+="/bin/sh -c 'cd %S%p && chgrp mdof )" + files + " && chmod g+w " + files + "'\"";
}

}  // namespace

std::string udev_rules(const std::vector<DriverRow>& rows) {
  std::string text = kRulesHead;
  for (const DriverRow& row : rows) {
    if (!row.node) continue;
    text += std::visit(
        [](const auto& node) {
          const std::string note = *node.note == '\0' ? "" : std::string(": ") + node.note;
          return std::string("# ") + node.name + note + "\n" + rule_of(node) + "\n";
        },
        *row.node);
  }
  return text + kTail;
}

}  // namespace mdof::drivers
