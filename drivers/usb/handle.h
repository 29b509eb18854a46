// An open USB device, found by vendor, product and serial number. It offers control and bulk
// transfers with time-outs. Uses libusb-1.0, with one context for each open device.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "schema/base/result.h"

namespace mdof::drivers::usb {

struct Connection;
class Handle;

struct Wanted {
  std::string model;  // for messages: "LabJack U6"
  std::uint16_t vendor = 0, product = 0;
  std::string serial;  // "": exactly one device must be connected
  int interface = 0;   // number of the interface to claim
  // Asks a device for its serial number, if the USB descriptor does not contain it. May be empty.
  std::function<Result<std::string>(Handle&)> query_serial;
};

// Thread-bound. The destructor closes the device. Errors state cause and remedy, but not the
// device; the driver adds the name of the device.
class Handle {
 public:
  using Timeout = std::chrono::milliseconds;

  // Errors: no such device; several devices are connected and no serial number is given (the
  // message lists the devices); no permission; the device is in use (the message names the
  // program).
  static Result<Handle> open(const Wanted& wanted);

  const std::string& serial() const { return serial_; }  // "": not known
  const std::string& where() const { return where_; }    // "USB bus 1, device 4"

  // Vendor requests to the device (bmRequestType 0xC0 and 0x40). Error: the reply is too short.
  Result<std::string> vendor_in(std::uint8_t request, std::uint16_t value, std::uint16_t index,
                                std::uint16_t length, Timeout timeout);
  Status vendor_out(std::uint8_t request, std::uint16_t value, std::uint16_t index,
                    std::string_view bytes, Timeout timeout);
  // One bulk transfer. bulk_in() ends after a packet that is not full, or after `most` bytes (a
  // multiple of 64).
  Status bulk_out(std::uint8_t endpoint, std::string_view bytes, Timeout timeout);
  Result<std::string> bulk_in(std::uint8_t endpoint, std::size_t most, Timeout timeout);
  // Discards the data of an IN endpoint until no data have arrived for `quiet`.
  Status drain(std::uint8_t endpoint, Timeout quiet);
  Status clear_halt(std::uint8_t endpoint);

  const std::shared_ptr<Connection>& connection() const { return connection_; }

 private:
  friend class Search;
  Handle(std::shared_ptr<Connection> connection, std::string where)
      : connection_(std::move(connection)), where_(std::move(where)) {}
  Result<std::string> control(std::uint8_t type, std::uint8_t request, std::uint16_t value,
                              std::uint16_t index, std::string_view bytes, std::uint16_t length,
                              Timeout timeout);

  std::shared_ptr<Connection> connection_;
  std::string where_, serial_;
};

}  // namespace mdof::drivers::usb
