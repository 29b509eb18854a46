// How Linux presents a connected device, and which users may open it. Each driver's row in
// registry.cpp contains such a description. The udev rules (udev_rules.h) and the checks of `mdof
// doctor` use these descriptions.
#pragma once

#include <cstdint>
#include <optional>
#include <variant>

namespace mdof::drivers {

// The device file of a USB device that the driver opens.
enum class UsbNode {
  bus,     // /dev/bus/usb/001/007, opened by libusb
  hidraw,  // /dev/hidraw0, opened by hidapi
  tty,     // /dev/ttyUSB0
};

struct UsbDevice {
  const char* name;      // "MCC USB-1608FS-Plus"
  std::uint16_t vendor;  // idVendor
  // idProduct; nullopt: any product of this vendor.
  std::optional<std::uint16_t> product = std::nullopt;
  UsbNode node = UsbNode::bus;
  int interface = 0;  // bInterfaceNumber, for UsbNode::hidraw only
  // Manufacturer string of the device, if other devices have the same ids.
  const char* manufacturer = "";
  const char* note = "";  // explanation for readers of the udev rules
};

// Devices of one kernel class. The device file of each device begins with the name of the class:
// /dev/comedi0.
struct ClassDevice {
  const char* name;  // "Comedi board"
  // "comedi": a folder in /sys/class, and the beginning of each device file's name.
  const char* subsystem;
  const char* group;   // "iocard": members of this group may open the device
  const char* remedy;  // advice for a user who may not open the device
  const char* note = "";
};

// Files in sysfs that belong to a device and that the driver writes.
struct SysfsFile {
  const char* name;       // "IIO converter"
  const char* subsystem;  // "iio"
  const char* devices;    // names of the devices, as a pattern of udev: "ad7745|ad7746"
  // Files in the folder of the device, as patterns of the shell: "count*/preset
  // count*/preset_enable".
  const char* files;
  const char* key;  // key of mdofd.toml for which the driver writes these files: "sampling_hz"
  const char* note = "";
};

using LinuxNode = std::variant<UsbDevice, ClassDevice, SysfsFile>;

}  // namespace mdof::drivers
