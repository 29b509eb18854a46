// Any bytes are used as a reply, and as requests to the simulated slave.
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "drivers/modbus/protocol.h"
#include "drivers/modbus/simulated_modbus.h"

namespace mdof::drivers::modbus {
namespace {

void answers(Framing framing, std::string_view bytes) {
  const std::uint16_t values[] = {1, 2};
  for (const auto& pdu : {read_request(kReadHolding, 7, 2), write_request(7, values)}) {
    const auto answer = answer_to({1, 1, pdu}, framing, bytes);
    if (answer && answer->exception == 0 && pdu[0] == kReadHolding && answer->registers.size() != 4)
      __builtin_trap();
  }
}

void serves(const char* profile, std::string_view bytes) {
  static std::map<std::string, Profile> profiles;
  if (!profiles.contains(profile)) profiles.emplace(profile, *load_profile(profile, ""));
  SimulatedModbus device([](auto, auto) { return 1.0; }, {profiles.at(profile), {}});
  device.opened(0, 1, 0);
  (void)device.exchange(0, 1, bytes.substr(0, bytes.size() / 2), 0);
  (void)device.exchange(0, 1, bytes.substr(bytes.size() / 2), 1);
}

}  // namespace
}  // namespace mdof::drivers::modbus

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mdof::drivers::modbus;
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  if (data[0] % 4 == 0) answers(Framing::tcp, bytes);
  if (data[0] % 4 == 1) answers(Framing::rtu, bytes);
  if (data[0] % 4 == 2) serves("adam-6017", bytes);
  if (data[0] % 4 == 3) serves("lika-smax", bytes);
  return 0;
}
