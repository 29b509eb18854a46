// Connections and transfers of libusb; no other header includes libusb.
//
// libusb 1.0.26 calls back from whoever handles its events. Here that is always the driver's own
// thread, in pump(), so that nothing is shared and nothing needs a lock. Each wait has a deadline:
// after an unplug libusb returns from its wait at once, over and over, until udev has said so too.
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

// An open device. Closed when it goes; its transfers have gone before.
struct Connection {
  std::shared_ptr<libusb_context> context;  // of this device alone, once it was found
  libusb_device_handle* device = nullptr;
  int claimed = -1;  // interface
  Connection() = default;
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  // Handles events until `done` or the deadline; events that wait already are handled in any case.
  // False: the deadline came first.
  bool pump(Deadline deadline, const std::function<bool()>& done) const;
};

struct Transfer {
  Transfer(const Connection& connection, std::size_t bytes);
  ~Transfer() { libusb_free_transfer(raw); }  // must not be in flight
  Transfer(const Transfer&) = delete;
  Transfer& operator=(const Transfer&) = delete;

  Status submit();
  std::string received() const;  // of a transfer in

  libusb_transfer* raw;  // null: no memory
  std::vector<unsigned char> buffer;
  bool in_flight = false;
  std::int64_t done_ns = 0;  // when its end was seen
};
using Transfers = std::vector<std::unique_ptr<Transfer>>;

// Cancels all that are in flight, and waits up to a second. False: one has not ended.
bool cancel_all(const Connection& connection, const Transfers& transfers);
// The same, then frees all. A transfer that does not end (the kernel's driver of the host
// controller hangs) is never freed: libusb might still write to it.
void cancel_and_free(const Connection& connection, Transfers& transfers);

// Of a transfer's end; "" where all went well.
std::string text_of(libusb_transfer_status status);
// Of a libusb call; LIBUSB_ERROR_…
std::string text_of_error(int code);

}  // namespace mdof::drivers::usb
