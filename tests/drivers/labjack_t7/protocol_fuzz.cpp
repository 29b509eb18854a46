// Any bytes are read from the stream port in pieces. The simulated device receives any requests.
#include <cstddef>
#include <cstdint>
#include <string>

#include "drivers/labjack_t7/modbus_server.h"
#include "drivers/labjack_t7/protocol.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mdof::drivers::labjack_t7;
  if (size < 2) return 0;
  const std::size_t words = 1 + data[0] % 8, portion = 1 + data[1];
  const std::string bytes(reinterpret_cast<const char*>(data) + 2, size - 2);
  PacketReader reader;
  ScanNumbering line(words);
  StreamPacket packet;
  std::vector<Scan> scans;
  bool good = true;
  for (std::size_t at = 0; good && at < bytes.size(); at += portion) {
    reader.append(std::string_view(bytes).substr(at, portion));
    auto complete = reader.next(packet);
    for (; complete && *complete; complete = reader.next(packet))
      good = line.take(packet, scans).has_value() && good;
    good = good && complete.has_value();
  }
  std::string requests = bytes;
  while (const auto request = take_request(requests)) {
    if (request->well_formed && request->function != 3) (void)write_reply(*request);
    (void)exception_reply(*request, 1);
  }
  return 0;
}
