// Any bytes are used as replies, as requests to the simulated device, and as serial numbers.
#include <cstddef>
#include <cstdint>
#include <string>

#include "drivers/pokeys57u/simulated_pokeys57u.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mdof::drivers::pokeys57u;
  std::string bytes(reinterpret_cast<const char*>(data), size);
  (void)may_be_serial(bytes, 12345);
  // Adds a valid checksum, so that the parser does not stop at the checksum.
  bytes.resize(kFrameBytes, '\0');
  unsigned sum = 0;
  for (std::size_t i = 1; i < 7; ++i) sum += static_cast<std::uint8_t>(bytes[i]);
  for (const Way way : {Way::reply, Way::request}) {
    bytes[0] = static_cast<char>(way);
    bytes[7] = static_cast<char>(sum + static_cast<unsigned>(way));
    const auto frame = unwrap(way, bytes);
    if (!frame || wrap(way, *frame) != bytes) __builtin_trap();
    (void)identity_of(*frame).model();
    (void)counts_of(*frame);
    (void)analogue_of(*frame);
    (void)tick_of(*frame);
  }
  SimulatedPokeys57u device([](std::size_t, std::int64_t) { return 1234.5; }, {});
  (void)device.out(SimulatedPokeys57u::kOut, bytes, 0);
  (void)device.in(SimulatedPokeys57u::kIn, kFrameBytes, 10'000'000);
  return 0;
}
