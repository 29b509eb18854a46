#include "drivers/usb/simulated_usb.h"

#include <algorithm>

namespace mdof::drivers::usb {
namespace {

enum Request : std::uint8_t {
  kGetStatus = 0,
  kClearFeature = 1,
  kSetFeature = 3,
  kGetDescriptor = 6,
  kGetConfiguration = 8,
  kSetConfiguration = 9,
  kGetInterface = 10,
  kSetInterface = 11,
};
enum Descriptor : std::uint8_t {
  kDevice = 1,
  kConfiguration = 2,
  kString = 3,
  kQualifier = 6,
  kHid = 0x21,
  kHidReport = 0x22,
};
// bits of the request type: standard, class or vendor
constexpr std::uint8_t kTypeMask = 0x60;
// bits of the request type: the recipient is an endpoint
constexpr std::uint8_t kToEndpoint = 0x02;
constexpr std::uint16_t kStringLanguage = 0x0409;  // English (US)

std::string bytes_of(std::initializer_list<int> values) {
  std::string bytes;
  for (const int value : values) bytes += static_cast<char>(value);
  return bytes;
}
int low(std::uint16_t word) {
  return word & 0xFF;
}
int high(std::uint16_t word) {
  return word >> 8;
}

std::string string_descriptor(const Identity& identity, std::uint8_t index) {
  if (index == 0) return bytes_of({4, kString, low(kStringLanguage), high(kStringLanguage)});
  const std::string* const texts[] = {&identity.manufacturer, &identity.product_name,
                                      &identity.serial};
  if (index > std::size(texts)) return "";
  const std::string text = texts[index - 1]->substr(0, 126);
  std::string bytes = bytes_of({2 + 2 * static_cast<int>(text.size()), kString});
  for (const char c : text) (bytes += c) += '\0';
  return bytes;
}

// The HID descriptor of this interface, which is part of the configuration descriptor.
std::string hid_descriptor(const Identity& identity, std::uint8_t interface) {
  const std::string& all = identity.configuration;
  int current = -1;
  for (std::size_t at = 0; at + 2 < all.size();) {
    const auto size = static_cast<std::uint8_t>(all[at]);
    const auto type = static_cast<std::uint8_t>(all[at + 1]);
    if (size == 0) break;
    if (type == 4) current = static_cast<std::uint8_t>(all[at + 2]);
    if (type == kHid && current == interface) return all.substr(at, size);
    at += size;
  }
  return "";
}

std::string descriptor(const Identity& identity, const Setup& setup) {
  const auto index = static_cast<std::uint8_t>(low(setup.value));
  const auto interface = static_cast<std::uint8_t>(low(setup.index));
  switch (high(setup.value)) {
    case kDevice:
      return device_descriptor(identity);
    case kConfiguration:
      return index == 0 ? identity.configuration : "";
    case kString:
      return string_descriptor(identity, index);
    case kQualifier:
      if (identity.speed == Speed::full) return "";
      return bytes_of({10, kQualifier, 0, 2, 0, 0, 0, 64, 1, 0});
    case kHid:
      return hid_descriptor(identity, interface);
    case kHidReport:
      return interface < identity.hid_reports.size() ? identity.hid_reports[interface] : "";
    default:
      return "";
  }
}

}  // namespace

std::string device_descriptor(const Identity& identity) {
  return bytes_of({18, kDevice, 0, 2, 0, 0, 0, 64, low(identity.vendor), high(identity.vendor),
                   low(identity.product), high(identity.product), low(identity.version_bcd),
                   high(identity.version_bcd), 1, 2, 3, 1});
}

std::optional<Reply> standard_reply(SimulatedUsb& device, const Setup& setup) {
  if ((setup.request_type & kTypeMask) != 0) return std::nullopt;
  switch (setup.request) {
    case kGetDescriptor: {
      const std::string bytes = descriptor(device.identity(), setup).substr(0, setup.length);
      return Reply{bytes.empty() ? Answer::stall : Answer::done, bytes};
    }
    case kGetStatus:
      return Reply{Answer::done, std::string(2, '\0')};
    case kGetConfiguration:
    case kGetInterface:
      return Reply{Answer::done, std::string(1, setup.request == kGetConfiguration ? '\1' : '\0')};
    case kClearFeature:
      if ((setup.request_type & 0x1F) == kToEndpoint)
        device.clear_halt(static_cast<std::uint8_t>(low(setup.index)));
      return Reply{};
    case kSetFeature:
    case kSetConfiguration:
    case kSetInterface:
      return Reply{};
    default:
      return Reply{Answer::stall, ""};
  }
}

}  // namespace mdof::drivers::usb
