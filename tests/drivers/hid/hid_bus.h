// HID devices without USB. umockdev provides sysfs and events. Each /dev/hidraw* is a pseudo
// terminal, and a thread reads and answers the requests with simulated devices. Run the test under
// umockdev-wrapper.
#pragma once

#include <gtest/gtest.h>
#include <linux/hidraw.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <umockdev-1.0/umockdev.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "drivers/clock/monotonic.h"
#include "drivers/usb/simulated_usb.h"

namespace mdof::drivers {

inline bool under_umockdev() {
  const char* const preloaded = std::getenv("LD_PRELOAD");
  return preloaded && std::strstr(preloaded, "umockdev");
}

class HidBus {
 public:
  HidBus()
      : testbed_(umockdev_testbed_new()),
        ioctls_(umockdev_ioctl_base_new()),
        thread_([this] { serve(); }) {
    g_signal_connect(ioctls_, "handle-ioctl", G_CALLBACK(answer_ioctl), nullptr);
  }
  ~HidBus() {
    stop_ = true;
    thread_.join();
    while (!plugged_.empty()) unplug(plugged_.begin()->first);
    g_object_unref(testbed_);
    g_object_unref(ioctls_);
  }
  HidBus(const HidBus&) = delete;
  HidBus& operator=(const HidBus&) = delete;

  // `interface`: HID interface of the device; -1 if the device is connected through uhid and not
  // through USB. `device` must exist until unplug() is called or the device leaves by itself
  // (gone()).
  void plug(int number, usb::SimulatedUsb& device, int interface = 1) {
    Plugged plugged{&device, interface, -1, paths(number, interface), {}};
    answer_ioctls(number);  // before a program can open the node
    GError* error = nullptr;
    const std::string text = sysfs_of(number, device.identity(), plugged);
    ASSERT_TRUE(umockdev_testbed_add_from_string(testbed_, text.c_str(), &error)) << error->message;
    const std::string node = node_of(number);
    plugged.fd = umockdev_testbed_get_dev_fd(testbed_, node.c_str());
    ASSERT_GE(plugged.fd, 0);
    const std::lock_guard lock(mutex_);
    plugged_[number] = plugged;
  }
  void unplug(int number) {
    Plugged gone;
    {
      const std::lock_guard lock(mutex_);
      gone = plugged_[number];
      plugged_.erase(number);
    }
    umockdev_testbed_uevent(testbed_, gone.paths.back().c_str(), "remove");
    for (auto path = gone.paths.rbegin(); path != gone.paths.rend(); ++path)
      umockdev_testbed_remove_device(testbed_, path->c_str());
    GError* error = nullptr;
    EXPECT_TRUE(umockdev_testbed_detach_ioctl(testbed_, node_of(number).c_str(), &error))
        << error->message;
    forget_terminal(gone.fd);
    ::close(gone.fd);
  }
  // The file uevent of the HID device of a node. The file may be missing, because a device may
  // vanish while its node is still listed.
  std::filesystem::path uevent_of(int number) {
    const std::lock_guard lock(mutex_);
    gchar* const root = umockdev_testbed_get_root_dir(testbed_);
    const auto& paths = plugged_.at(number).paths;
    std::filesystem::path uevent = root + paths[paths.size() - 2] + "/uevent";
    g_free(root);
    return uevent;
  }
  // Changes a device while it is not answering.
  template <class Act>
  void change(const Act& act) {
    const std::lock_guard lock(mutex_);
    act();
  }
  static std::string node_of(int number) { return "/dev/hidraw" + std::to_string(number); }

 private:
  struct Plugged {
    usb::SimulatedUsb* device = nullptr;
    int interface = 1, fd = -1;
    std::vector<std::string> paths;  // paths in sysfs, relative to the root of the testbed
    std::string received;
  };

  static std::vector<std::string> paths(int number, int interface) {
    const std::string n = std::to_string(number);
    std::vector<std::string> all;
    std::string at = "/sys/devices/virtual/misc/uhid";
    if (interface >= 0) {
      all.push_back(at = "/sys/devices/pci0000:00/usb1/1-" + n);
      all.push_back(at += "/1-" + n + ":1." + std::to_string(interface));
    }
    all.push_back(at += "/0003:1DC3:1001.000" + n);
    all.push_back(at += "/hidraw/hidraw" + n);
    return all;
  }

  static std::string hex(const std::string& bytes) {
    std::string text;
    std::array<char, 3> two{};
    for (const char c : bytes) {
      std::snprintf(two.data(), two.size(), "%02X", static_cast<unsigned char>(c));
      text += two.data();
    }
    return text;
  }
  static std::string word(unsigned value, int digits) {
    std::array<char, 16> text{};
    std::snprintf(text.data(), text.size(), "%0*x", digits, value);
    return text.data();
  }
  static const std::string& report_of(const usb::Identity& id, int interface) {
    return id.hid_reports.at(static_cast<std::size_t>(interface < 0 ? 1 : interface));
  }

