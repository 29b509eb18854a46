// Handle::open: finds the requested device on the bus.
#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <utility>

#include "drivers/usb/handle.h"
#include "drivers/usb/owner.h"
#include "drivers/usb/transfer.h"

namespace mdof::drivers::usb {
namespace {

constexpr const char* kRules = "60-mdof.rules";
constexpr std::uint16_t kEnglish_US = 0x0409;
constexpr std::chrono::milliseconds kToAsk{500};

struct DeviceList {
  libusb_device** devices = nullptr;
  ssize_t count = 0;
  explicit DeviceList(libusb_context* context) : count(libusb_get_device_list(context, &devices)) {}
  ~DeviceList() {
    if (count >= 0) libusb_free_device_list(devices, 1);
  }
  DeviceList(const DeviceList&) = delete;
  DeviceList& operator=(const DeviceList&) = delete;
};

Place place_of(libusb_device* device) {
  Place place{libusb_get_bus_number(device), libusb_get_device_address(device), ""};
  std::array<std::uint8_t, 8> ports{};
  const int n = libusb_get_port_numbers(device, ports.data(), ports.size());
  for (int i = 0; i < n; ++i)
    place.port += (i == 0 ? std::to_string(place.bus) + "-" : ".") +
                  std::to_string(ports[static_cast<std::size_t>(i)]);
  return place;
}

std::string text_of(const Place& place) {
  return "USB bus " + std::to_string(place.bus) + ", device " + std::to_string(place.address);
}

std::string ids(const Wanted& wanted) {
  std::array<char, 24> text{};
  std::snprintf(text.data(), text.size(), "%04x:%04x", wanted.vendor, wanted.product);
  return text.data();
}

}  // namespace

// A libusb context and the matching devices in it. At the end, all devices except one are closed.
class Search {
 public:
  explicit Search(const Wanted& wanted) : wanted_(wanted) {}

  Result<Handle> run() {
    libusb_context* context = nullptr;
    if (const int code = libusb_init(&context); code != 0)
      return io_error("USB cannot be used: " + text_of_error(code));
    context_ = {context, libusb_exit};
    const DeviceList list(context);
    if (list.count < 0)
      return io_error("the devices on the USB cannot be listed: " +
                      text_of_error(static_cast<int>(list.count)));
    for (ssize_t i = 0; i < list.count; ++i) consider(list.devices[i]);
    return chosen();
  }

 private:
  void consider(libusb_device* device) {
    libusb_device_descriptor descriptor{};
    libusb_get_device_descriptor(device, &descriptor);
    if (descriptor.idVendor != wanted_.vendor || descriptor.idProduct != wanted_.product) return;
    ++count_;
    const Place place = place_of(device);
    auto opened = open(device, descriptor.iSerialNumber, place);
    const std::string serial = opened ? opened->serial() : "";
    seen_.push_back((serial.empty() ? "unknown" : "\"" + serial + "\"") + " (" + text_of(place) +
                    ")");
    if (!opened) {
      failure_ = in_context(text_of(place), std::move(opened.error()));
    } else if (wanted_.serial.empty() || serial == wanted_.serial) {
      fitting_ = std::move(*opened);
    }
  }

  // Opens the device and claims its interface, unless the descriptor of the device states another
  // serial number.
  Result<Handle> open(libusb_device* device, std::uint8_t serial_index, const Place& place) {
    Handle handle(std::make_shared<Connection>(), text_of(place));
    Connection& connection = *handle.connection_;
    connection.context = context_;
    if (const int code = libusb_open(device, &connection.device); code != 0)
      return not_opened(code);
    if (serial_index != 0) handle.serial_ = read_serial(handle, serial_index);
    const bool other =
        !wanted_.serial.empty() && !handle.serial_.empty() && handle.serial_ != wanted_.serial;
    if (other) return handle;
    if (const int code = libusb_claim_interface(connection.device, wanted_.interface); code != 0)
      return io_error(code == LIBUSB_ERROR_BUSY
                          ? "the device is in use by " + interface_owner(place, wanted_.interface) +
                                "; end that program, or unload that driver"
                          : text_of_error(code));
    connection.claimed = wanted_.interface;
    if (!handle.serial_.empty() || !wanted_.query_serial) return handle;
    MDOF_TRY(handle.serial_, wanted_.query_serial(handle));
    return handle;
  }

  // Returns "" if the serial number cannot be read.
  static std::string read_serial(Handle& handle, std::uint8_t index) {
    const auto value = static_cast<std::uint16_t>(LIBUSB_DT_STRING << 8 | index);
    const auto bytes = handle.control(LIBUSB_ENDPOINT_IN, LIBUSB_REQUEST_GET_DESCRIPTOR, value,
                                      kEnglish_US, "", 255, kToAsk);
    std::string text;
    for (std::size_t i = 2; bytes && i + 1 < bytes->size(); i += 2) text += (*bytes)[i];
    return text;
  }

  tl::unexpected<Error> not_opened(int code) const {
    if (code != LIBUSB_ERROR_ACCESS) return io_error(text_of_error(code));
    return io_error(std::string("no permission to use the device; the udev rules ") + kRules +
                        " give access to the group mdof",
                    Remedy::install_udev_rules_for_usb, wanted_.model);
  }

  std::string all_seen() {
    std::sort(seen_.begin(), seen_.end());
    std::string all;
    for (const std::string& one : seen_) all += (all.empty() ? "" : ", ") + one;
    return all;
  }

  Result<Handle> chosen() {
    if (wanted_.serial.empty() && count_ > 1)
      return io_error(
          std::to_string(count_) + " devices " + ids(wanted_) +
          " are on the USB, but the key \"serial\" is missing; give one of these serial numbers: " +
          all_seen());
    if (fitting_) return std::move(*fitting_);
    if (!failure_) return tl::unexpected(failure_.error());
    if (count_ == 0)
      return io_error("no " + wanted_.model + " (" + ids(wanted_) +
                      ") is on the USB; check the cable and the power");
    return io_error("no " + wanted_.model + " with serial \"" + wanted_.serial +
                    "\" is on the USB; found: " + all_seen());
  }

  const Wanted& wanted_;
  std::shared_ptr<libusb_context> context_;
  std::vector<std::string> seen_;  // serial numbers and places
  int count_ = 0;
  std::optional<Handle> fitting_;
  Status failure_;  // error of the last device that could not be opened
};

Result<Handle> Handle::open(const Wanted& wanted) {
  return Search(wanted).run();
}

}  // namespace mdof::drivers::usb
