// A USB with simulated devices for the real libusb: umockdev provides sysfs, udev events and a
// usbfs whose ioctls this class answers. Run it under umockdev-wrapper.
//
// usbfs wakes a polling program when a transfer has ended (POLLOUT) or the device was unplugged
// (POLLERR). Therefore each device's node is a pseudo terminal: when it is stopped, it is not
// writable; when its other end is closed, it reports an error.
#pragma once

#include <umockdev.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "drivers/clock/monotonic.h"
#include "drivers/usb/simulated_usb.h"

namespace mdof::drivers::usb {

// Any thread. One lock protects the devices; change(), the thread of the bus and the thread of
// umockdev take it. Only one bus at a time in a process.
class Bus {
 public:
  // `clock` gives the time of the devices.
  explicit Bus(std::function<std::int64_t()> clock = monotonic_ns);
  ~Bus();
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  // Connects the device to the bus and returns its number. The device must live until unplug().
  int plug(SimulatedUsb& device);
  // A device also leaves the bus when it is gone().
  void unplug(int number);
  void change(const std::function<void()>& act);
  // Faults for programs: the node is not permitted; its interface is claimed by a driver of the
  // kernel ("": by none). A program that claims it appears as the driver "usbfs".
  void forbid(int number);
  void hold(int number, const std::string& driver);

  // Longest time without a pending transfer at an endpoint between two transfers, since plug().
  std::int64_t longest_idle_ns(int number, std::uint8_t endpoint);
  int submitted(int number);  // number of transfers

  struct Node;  // of a device

 private:
  static int on_ioctl(UMockdevIoctlBase* base, void* client, void* self);
  void turn();
  static std::string describe(const Node& node);
  int free_number();

  std::function<std::int64_t()> clock_;
  UMockdevTestbed* testbed_;
  UMockdevIoctlBase* base_;
  std::map<int, std::unique_ptr<Node>> nodes_;  // guarded by mutex_, as are the devices
  int last_number_ = 1;                         // 2 ... 127, in turn
  std::mutex mutex_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

}  // namespace mdof::drivers::usb
