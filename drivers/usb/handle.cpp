#include "drivers/usb/handle.h"

#include <algorithm>
#include <cstdio>

#include "drivers/usb/transfer.h"

namespace mdof::drivers::usb {
namespace {

using std::chrono::steady_clock;

constexpr std::uint8_t kVendorIn = 0xC0, kVendorOut = 0x40;
constexpr std::size_t kPacket = 64;
constexpr std::chrono::seconds kToDrain{1};

// Runs the transfer. When the function returns, the transfer has ended, or was cancelled and freed.
Status run(const Connection& connection, Transfers& one, std::chrono::milliseconds timeout) {
  Transfer& transfer = *one.front();
  MDOF_CHECK(transfer.submit());
  const auto ended = [&] { return !transfer.in_flight; };
  if (!connection.pump(steady_clock::now() + timeout, ended)) {
    cancel_and_free(connection, one);
    return io_error(text_of(LIBUSB_TRANSFER_TIMED_OUT) + " (" + std::to_string(timeout.count()) +
                    " ms)");
  }
  const std::string text = text_of(transfer.raw->status);
  return text.empty() ? Status{} : io_error(text);
}

std::string at_endpoint(std::uint8_t endpoint) {
  char text[24];
  std::snprintf(text, sizeof text, "endpoint 0x%02X", endpoint);
  return text;
}

std::string at_request(std::uint8_t request) {
  char text[24];
  std::snprintf(text, sizeof text, "request 0x%02X", request);
  return text;
}

Transfers one_transfer(const Connection& connection, std::size_t bytes) {
  Transfers one;
  one.push_back(std::make_unique<Transfer>(connection, bytes));
  return one;
}

}  // namespace

Result<std::string> Handle::control(std::uint8_t type, std::uint8_t request, std::uint16_t value,
                                    std::uint16_t index, std::string_view bytes,
                                    std::uint16_t length, Timeout timeout) {
  auto one = one_transfer(*connection_, LIBUSB_CONTROL_SETUP_SIZE + length);
  Transfer& transfer = *one.front();
  if (!transfer.raw) return io_error(text_of_error(LIBUSB_ERROR_NO_MEM));
  unsigned char* buffer = transfer.buffer.data();
  libusb_fill_control_setup(buffer, type, request, value, index, length);
  std::copy(bytes.begin(), bytes.end(), buffer + LIBUSB_CONTROL_SETUP_SIZE);
  transfer.raw->type = LIBUSB_TRANSFER_TYPE_CONTROL;
  if (auto done = run(*connection_, one, timeout); !done)
    return in_context(at_request(request), std::move(done.error()));
  const std::string sent(reinterpret_cast<const char*>(buffer) + LIBUSB_CONTROL_SETUP_SIZE, length);
  return sent.substr(0, static_cast<std::size_t>(transfer.raw->actual_length));
}

Result<std::string> Handle::vendor_in(std::uint8_t request, std::uint16_t value,
                                      std::uint16_t index, std::uint16_t length, Timeout timeout) {
  MDOF_TRY(std::string got, control(kVendorIn, request, value, index, "", length, timeout));
  if (got.size() == length) return got;
  return io_error(at_request(request) + ": the device has sent " + std::to_string(got.size()) +
                  " bytes instead of " + std::to_string(length));
}

Status Handle::vendor_out(std::uint8_t request, std::uint16_t value, std::uint16_t index,
                          std::string_view bytes, Timeout timeout) {
  const auto length = static_cast<std::uint16_t>(bytes.size());
  MDOF_CHECK(control(kVendorOut, request, value, index, bytes, length, timeout));
  return {};
}

Status Handle::bulk_out(std::uint8_t endpoint, std::string_view bytes, Timeout timeout) {
  auto one = one_transfer(*connection_, bytes.size());
  Transfer& transfer = *one.front();
  if (!transfer.raw) return io_error(text_of_error(LIBUSB_ERROR_NO_MEM));
  std::copy(bytes.begin(), bytes.end(), transfer.buffer.begin());
  transfer.raw->endpoint = endpoint;
  auto done = run(*connection_, one, timeout);
  return done ? done : in_context(at_endpoint(endpoint), std::move(done.error()));
}

Result<std::string> Handle::bulk_in(std::uint8_t endpoint, std::size_t most, Timeout timeout) {
  auto one = one_transfer(*connection_, most);
  Transfer& transfer = *one.front();
  if (!transfer.raw) return io_error(text_of_error(LIBUSB_ERROR_NO_MEM));
  transfer.raw->endpoint = endpoint;
  if (auto done = run(*connection_, one, timeout); !done)
    return in_context(at_endpoint(endpoint), std::move(done.error()));
  return transfer.received();
}

Status Handle::drain(std::uint8_t endpoint, Timeout quiet) {
  const auto until = steady_clock::now() + kToDrain;
  while (steady_clock::now() < until) {
    auto one = one_transfer(*connection_, kPacket);
    Transfer& transfer = *one.front();
    if (!transfer.raw) return io_error(text_of_error(LIBUSB_ERROR_NO_MEM));
    transfer.raw->endpoint = endpoint;
    MDOF_CHECK(transfer.submit());
    const auto ended = [&] { return !transfer.in_flight; };
    const bool came = connection_->pump(steady_clock::now() + quiet, ended);
    if (came && transfer.raw->status != LIBUSB_TRANSFER_COMPLETED)
      return io_error(at_endpoint(endpoint) + ": " + text_of(transfer.raw->status));
    cancel_and_free(*connection_, one);
    if (!came) return {};
  }
  return io_error(at_endpoint(endpoint) +
                  ": the device does not stop sending; unplug the device and plug it in again");
}

Status Handle::clear_halt(std::uint8_t endpoint) {
  const int code = libusb_clear_halt(connection_->device, endpoint);
  return code == 0 ? Status{} : io_error(at_endpoint(endpoint) + ": " + text_of_error(code));
}

}  // namespace mdof::drivers::usb
