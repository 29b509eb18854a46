// How Linux shows a device that is plugged in, and who may open it there: a driver's row says it,
// and the rules of udev (udev_rules.h) and the checks of `mdof doctor` are made from it.
#pragma once

#include <cstdint>
#include <optional>
#include <variant>

namespace mdof::drivers {

// What of a USB device its driver opens.
enum class UsbNode {
  bus,     // /dev/bus/usb/001/007, by libusb
  hidraw,  // /dev/hidraw0, by hidapi
  tty,     // /dev/ttyUSB0
};

struct UsbDevice {
  const char* name;                                     // "MCC USB-1608FS-Plus"
  std::uint16_t vendor;                                 // idVendor
  std::optional<std::uint16_t> product = std::nullopt;  // idProduct; none: any of this vendor
  UsbNode node = UsbNode::bus;
  int interface = 0;              // of hidraw: bInterfaceNumber
  const char* manufacturer = "";  // where other devices have the same ids: its string
  const char* note = "";          // for the reader of the rules
};

// Devices of a class of the kernel, each with a node of its own name: /dev/comedi0.
struct ClassDevice {
  const char* name;       // "Comedi board"
  const char* subsystem;  // "comedi": the folder in /sys/class, the beginning of each node's name
  const char* group;      // "iocard": may open it
  const char* remedy;     // for whoever may not
  const char* note = "";
};

// Files of a device in sysfs, which the driver writes.
struct SysfsFile {
  const char* name;       // "IIO converter"
  const char* subsystem;  // "iio"
  const char* devices;    // what the device's `name` says, as udev matches it: "ad7745|ad7746"
  const char* files;      // in its folder, for a shell: "count*/preset count*/preset_enable"
  const char* key;        // of mdofd.toml, for which it writes them: "sampling_hz"
  const char* note = "";
};

using LinuxNode = std::variant<UsbDevice, ClassDevice, SysfsFile>;

}  // namespace mdof::drivers