  std::string sysfs_of(int number, const usb::Identity& id, const Plugged& plugged) const {
    std::string text;
    std::size_t level = 0;
    const auto path = [&] { return "P: " + plugged.paths[level++].substr(4) + "\n"; };
    if (plugged.interface >= 0) {
      text += path() +
              "E: DEVTYPE=usb_device\nE: SUBSYSTEM=usb\nA: idVendor=" + word(id.vendor, 4) +
              "\\n\nA: idProduct=" + word(id.product, 4) + "\\n\nA: serial=" + id.serial +
              "\\n\nA: manufacturer=" + id.manufacturer + "\\n\nA: product=" + id.product_name +
              "\\n\nA: bcdDevice=0100\\n\n\n";
      text += path() + "E: DEVTYPE=usb_interface\nE: SUBSYSTEM=usb\nA: bInterfaceNumber=" +
              word(static_cast<unsigned>(plugged.interface), 2) + "\\n\n\n";
    }
    text += path() + "E: SUBSYSTEM=hid\nE: HID_ID=0003:" + word(id.vendor, 8) + ":" +
            word(id.product, 8) + "\nE: HID_NAME=" + id.manufacturer + " " + id.product_name +
            "\nE: HID_UNIQ=" + id.serial +
            "\nH: report_descriptor=" + hex(report_of(id, plugged.interface)) + "\n\n";
    text += path() + "N: hidraw" + std::to_string(number) + "\nE: DEVNAME=" + node_of(number) +
            "\nE: MAJOR=246\nE: MINOR=" + std::to_string(number) +
            "\nE: SUBSYSTEM=hidraw\nA: dev=246:" + std::to_string(number) +
            "\\n\nL: device=../../../0003:1DC3:1001.000" + std::to_string(number) + "\n";
    return text;
  }

  // hidapi makes only the ioctl for the size of the report descriptor.
  static gboolean answer_ioctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer) {
    int size = 27;
    if (umockdev_ioctl_client_get_request(client) != HIDIOCGRDESCSIZE) return FALSE;
    UMockdevIoctlData* const arg = umockdev_ioctl_client_get_arg(client);
    GError* error = nullptr;
    UMockdevIoctlData* const place = umockdev_ioctl_data_resolve(arg, 0, sizeof size, &error);
    if (place) umockdev_ioctl_data_update(place, 0, reinterpret_cast<guint8*>(&size), sizeof size);
    umockdev_ioctl_client_complete(client, place ? 0 : -1, place ? 0 : EFAULT);
    return TRUE;
  }
  void answer_ioctls(int number) {
    GError* error = nullptr;
    ASSERT_TRUE(umockdev_testbed_attach_ioctl(testbed_, node_of(number).c_str(), ioctls_, &error))
        << error->message;
  }

  // umockdev stores the name of the terminal. It fails when the system gives the same number to a
  // new terminal, so the stored name must be removed.
  void forget_terminal(int fd) {
    std::string name = ::ptsname(fd);
    std::replace(name.begin(), name.end(), '/', '_');
    gchar* const root = umockdev_testbed_get_root_dir(testbed_);
    std::filesystem::remove(std::string(root) + "/dev/.ptymap/" + name);
    g_free(root);
  }

  void serve() {
    while (!stop_) {
      std::vector<int> gone;
      {
        const std::lock_guard lock(mutex_);
        for (auto& [number, plugged] : plugged_) {
          turn(plugged);
          if (plugged.device->gone()) gone.push_back(number);
        }
      }
      for (const int number : gone) unplug(number);
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
  }
  static void turn(Plugged& p) {
    constexpr std::size_t kReport = 64;
    pollfd ready{p.fd, POLLIN, 0};
    std::array<char, 4096> bytes;
    if (::poll(&ready, 1, 0) == 1 && (ready.revents & POLLIN) != 0) {
      const ssize_t n = ::read(p.fd, bytes.data(), bytes.size());
      if (n > 0) p.received.append(bytes.data(), static_cast<std::size_t>(n));
    }
    for (; p.received.size() > kReport; p.received.erase(0, kReport + 1)) {
      EXPECT_EQ(p.received[0], '\0') << "reports without numbers are written with a 0 before them";
      p.device->out(0x02, p.received.substr(1, kReport), monotonic_ns());
    }
    for (;;) {
      const usb::Reply reply = p.device->in(0x82, kReport, monotonic_ns());
      if (reply.answer != usb::Answer::done) return;
      (void)!::write(p.fd, reply.bytes.data(), reply.bytes.size());
    }
  }

  UMockdevTestbed* testbed_;
  UMockdevIoctlBase* ioctls_;
  std::mutex mutex_;  // protects plugged_
  std::map<int, Plugged> plugged_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

}  // namespace mdof::drivers
