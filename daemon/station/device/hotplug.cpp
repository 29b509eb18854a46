#include "daemon/station/device/hotplug.h"

#include <libudev.h>

#include <string_view>

namespace mdof::daemon {

void Hotplug::Free::operator()(udev* context) const {
  udev_unref(context);
}
void Hotplug::Free::operator()(udev_monitor* monitor) const {
  udev_monitor_unref(monitor);
}

Result<Hotplug> Hotplug::watch() {
  Hotplug hotplug;
  hotplug.udev_.reset(udev_new());
  if (hotplug.udev_)
    hotplug.monitor_.reset(udev_monitor_new_from_netlink(hotplug.udev_.get(), "udev"));
  if (!hotplug.monitor_)
    return io_error(
        "cannot connect to udev, so mdofd does not notice when a device is plugged in; mdofd "
        "opens a disconnected device again only after a pause");
  for (const char* subsystem : {"usb", "hidraw", "tty", "counter", "iio"})
    udev_monitor_filter_add_match_subsystem_devtype(hotplug.monitor_.get(), subsystem, nullptr);
  if (udev_monitor_enable_receiving(hotplug.monitor_.get()) < 0)
    return io_error(
        "udev does not report when a device is plugged in; mdofd opens a disconnected device again "
        "only after a pause");
  return hotplug;
}

int Hotplug::descriptor() const {
  return udev_monitor_get_fd(monitor_.get());
}

bool Hotplug::read_arrivals() {
  bool arrived = false;
  // The descriptor does not block. nullptr means that no further event is pending.
  while (udev_device* device = udev_monitor_receive_device(monitor_.get())) {
    const char* action = udev_device_get_action(device);
    arrived = arrived || (action && std::string_view(action) != "remove");
    udev_device_unref(device);
  }
  return arrived;
}

}  // namespace mdof::daemon
