#include "drivers/usb/transfer.h"

#include <algorithm>
#include <thread>

#include "drivers/clock/monotonic.h"

namespace mdof::drivers::usb {
namespace {

using std::chrono::microseconds;
using std::chrono::steady_clock;

constexpr std::chrono::seconds kToCancel{1};
// if a wait without a result is shorter than this, libusb did not wait
constexpr microseconds kInstant{100};
constexpr microseconds kRest{200};

void LIBUSB_CALL on_end(libusb_transfer* raw) {
  auto* transfer = static_cast<Transfer*>(raw->user_data);
  transfer->in_flight = false;
  transfer->done_ns = monotonic_ns();
}

const char* const kGone =
    "the device is gone from the USB; it was unplugged, lost power or reset itself; check the "
    "cable and the hub";

}  // namespace

Connection::~Connection() {
  if (device && claimed >= 0) libusb_release_interface(device, claimed);
  if (device) libusb_close(device);
}

bool Connection::pump(Deadline deadline, const std::function<bool()>& done) const {
  while (!done()) {
    const auto now = steady_clock::now();
    const auto left = std::max(std::chrono::ceil<microseconds>(deadline - now), microseconds(0));
    timeval wait{};
    wait.tv_sec = static_cast<time_t>(left.count() / 1'000'000);
    wait.tv_usec = static_cast<suseconds_t>(left.count() % 1'000'000);
    libusb_handle_events_timeout_completed(context.get(), &wait, nullptr);
    if (done()) return true;
    if (now >= deadline) return false;
    if (steady_clock::now() - now < kInstant) std::this_thread::sleep_for(kRest);
  }
  return true;
}

Transfer::Transfer(const Connection& connection, std::size_t bytes)
    : raw(libusb_alloc_transfer(0)), buffer(bytes) {
  if (!raw) return;
  raw->dev_handle = connection.device;
  raw->buffer = buffer.data();
  raw->length = static_cast<int>(bytes);
  raw->user_data = this;
  raw->callback = on_end;
  raw->type = LIBUSB_TRANSFER_TYPE_BULK;
}

Status Transfer::submit() {
  if (!raw) return io_error("there is no memory for a USB transfer");
  const int code = libusb_submit_transfer(raw);
  if (code != 0) return io_error(text_of_error(code));
  in_flight = true;
  return {};
}

std::string Transfer::received() const {
  const auto* begin = reinterpret_cast<const char*>(buffer.data());
  return {begin, static_cast<std::size_t>(raw->actual_length)};
}

bool cancel_all(const Connection& connection, const Transfers& transfers) {
  // Cancels the newest transfer first. Otherwise a later transfer could start while the earlier
  // transfers are cancelled.
  for (auto each = transfers.rbegin(); each != transfers.rend(); ++each)
    if ((*each)->in_flight) libusb_cancel_transfer((*each)->raw);
  const auto all_ended = [&] {
    return std::none_of(transfers.begin(), transfers.end(),
                        [](const auto& transfer) { return transfer->in_flight; });
  };
  return connection.pump(steady_clock::now() + kToCancel, all_ended);
}

void cancel_and_free(const Connection& connection, Transfers& transfers) {
  if (!cancel_all(connection, transfers))
    for (auto& transfer : transfers)
      if (transfer->in_flight) (void)transfer.release();
  transfers.clear();
}

std::string text_of(libusb_transfer_status status) {
  switch (status) {
    case LIBUSB_TRANSFER_COMPLETED:
      return "";
    case LIBUSB_TRANSFER_NO_DEVICE:
      return kGone;
    case LIBUSB_TRANSFER_STALL:
      return "the device has refused the request (stall)";
    case LIBUSB_TRANSFER_OVERFLOW:
      return "the device has sent more data than requested (overflow)";
    case LIBUSB_TRANSFER_TIMED_OUT:
    case LIBUSB_TRANSFER_CANCELLED:
      return "the device has not answered in time";
    case LIBUSB_TRANSFER_ERROR:
      break;
  }
  return "the transfer over USB has failed; check the cable and the hub";
}

std::string text_of_error(int code) {
  switch (code) {
    case LIBUSB_ERROR_NO_DEVICE:
    case LIBUSB_ERROR_NOT_FOUND:
      return kGone;
    case LIBUSB_ERROR_PIPE:
      return "the device has refused the request (stall)";
    case LIBUSB_ERROR_NO_MEM:
      return "there is no memory for USB transfers; write a larger number to "
             "/sys/module/usbcore/parameters/usbfs_memory_mb (the limit of all programs together)";
    default:
      return std::string("libusb: ") + libusb_strerror(code);
  }
}

}  // namespace mdof::drivers::usb
