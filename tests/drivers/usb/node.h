// The usbfs node of one device, with the transfers of the device and the pseudo terminal that
// programs poll.
#pragma once

#include <umockdev.h>

#include <cstdint>
#include <list>
#include <map>
#include <optional>
#include <string>

#include "drivers/usb/simulated_usb.h"
#include "tests/drivers/usb/bus.h"

namespace mdof::drivers::usb {

// A transfer from SUBMITURB until the program reaps it.
struct Urb {
  UMockdevIoctlData* data = nullptr;    // struct usbdevfs_urb
  UMockdevIoctlData* buffer = nullptr;  // nullptr if the transfer has no bytes
  UMockdevIoctlClient* client = nullptr;
  std::uint8_t type = 0, endpoint = 0;
  std::size_t length = 0;
  // Data of an OUT transfer; of a control transfer, the setup packet and its data.
  std::string sent;
  bool done = false;
  int status = 0;
  std::string got;
  std::size_t taken = 0;  // OUT: number of bytes that the device has accepted
};

// The caller of every function must hold the lock of the bus.
struct Bus::Node {
  Node(SimulatedUsb& usb, int number);
  ~Node();

  // Answers an ioctl. Returns false if the ioctl does not belong to usbfs.
  bool answer(UMockdevIoctlClient* client);
  // The device answers pending transfers, if it can.
  void serve(std::int64_t now_ns);
  void leave();  // leaves the bus: pending transfers end with ESHUTDOWN

  SimulatedUsb& device;
  const int number;
  std::string syspath, devnode, terminal, driver;
  bool gone = false;
  std::list<Urb> urbs;  // in order of submission
  int submitted = 0;
  struct Asked {
    std::optional<std::int64_t> idle_since_ns;  // time at which the last pending transfer ended
    std::int64_t longest_ns = 0;
  };
  std::map<std::uint8_t, Asked> asked;  // key: endpoint

 private:
  void submit(UMockdevIoctlClient* client);
  void reap(UMockdevIoctlClient* client);
  void discard(UMockdevIoctlClient* client);
  void take_part(Urb& urb);
  void claim(UMockdevIoctlClient* client);
  void name_driver(UMockdevIoctlClient* client);
  void clear_halt(UMockdevIoctlClient* client);
  bool run(Urb& urb, std::int64_t now_ns);
  Reply run_control(Urb& urb, std::int64_t now_ns);
  static void note(Asked& asked, bool waiting, std::int64_t now_ns);
  void wake();

  int master_ = -1, slave_ = -1;
  bool awake_ = true;
  std::int64_t last_ns_ = 0;  // time of the last serve()
  UMockdevIoctlClient* claimed_by_ = nullptr;
};

}  // namespace mdof::drivers::usb
