// Connections and transfers of libusb; no other header includes libusb.
//
// libusb 1.0.26 calls back from the thread that handles its events. This is always the driver's own
// thread, in pump(), so that no data are shared and no lock is needed. Each wait has a deadline:
// after an unplug libusb returns immediately from every wait until udev reports the unplug.
#pragma once

#include <libusb.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "schema/base/result.h"

namespace mdof::drivers::usb {

using Deadline = std::chrono::steady_clock::time_point;

// An open device. The destructor closes it; all its transfers must be freed before.
struct Connection {
  std::shared_ptr<libusb_context> context;  // not shared with other devices after the search
  libusb_device_handle* device = nullptr;
  int claimed = -1;  // interface
  Connection() = default;
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  // Handles events until `done` or the deadline; always handles events that are pending. Returns
  // false if the deadline came first.
  bool pump(Deadline deadline, const std::function<bool()>& done) const;
};

struct Transfer {
  Transfer(const Connection& connection, std::size_t bytes);
  ~Transfer() { libusb_free_transfer(raw); }  // must not be in flight
  Transfer(const Transfer&) = delete;
  Transfer& operator=(const Transfer&) = delete;

  Status submit();
  std::string received() const;  // data of an IN transfer

  libusb_transfer* raw;  // nullptr: no memory
  std::vector<unsigned char> buffer;
  bool in_flight = false;
  std::int64_t done_ns = 0;  // time at which its end was detected
};
using Transfers = std::vector<std::unique_ptr<Transfer>>;

// Cancels all pending transfers and waits up to a second. Returns false if one has not ended.
bool cancel_all(const Connection& connection, const Transfers& transfers);
// As cancel_all(), then frees all. A transfer that does not end (the kernel's driver of the host
// controller hangs) is never freed, because libusb might still write to it.
void cancel_and_free(const Connection& connection, Transfers& transfers);

// Text of the end of a transfer; "": success.
std::string text_of(libusb_transfer_status status);
// Text of an error of libusb, LIBUSB_ERROR_…
std::string text_of_error(int code);

}  // namespace mdof::drivers::usb
