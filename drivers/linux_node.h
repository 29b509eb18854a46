// How Linux shows a connected device, and who may open it. Each driver's row states it; the udev
// rules (udev_rules.h) and the checks of `mdof doctor` are made from it.
#pragma once

#include <cstdint>
#include <optional>
#include <variant>

namespace mdof::drivers {

// The node of a USB device that the driver opens.
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
  const char* manufacturer = "";  // its string, if other devices have the same ids
  const char* note = "";          // for the reader of the rules
};

// Devices of a kernel class. The node of each has the name of the class: /dev/comedi0.
struct ClassDevice {
  const char* name;       // "Comedi board"
  const char* subsystem;  // "comedi": folder in /sys/class, beginning of each node's name
  const char* group;      // "iocard": its members may open the device
  const char* remedy;     // for a user who may not open the device
  const char* note = "";
};

// Files of a device in sysfs that the driver writes.
struct SysfsFile {
  const char* name;       // "IIO converter"
  const char* subsystem;  // "iio"
  const char* devices;    // `name` of the device, as udev matches it: "ad7745|ad7746"
  // Files in the folder of the device, for a shell: "count*/preset count*/preset_enable".
  const char* files;
  const char* key;  // key of mdofd.toml that needs them: "sampling_hz"
  const char* note = "";
};

using LinuxNode = std::variant<UsbDevice, ClassDevice, SysfsFile>;

}  // namespace mdof::drivers
