#include "drivers/mcc_usb1608fs_plus/settings.h"

#include <algorithm>
#include <cmath>

namespace mdof::drivers::mcc_usb1608fs_plus {

std::uint8_t mask_of(const std::vector<Input>& inputs) {
  unsigned mask = 0;
  for (const Input& input : inputs) mask |= 1U << input.input;
  return static_cast<std::uint8_t>(mask);
}

usb::InStream::Options transfers_for(double samples_hz) {
  constexpr double kTransfer_s = 5e-3, kWaiting_s = 0.25;
  const double packets_hz = samples_hz * 2 / static_cast<double>(kPacket);
  const double packets = std::clamp(std::floor(packets_hz * kTransfer_s), 1.0, 64.0);
  const double transfers = std::clamp(std::ceil(packets_hz / packets * kWaiting_s), 4.0, 64.0);
  return {kSamplesIn, static_cast<std::size_t>(packets) * kPacket,
          static_cast<std::size_t>(transfers)};
}

ScanSetup scan_setup(const Settings& settings) {
  constexpr double kSlow_Hz = 100;  // up to this rate, the device must not wait for a full packet
  const auto options = kNoStall | (settings.rate_hz <= kSlow_Hz ? kImmediate : 0);
  return {0, pacer_period(settings.rate_hz), mask_of(settings.inputs),
          static_cast<std::uint8_t>(options)};
}

}  // namespace mdof::drivers::mcc_usb1608fs_plus
