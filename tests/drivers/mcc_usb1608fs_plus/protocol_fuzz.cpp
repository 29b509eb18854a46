// Any bytes are used as replies, as requests and as samples.
#include <cstddef>
#include <cstdint>
#include <string>

#include "drivers/mcc_usb1608fs_plus/simulated_mcc_usb1608fs_plus.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mdof::drivers::mcc_usb1608fs_plus;
  namespace usb = mdof::drivers::usb;
  if (size < 2) return 0;
  const std::string bytes(reinterpret_cast<const char*>(data) + 2, size - 2);
  (void)read_status(bytes);
  (void)read_scan_start(bytes);
  if (const auto calibration = read_calibration(bytes)) (void)volts(data[0], *calibration, 10);
  ScanSplitter line(1 + data[0] % kInputs);
  std::vector<std::uint16_t> words;
  for (std::size_t at = 0, n = 0; at < bytes.size(); at += n) {
    n = 1 + static_cast<std::uint8_t>(bytes[at]) % 64;
    line.take(std::string_view(bytes).substr(at, n), words);
  }
  if (words.size() % (1 + data[0] % kInputs) != 0) __builtin_trap();
  SimulatedMccUsb1608fsPlus device([](std::size_t, std::int64_t) { return 1.0; }, {});
  const usb::Setup setup{data[1], data[0], 0, 0, static_cast<std::uint16_t>(bytes.size())};
  (void)device.control(setup, bytes, 0);
  (void)device.in(kSamplesIn, 64, 1000);
  return 0;
}
