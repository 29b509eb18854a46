// Lists HID interfaces with libudev instead of hid_enumerate(): hidapi 0.13.1 of Debian 12 reads a
// null pointer if a device is unplugged during the listing (libusb/hidapi pull request 580).
#include <libudev.h>

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>

#include "drivers/io/hid.h"

namespace mdof::drivers {
namespace {

struct Release {
  void operator()(udev* context) const { ::udev_unref(context); }
  void operator()(udev_enumerate* search) const { ::udev_enumerate_unref(search); }
  void operator()(udev_device* device) const { ::udev_device_unref(device); }
};
template <class T>
using Owned = std::unique_ptr<T, Release>;

struct Ids {
  unsigned bus = 0, vendor = 0, product = 0;
};

// Parses the format of the kernel: "0003:00001DC3:00001001".
std::optional<Ids> parse_ids(const char* text) {
  Ids ids;
  if (!text || std::sscanf(text, "%x:%x:%x", &ids.bus, &ids.vendor, &ids.product) != 3)
    return std::nullopt;
  return ids;
}

int interface_of(udev_device* node) {
  udev_device* const usb =
      ::udev_device_get_parent_with_subsystem_devtype(node, "usb", "usb_interface");
  const char* const number =
      usb ? ::udev_device_get_sysattr_value(usb, "bInterfaceNumber") : nullptr;
  return number ? static_cast<int>(std::strtol(number, nullptr, 16)) : -1;
}

// Returns nullopt if the device is from another vendor, or was unplugged after it was listed. Each
// property may be missing.
std::optional<HidEntry> entry_of(udev_device* node, std::uint16_t vendor) {
  const char* const path = ::udev_device_get_devnode(node);
  udev_device* const hid = ::udev_device_get_parent_with_subsystem_devtype(node, "hid", nullptr);
  if (!path || !hid) return std::nullopt;
  const auto ids = parse_ids(::udev_device_get_property_value(hid, "HID_ID"));
  if (!ids || ids->vendor != vendor) return std::nullopt;
  const char* const serial = ::udev_device_get_property_value(hid, "HID_UNIQ");
  return HidEntry{path, static_cast<std::uint16_t>(ids->product), serial ? serial : "",
                  interface_of(node)};
}

}  // namespace

std::vector<HidEntry> list_hid(std::uint16_t vendor) {
  std::vector<HidEntry> entries;
  const Owned<udev> context(::udev_new());
  const Owned<udev_enumerate> search(context ? ::udev_enumerate_new(context.get()) : nullptr);
  if (!search) return entries;
  ::udev_enumerate_add_match_subsystem(search.get(), "hidraw");
  ::udev_enumerate_scan_devices(search.get());
  udev_list_entry* found = ::udev_enumerate_get_list_entry(search.get());
  for (; found; found = ::udev_list_entry_get_next(found)) {
    const char* const place = ::udev_list_entry_get_name(found);
    const Owned<udev_device> node(::udev_device_new_from_syspath(context.get(), place));
    if (!node) continue;
    if (auto entry = entry_of(node.get(), vendor)) entries.push_back(std::move(*entry));
  }
  return entries;
}

}  // namespace mdof::drivers
