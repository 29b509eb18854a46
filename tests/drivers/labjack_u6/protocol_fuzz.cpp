// Any bytes are parsed as replies and as stream packets.
#include <cstddef>
#include <cstdint>
#include <string>

#include "drivers/labjack_u6/protocol.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mdof::drivers::labjack_u6;
  if (size < 2) return 0;
  const std::size_t samples = 1 + data[0] % 25;
  std::string bytes(reinterpret_cast<const char*>(data) + 2, size - 2);
  (void)read_config_u6(bytes);
  (void)read_calibration_reply(bytes);
  (void)read_config_io(bytes, 2, 0);
  (void)read_feedback(bytes);
  (void)read_stream_config(bytes);
  (void)read_stream_start(bytes);
  (void)decode(bytes, samples);
  ScanNumbering line(1 + data[1] % 8);
  std::vector<Scan> scans;
  StreamData packet;
  for (std::size_t i = 0; i + 3 < bytes.size(); i += 4) {
    packet.counter = static_cast<std::uint8_t>(bytes[i]);
    packet.error = static_cast<std::uint8_t>(bytes[i + 1]);
    packet.dropped = packet.counter;
    packet.samples.assign(samples, static_cast<std::uint16_t>(-bytes[i + 2]));
    if (!line.take(packet, scans)) break;
  }
  return 0;
}
