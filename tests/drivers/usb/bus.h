// A USB with simulated devices for the real libusb. umockdev provides sysfs, udev events and a
// usbfs. This class answers the ioctls of the usbfs. Run the test under umockdev-wrapper.
// usbfs wakes a polling program when a transfer has ended (POLLOUT) or when the device was
// unplugged (POLLERR). To simulate this, the node of each device is a pseudo terminal. A stopped
// terminal is not writable. If its other end is closed, it reports an error.
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

// Any thread may use it. One lock protects the devices; change(), the thread of the bus and the
// thread of umockdev take this lock. A process may have only one bus at a time.
class Bus {
 public:
  // `clock` returns the time for the devices.
  explicit Bus(std::function<std::int64_t()> clock = monotonic_ns);
  ~Bus();
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  // Connects the device to the bus and returns its number. The device must exist until unplug().
  int plug(SimulatedUsb& device);
  // A device also leaves the bus when its gone() returns true.
  void unplug(int number);
  void change(const std::function<void()>& act);
  // Faults for programs. forbid(): no program may open the node. hold(): a kernel driver of this
  // name has claimed the interface ("": no driver has claimed it). If a program has claimed it,
  // the driver is "usbfs".
  void forbid(int number);
  void hold(int number, const std::string& driver);

  // Longest time between two transfers of an endpoint in which no transfer was pending, since
  // plug().
  std::int64_t longest_idle_ns(int number, std::uint8_t endpoint);
  int submitted(int number);  // number of transfers that programs have submitted

  struct Node;  // the node of one device

 private:
  static int on_ioctl(UMockdevIoctlBase* base, void* client, void* self);
  void turn();
  static std::string describe(const Node& node);
  int free_number();

  std::function<std::int64_t()> clock_;
  UMockdevTestbed* testbed_;
  UMockdevIoctlBase* base_;
  // The lock mutex_ protects the nodes and the devices.
  std::map<int, std::unique_ptr<Node>> nodes_;
  int last_number_ = 1;  // numbers 2 ... 127 are used in turn
  std::mutex mutex_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

}  // namespace mdof::drivers::usb
