// A USB with simulated devices on it, for the real libusb: umockdev gives it sysfs, udev's events
// and a usbfs whose ioctls are answered here. To be run under umockdev-wrapper.
//
// usbfs wakes a program that polls it when a transfer has ended (POLLOUT) or the device has left
// (POLLERR). So each device's node is a pseudo terminal here: stopped, it is not writable; its
// other end closed, it is in error.
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

// Any thread; the devices are used under one lock, by change(), by the bus's own thread and by that
// of umockdev. One bus at a time in a process.
class Bus {
 public:
  // `clock` is the time of the devices.
  explicit Bus(std::function<std::int64_t()> clock = monotonic_ns);
  ~Bus();
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  // Puts the device on the bus; gives its number there. It is to live until unplug().
  int plug(SimulatedUsb& device);
  // A device also leaves the bus by itself when it is gone().
  void unplug(int number);
  void change(const std::function<void()>& act);
  // What a program is to meet: the node forbidden; its interface held by a driver of the kernel
  // ("": by none), which is how a program that holds it looks too, called "usbfs".
  void forbid(int number);
  void hold(int number, const std::string& driver);

  // The longest that an endpoint had no transfer waiting between two, since plug().
  std::int64_t longest_unasked_ns(int number, std::uint8_t endpoint);
  int submitted(int number);  // transfers

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
  int last_number_ = 1;                         // 2 ... 127, one after the other
  std::mutex mutex_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

}  // namespace mdof::drivers::usb
