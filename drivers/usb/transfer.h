// Connections and transfers of libusb; no other header includes libusb.
//
// libusb 1.0.26 calls back from the thread that handles its events. This thread is always the
// driver's own thread, in pump(); therefore threads share no data and no lock is needed. Each wait
// has a deadline: after an unplug, each wait in libusb returns immediately until udev has reported
// the unplug.
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

// An open device. The destructor closes the device; all its transfers must be freed before.
struct Connection {
  std::shared_ptr<libusb_context> context;  // used by this device only, after the search
  libusb_device_handle* device = nullptr;
  int claimed = -1;  // claimed interface; -1: none
  Connection() = default;
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  // Handles events until `done` returns true or the deadline has passed. Events that are already
  // pending are handled in any case. Returns false if the deadline has passed first.
  bool pump(Deadline deadline, const std::function<bool()>& done) const;
};

struct Transfer {
  Transfer(const Connection& connection, std::size_t bytes);
  ~Transfer() { libusb_free_transfer(raw); }  // the transfer must not be in flight
  Transfer(const Transfer&) = delete;
  Transfer& operator=(const Transfer&) = delete;

  Status submit();
  std::string received() const;  // data of an IN transfer

  libusb_transfer* raw;  // nullptr: there is no memory for it
  std::vector<unsigned char> buffer;
  bool in_flight = false;
  std::int64_t done_ns = 0;  // time at which the end of the transfer was detected
};
using Transfers = std::vector<std::unique_ptr<Transfer>>;

// Cancels all pending transfers and waits for their ends, at most 1 s. Returns false if a transfer
// has not ended.
bool cancel_all(const Connection& connection, const Transfers& transfers);
// As cancel_all(), then frees the transfers. A transfer that does not end (because the kernel's
// driver of the host controller hangs) is never freed: libusb might still write to its memory.
void cancel_and_free(const Connection& connection, Transfers& transfers);

// Text for the result of a transfer; "": success.
std::string text_of(libusb_transfer_status status);
// Text for an error code LIBUSB_ERROR_… of libusb.
std::string text_of_error(int code);

}  // namespace mdof::drivers::usb
